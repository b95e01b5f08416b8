#include "thread_checks.hpp"

#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>

#include <quadrille/state_hash.hpp>

#include "core/step_times.hpp"
#include "core/world_access.hpp"
#include "engines/host_engine.hpp"

namespace quadrille {

namespace {

auto keysOf(const ContactRecord& r) {
    return std::tuple(r.time, r.a, r.b.bits, r.axes, r.senseX, r.senseY, r.collided, r.impulseX,
                      r.impulseY, r.approachX, r.approachY);
}

/// All that a step shows of itself.
struct Seen {
    std::uint64_t hash, contacts, collisions, pairsTested;
    bool rebuilt;
    std::vector<std::uint32_t> offsets;
    std::vector<BodyRef> bodies;
    std::vector<ContactRecord> records;
};

void expectEqual(const Seen& seen, const Seen& expected) {
    EXPECT_EQ(seen.hash, expected.hash);
    EXPECT_EQ(seen.contacts, expected.contacts);
    EXPECT_EQ(seen.collisions, expected.collisions);
    EXPECT_EQ(seen.pairsTested, expected.pairsTested);
    EXPECT_EQ(seen.rebuilt, expected.rebuilt);
    EXPECT_TRUE(seen.offsets == expected.offsets && seen.bodies == expected.bodies);
    ASSERT_EQ(seen.records.size(), expected.records.size());
    for (std::size_t i = 0; i < seen.records.size(); ++i) {
        ASSERT_EQ(keysOf(seen.records[i]), keysOf(expected.records[i])) << "contact " << i;
    }
}

/// Steps of a world whose loops are shared out however short they are.
template <class Real>
std::vector<Seen> stepsOf(World world, const SimulationConfig& config, std::uint64_t steps,
                          bool record, const std::function<void(World&, std::uint64_t)>& edit) {
    world.setPrecision(config.precision);
    HostEngine<Real> engine(config, world.config().size, Thresholds::none());
    const StepTimes times(config.step.dt);
    std::vector<Seen> result;
    for (std::uint64_t number = 1; number <= steps; ++number) {
        edit(world, number);
        world.flush();
        StepReport report;
        Seen seen{};
        StepWindow window{.number = number,
                          .from = times.at(number - 1),
                          .to = times.at(number),
                          .keepContacts = record};
        engine.step(WorldAccess::store(world), window, report);
        if (record) {
            const auto contacts = engine.contacts();
            seen.records.assign(contacts.begin(), contacts.end());
        }
        seen.hash = stateHash(world);
        seen.contacts = report.contacts;
        seen.collisions = report.collisions;
        seen.pairsTested = report.pairsTested;
        seen.rebuilt = report.rebuilt;
        seen.offsets = engine.cells().offsets;
        seen.bodies = engine.cells().bodies;
        result.push_back(std::move(seen));
    }
    return result;
}

}  // namespace

void expectTheSameOnThreads(const std::function<World()>& makeWorld, SimulationConfig config,
                            std::uint64_t steps, const std::vector<int>& threads,
                            const std::function<void(World&, std::uint64_t)>& edit) {
    const auto run = [&](bool record) {
        return config.precision == Precision::Double
                   ? stepsOf<double>(makeWorld(), config, steps, record, edit)
                   : stepsOf<float>(makeWorld(), config, steps, record, edit);
    };
    config.resolver = ResolverKind::Sequential;
    const auto recorded = run(true);
    config.resolver = ResolverKind::Threads;
    for (const int count : threads) {
        for (const bool record : {false, true}) {
            SCOPED_TRACE(std::to_string(count) + " threads" + (record ? ", recorded" : ""));
            config.threads = count;
            const auto seen = run(record);
            for (std::size_t i = 0; i < seen.size(); ++i) {
                SCOPED_TRACE("step " + std::to_string(i + 1));
                Seen expected = recorded[i];
                if (!record) expected.records.clear();
                ASSERT_NO_FATAL_FAILURE(expectEqual(seen[i], expected));
                if (testing::Test::HasFailure()) return;
            }
        }
    }
}

}  // namespace quadrille
