#include "collision/continuous/event_queue.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <tuple>
#include <vector>

#include <quadrille/random.hpp>

#include "collision/rules/pair_contact.hpp"

namespace quadrille {
namespace {

constexpr std::uint32_t bodies = 4;  // of each kind

/// Entities and numbers of creation, and in which row each body lies.
struct Numbers {
    /// Body i lies in row (i + shift) mod `bodies`. With few different entities, the hash leaves
    /// ties.
    explicit Numbers(std::uint32_t shift = 0) : rowOf(bodies) {
        for (std::uint32_t i = 0; i < bodies; ++i) rowOf[i] = (i + shift) % bodies;
        for (auto* column : {&moving, &fixed, &created}) column->resize(bodies);
        for (std::uint32_t i = 0; i < bodies; ++i) {
            moving[rowOf[i]] = i / 2;
            fixed[rowOf[i]] = i / 2;
            created[rowOf[i]] = i;
        }
    }
    EventOrder order() const {
        return {.moving = moving.data(),
                .fixed = fixed.data(),
                .movingCreated = {created.data()},
                .fixedCreated = {created.data()}};
    }
    PairEvent inRows(PairEvent event) const {
        event.a = rowOf[event.a];
        const std::uint32_t row = rowOf[event.b.row()];
        event.b = event.withStatic() ? BodyRef::fixed(row) : BodyRef::moving(row);
        return event;
    }
    PairEvent fromRows(PairEvent event) const {
        event.a = created[event.a];
        const std::uint32_t number = created[event.b.row()];
        event.b = event.withStatic() ? BodyRef::fixed(number) : BodyRef::moving(number);
        return event;
    }

