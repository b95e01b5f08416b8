// Contacts are resolved and handed out in canonical order: by time, a hash of the pair, the ids.

#include "collision/rules/contact_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

#include <quadrille/names.hpp>

#include "collision/discrete/canonical_sort.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"

namespace quadrille {
namespace {

using Pending = PendingContact<double>;

/// From few values, so that ties are common.
Pending randomContact(Random& random, std::int64_t values) {
    const auto draw = [&] { return static_cast<std::uint32_t>(random.integer(0, values)); };
    Pending contact{};
    contact.sinceStart = double(draw()) / double(values) / 60;
    contact.priority = draw() * 0x1000'0000u;
    contact.a = draw();
    contact.b = draw() == 0 ? BodyRef::fixed(draw()) : BodyRef::moving(draw());
    return contact;
}

auto keys(const Pending& c) { return std::tuple(c.sinceStart, c.priority, c.a, c.b.bits); }

/// Of bodies that lie in storage as they were created.
constexpr CanonicalOrder before{};

TEST(CanonicalOrder, IsAStrictWeakOrdering) {
    Random random(21);
    for (int i = 0; i < 100000; ++i) {
        SCOPED_TRACE(i);
        const Pending p = randomContact(random, 2);
        const Pending q = randomContact(random, 2);
        const Pending r = randomContact(random, 2);
        ASSERT_FALSE(before(p, p));
        ASSERT_FALSE(before(p, q) && before(q, p));
        ASSERT_TRUE(!before(p, q) || !before(q, r) || before(p, r));
        const auto equal = [](const Pending& s, const Pending& t) {
            return !before(s, t) && !before(t, s);
        };
        ASSERT_TRUE(!equal(p, q) || !equal(q, r) || equal(p, r));
        // Only a contact itself is its equal: the order leaves nothing to the sort.
        ASSERT_EQ(equal(p, q), keys(p) == keys(q));
        ASSERT_EQ(before(p, q), keys(p) < keys(q));
    }
}

TEST(CanonicalOrder, ThePriorityOfAPairIsAHash) {
    // The first outputs of splitmix64 with seed 0, whose state grows by 0x9e3779b97f4a7c15.
    EXPECT_EQ(mix64(0x9e3779b97f4a7c15u), 0xe220a8397b1dcdafu);
    EXPECT_EQ(mix64(2 * 0x9e3779b97f4a7c15u), 0x6e789e6aa1b965f4u);
    EXPECT_EQ(mix64(3 * 0x9e3779b97f4a7c15u), 0x06c45d188009454fu);
    EXPECT_EQ(mix64(0), 0u);
    EXPECT_EQ(pairPriority(0, 1), static_cast<std::uint32_t>(mix64(1) >> 32));
    EXPECT_EQ(pairPriority(7, 9),
              static_cast<std::uint32_t>(mix64((std::uint64_t(7) << 32) | 9) >> 32));
    EXPECT_NE(pairPriority(7, 9), pairPriority(9, 7));
}

template <class Real>
void expectSorted(std::uint64_t seed) {
    Random random(seed);
    CanonicalSort<Real> sort;
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
        const auto dt = static_cast<Real>(std::pow(10, random.uniform(-6, 0)));
        std::vector<PendingContact<Real>> contacts(
            static_cast<std::size_t>(random.integer(0, round < 250 ? 20 : 3000)));
        const std::int64_t shape = random.integer(0, 4);
        for (auto& c : contacts) {
            c = {};
            const double share = shape == 0   ? 0
                                 : shape == 1 ? 1
                                 : shape == 2 ? random.uniform(0, 1) * 1e-7
                                 : shape == 3 ? double(random.integer(0, 3)) / 3
                                              : random.uniform(0, 1);
            c.sinceStart = std::min(dt, static_cast<Real>(share) * dt);
            c.priority = static_cast<std::uint32_t>(
                random.integer(0, 1) == 0 ? random.integer(0, 0xffff'ffff) : 0xffff'ffff);
            c.a = static_cast<std::uint32_t>(random.integer(0, 3));
            c.b = BodyRef::moving(static_cast<std::uint32_t>(random.integer(0, 3)));
        }
        auto expected = contacts;
        std::sort(expected.begin(), expected.end(), before);
        sort(contacts, before, dt);
        ASSERT_EQ(contacts.size(), expected.size());
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            ASSERT_FALSE(before(contacts[i], expected[i]) || before(expected[i], contacts[i])) << i;
        }
    }
}

TEST(CanonicalOrder, TheBucketSortSortsAsAnySortDoes) {
    expectSorted<double>(31);
    expectSorted<float>(32);
}

// ---- as a listener sees it

struct Seen {
    std::uint64_t step;
    Contact contact;
};

/// Keys of a contact in canonical order, from what the listener is told.
auto seenKeys(const Contact& c) {
    const std::int64_t b = c.numberB >= 0 ? c.numberB : (std::int64_t(1) << 31) + (-1 - c.numberB);
    return std::tuple(c.time, pairPriority(c.a.index, c.b.index), c.numberA, b);
}

std::vector<Seen> contactsOf(Simulation& sim, std::uint64_t steps) {
    std::vector<Seen> seen;
    sim.onContact([&](const Contact& c) { seen.push_back({sim.stepsDone(), c}); });
    sim.run(steps);
    return seen;
}

class ContactOrder : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, ContactOrder,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(ContactOrder, TimesDoNotFallWithinAStep) {
    for (const SceneKind kind : sceneKinds) {
        SCOPED_TRACE(name(kind));
        Simulation sim(
            randomScene(kind, 41, 150, 300),
            {.law = Law::Impulse, .precision = GetParam(), .step = {.restitution = 0.9}});
        const auto seen = contactsOf(sim, 30);
        for (std::size_t i = 1; i < seen.size(); ++i) {
            if (seen[i].step != seen[i - 1].step) continue;
            ASSERT_LE(seen[i - 1].contact.time, seen[i].contact.time) << i;
        }
        for (const auto& [step, c] : seen) {
            const double start = double(step - 1) * sim.config().step.dt;
            ASSERT_GE(c.time, start);
            ASSERT_LE(c.time, start + sim.config().step.dt * (1 + 1e-6));
        }
    }
}

TEST_P(ContactOrder, TiesAreBrokenByTheHashAndThenTheRows) {
    // In the first step the time of a contact is the time since the start of the step exactly, and
    // all bodies that overlapped from the start have time 0.
    for (const SceneKind kind : sceneKinds) {
        SCOPED_TRACE(name(kind));
        Simulation sim(randomScene(kind, 42, 150, 1000),
                       {.law = Law::Impulse, .precision = GetParam()});
        auto seen = contactsOf(sim, 1);
        // What a body touches of static ones at one time has an order of its own (staticPriority).
        std::erase_if(seen, [](const Seen& s) { return s.contact.numberB < 0; });
        ASSERT_GT(seen.size(), 10u);
        for (std::size_t i = 1; i < seen.size(); ++i) {
            ASSERT_LT(seenKeys(seen[i - 1].contact), seenKeys(seen[i].contact)) << i;
        }
    }
}

TEST_P(ContactOrder, TheFirstBodyOfAPairIsTheOneCreatedFirstEvenIfItsIdIsLarger) {
    World world({.size = {256, 128}});
    // Destroyed entities give their ids to the last bodies, whose rows are the highest.
    std::vector<Entity> early;
    for (int i = 0; i < 40; ++i) early.push_back(makeBox(world, {0, 0}));
    for (int i = 0; i < 40; ++i) makeBox(world, {double(i), 0}, {}, {20, 20});
    for (const Entity entity : early) world.destroy(entity);
    world.flush();
    for (int i = 0; i < 40; ++i) makeBox(world, {double(i), 1}, {}, {20, 20});

    Simulation sim(std::move(world), {.law = Law::Impulse, .precision = GetParam()});
    const auto seen = contactsOf(sim, 1);
    ASSERT_GT(seen.size(), 500u);
    int swapped = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Contact& c = seen[i].contact;
        ASSERT_LT(c.numberA, c.numberB);
        swapped += c.a.index > c.b.index;
        ASSERT_TRUE(i == 0 || seenKeys(seen[i - 1].contact) < seenKeys(c)) << i;
    }
    EXPECT_GT(swapped, 100);
}

