#include "lockstep.hpp"

#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

namespace quadrille {

namespace {

struct Run {
    Simulation simulation;

    Run(World world, SimulationConfig config, ResolverKind resolver, bool keepContacts)
        : simulation(std::move(world), [&] {
              config.resolver = resolver;
              config.keepContacts = keepContacts;
              return config;
          }()) {}

    const StepReport& step(const Edit& edit, std::uint64_t number) {
        if (edit) edit(simulation.world(), number);
        return simulation.step();
    }
};

auto fields(const Contact& c) {
    return std::tuple(c.a.index, c.a.generation, c.b.index, c.b.generation, c.time, c.axis,
                      c.normal.x(), c.normal.y(), c.collided, c.impulse.x(), c.impulse.y(),
                      c.approach.x(), c.approach.y(), c.numberA, c.numberB);
}

}  // namespace

void expectSameContacts(std::span<const Contact> found, std::span<const Contact> expected) {
    EXPECT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size() && i < expected.size(); ++i) {
        if (fields(found[i]) == fields(expected[i])) continue;
        ADD_FAILURE() << "contact " << i << " of " << found.size() << " differs: of entities "
                      << found[i].a.index << " and " << found[i].b.index << ", expected "
                      << expected[i].a.index << " and " << expected[i].b.index;
        break;
    }
}

std::uint64_t expectLockstep(const MakeWorld& makeWorld, const SimulationConfig& config,
                             std::uint64_t steps, const Edit& edit) {
    const ResolverKind resolver =
        needsDevice(config.resolver) ? config.resolver : ResolverKind::Cuda;
    // Where the device makes the cells, those of another partitioner than the grid are others.
    // An exact law is free to choose how long a partition lasts.
    const bool samePairs =
        config.law != Law::Continuous &&
        (resolver == ResolverKind::Cuda || std::holds_alternative<StaticGrid>(config.partitioner));
    Run host(makeWorld(), config, ResolverKind::Sequential, true);
    Run device(makeWorld(), config, resolver, true);
    Run silent(makeWorld(), config, resolver, false);
    std::uint64_t contacts = 0;
    for (std::uint64_t step = 0; step < steps; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const StepReport expected = host.step(edit, step);
        const StepReport found = device.step(edit, step);
        silent.step(edit, step);
        contacts += expected.contacts;

        EXPECT_EQ(found.contacts, expected.contacts);
        EXPECT_EQ(found.collisions, expected.collisions);
        if (samePairs) {
            EXPECT_EQ(found.pairsTested, expected.pairsTested);
        }
        expectSameContacts(device.simulation.contacts(), host.simulation.contacts());
        const std::uint64_t hash = stateHash(host.simulation.world());
        EXPECT_EQ(stateHash(device.simulation.world()), hash);
        EXPECT_EQ(stateHash(silent.simulation.world()), hash);
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_EQ(device.simulation.resolverFailure(), "");
    EXPECT_EQ(device.simulation.config().resolver, resolver);
    return contacts;
}

}  // namespace quadrille