    std::vector<std::uint32_t> rowOf, moving, fixed, created;
};

auto keys(const PairEvent& e) { return std::tuple(e.time, e.a, e.b.bits, e.axes, e.release); }

/// Every event of these bodies at the times 1 and 2, in a random order.
std::vector<PairEvent> shuffledEvents(Random& random) {
    std::vector<PairEvent> events;
    for (const double time : {1.0, 2.0}) {
        for (std::uint32_t a = 0; a < bodies; ++a) {
            for (std::uint32_t b = 0; b < 2 * bodies; ++b) {
                if (b <= a) continue;
                for (std::uint8_t axes = 0; axes < 4; ++axes) {
                    for (const bool release : {false, true}) {
                        events.push_back(
                            {.time = time,
                             .a = a,
                             .b = b < bodies ? BodyRef::moving(b) : BodyRef::fixed(b - bodies),
                             .stampA = 0,
                             .stampB = 0,
                             .axes = axes,
                             .release = release});
                    }
                }
            }
        }
    }
    for (std::size_t i = events.size(); i-- > 1;) {
        std::swap(events[i], events[static_cast<std::size_t>(random.integer(0, std::int64_t(i)))]);
    }
    return events;
}

std::vector<PairEvent> popAll(EventQueue& queue) {
    std::vector<PairEvent> events;
    while (!queue.empty()) events.push_back(queue.pop());
    return events;
}

TEST(EventQueue, TheOrderDoesNotDependOnWhoPushesFirst) {
    const Numbers numbers;
    Random random(81);
    std::vector<PairEvent> expected;
    for (int round = 0; round < 20; ++round) {
        EventQueue queue;
        queue.begin(2, numbers.order());
        for (const PairEvent& event : shuffledEvents(random)) queue.push(event);
        const auto events = popAll(queue);
        if (expected.empty()) expected = events;
        ASSERT_EQ(events.size(), expected.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            ASSERT_EQ(keys(events[i]), keys(expected[i])) << i;
        }
    }
}

TEST(EventQueue, TiesGoByTheHashThenTheNumbersOfCreationThenWhatHappens) {
    const Numbers numbers;
    Random random(82);
    EventQueue queue;
    queue.begin(2, numbers.order());
    for (const PairEvent& event : shuffledEvents(random)) queue.push(event);
    const auto events = popAll(queue);
    const auto sorted = [&](const PairEvent& e) {
        const std::uint32_t other = (e.withStatic() ? numbers.fixed : numbers.moving)[e.b.row()];
        return std::tuple_cat(std::tuple(e.time, pairPriority(numbers.moving[e.a], other)),
                              std::tuple(e.a, e.b.bits, e.axes, e.release));
    };
    for (std::size_t i = 1; i < events.size(); ++i) {
        ASSERT_LT(sorted(events[i - 1]), sorted(events[i])) << i;
    }
}

TEST(EventQueue, TheOrderDoesNotKnowRows) {
    Random random(83);
    std::vector<PairEvent> expected;
    for (std::uint32_t shift = 0; shift < bodies; ++shift) {
        SCOPED_TRACE(shift);
        const Numbers numbers(shift);
        EventQueue queue;
        queue.begin(2, numbers.order());
        for (const PairEvent& event : shuffledEvents(random)) queue.push(numbers.inRows(event));
        auto events = popAll(queue);
        for (PairEvent& event : events) event = numbers.fromRows(event);
        if (expected.empty()) expected = events;
        ASSERT_EQ(events.size(), expected.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            ASSERT_EQ(keys(events[i]), keys(expected[i])) << i;
        }
    }
}

PairEvent at(double time, std::uint32_t a = 0) {
    return {.time = time,
            .a = a,
            .b = BodyRef::fixed(0),
            .stampA = 0,
            .stampB = 0,
            .axes = axisX,
            .release = false};
}

TEST(EventQueue, LaterEventsWaitForTheirStep) {
    const Numbers numbers;
    EventQueue queue;
    queue.begin(1, numbers.order());
    for (const double time : {2.5, 0.5, 1.5, 1.0}) queue.push(at(time));
    EXPECT_EQ(queue.dueCount(), 2u);
    EXPECT_EQ(queue.pop().time, 0.5);
    EXPECT_EQ(queue.pop().time, 1.0) << "the end belongs to the step";
    EXPECT_TRUE(queue.empty());
    queue.begin(2, numbers.order());
    queue.push(at(1.25));
    EXPECT_EQ(queue.pop().time, 1.25);
    EXPECT_EQ(queue.pop().time, 1.5);
    EXPECT_TRUE(queue.empty());
    queue.begin(3, numbers.order());
    EXPECT_EQ(queue.pop().time, 2.5);
    queue.push(at(7));
    queue.clear();
    queue.begin(9, numbers.order());
    EXPECT_TRUE(queue.empty());
}

/// A calendar changes no order, wherever its spans lie: among the events, beside them, or all at
/// one time; nor whether events are pushed before or while it runs.
TEST(EventQueue, ACalendarKeepsTheOrder) {
    const Numbers numbers;
    Random random(85);
    const std::vector<PairEvent> events = shuffledEvents(random);
    EventQueue plain;
    plain.begin(3, numbers.order());
    for (const PairEvent& event : events) plain.push(event);
    const auto expected = popAll(plain);
    const double spans[][2] = {{0, 3}, {0, 1e-3}, {1, 1}, {-1e300, 1e300}, {1, 1.5}, {7, 9}};
    EventQueue queue;  // one for all, so that a calendar follows another
    for (const auto& [from, to] : spans) {
        SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
        queue.begin(0.5, numbers.order());
        queue.collect();
        for (std::size_t i = 0; i < events.size() / 2; ++i) queue.push(events[i]);
        queue.spread(from, to);
        for (std::size_t i = events.size() / 2; i < events.size(); ++i) queue.push(events[i]);
        std::vector<PairEvent> popped;
        for (const double end : {0.5, 1.0, 2.0, 3.0}) {
            queue.begin(end, numbers.order());
            EXPECT_EQ(queue.dueCount() == 0, queue.empty());
            while (!queue.empty()) {
                popped.push_back(queue.pop());
                ASSERT_LE(popped.back().time, end);
            }
        }
        ASSERT_EQ(popped.size(), expected.size());
        for (std::size_t i = 0; i < popped.size(); ++i) {
            ASSERT_EQ(keys(popped[i]), keys(expected[i])) << i;
        }
    }
}

TEST(EventQueue, ACalendarForgetsWhatIsLater) {
    const Numbers numbers;
    EventQueue queue;
    queue.begin(100, numbers.order());
    queue.collect();
    for (int i = 100; i > 0; --i) queue.push(at(i));
    queue.spread(0, 100);
    EXPECT_EQ(queue.pop().time, 1);
    queue.forgetAfter(50);
    EXPECT_EQ(queue.dueCount(), 49u);
    queue.begin(20, numbers.order());
    queue.dropDue();
    queue.begin(100, numbers.order());
    const auto events = popAll(queue);
    ASSERT_EQ(events.size(), 30u);
    EXPECT_EQ(events.front().time, 21);
}

TEST(EventQueue, SharesOfAStepComeTogetherAgain) {
    const Numbers numbers;
    Random random(84);
    EventQueue whole;
    whole.begin(1, numbers.order());
    for (const PairEvent& event : shuffledEvents(random)) whole.push(event);
    std::vector<PairEvent> due;
    whole.forEachDue([&](const PairEvent& event) { due.push_back(event); });
    ASSERT_GT(due.size(), 20u);
    const std::size_t half = due.size() / 2;

    EventQueue first;
    EventQueue second;
    first.beginShare(whole, {due.data(), half});
    second.beginShare(whole, {due.data() + half, due.size() - half});
    EXPECT_EQ(first.dueCount(), half);
    first.pop();
    first.push(at(0.5, 3));
    second.push(at(5, 2));
    whole.dropDue();
    EXPECT_TRUE(whole.empty());
    whole.take(first);
    whole.take(second);
    EXPECT_TRUE(first.empty() && second.empty());

    const auto events = popAll(whole);
    ASSERT_EQ(events.size(), due.size());  // one is gone, and one is new
    EXPECT_EQ(keys(events.front()), keys(at(0.5, 3)));
    for (std::size_t i = 1; i < events.size(); ++i) {
        ASSERT_TRUE(whole.isLater(events[i], events[i - 1])) << i;
        ASSERT_FALSE(whole.isLater(events[i - 1], events[i])) << i;
    }
    whole.begin(5, numbers.order());
    EXPECT_EQ(whole.dueCount(), due.size() + 1) << "those of time 2, and the new one";
}

}  // namespace
}  // namespace quadrille