TEST_P(ContactOrder, IsTheSameForEveryPartitioner) {
    const auto contacts = [&](const PartitionerConfig& partitioner) {
        Simulation sim(randomScene(SceneKind::Clustered, 43, 150, 100),
                       {.partitioner = partitioner, .law = Law::Impulse, .precision = GetParam()});
        return contactsOf(sim, 10);
    };
    const auto expected = contacts(BruteForce{});
    ASSERT_GT(expected.size(), 100u);
    for (const PartitionerConfig& config :
         std::vector<PartitionerConfig>{StaticGrid{{9, 9}}, Quadtree{9, 3}, SemiStaticQuadtree{},
                                        SemiStaticQuadtree{9, 3, SemiStaticQuadtree::Skin{4}}}) {
        SCOPED_TRACE(name(config));
        const auto seen = contacts(config);
        ASSERT_EQ(seen.size(), expected.size());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            ASSERT_EQ(seenKeys(seen[i].contact), seenKeys(expected[i].contact)) << i;
            ASSERT_EQ(seen[i].contact.axis, expected[i].contact.axis) << i;
            ASSERT_EQ(seen[i].contact.normal, expected[i].contact.normal) << i;
            ASSERT_EQ(seen[i].contact.collided, expected[i].contact.collided) << i;
        }
    }
}

}  // namespace
}  // namespace quadrille
