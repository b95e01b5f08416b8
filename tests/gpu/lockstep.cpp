#include "lockstep.hpp"

#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include <quadrille/measure.hpp>

namespace quadrille {

namespace {

auto fields(const Contact& c) {
    return std::tuple(c.a.index, c.a.generation, c.b.index, c.b.generation, c.time, c.axis,
                      c.normal.x(), c.normal.y(), c.collided, c.rowA, c.rowB);
}

struct Run {
    Simulation simulation;
    std::vector<Contact> contacts;

    Run(World world, SimulationConfig config, ResolverKind resolver)
        : simulation(std::move(world), [&] {
              config.resolver = resolver;
              return config;
          }()) {}

    void listen() {
        simulation.onContact([this](const Contact& c) { contacts.push_back(c); });
    }
    const StepReport& step(const Edit& edit, std::uint64_t number) {
        contacts.clear();
        if (edit) edit(simulation.world(), number);
        return simulation.step();
    }
};

}  // namespace

std::uint64_t expectLockstep(const MakeWorld& makeWorld, const SimulationConfig& config,
                             std::uint64_t steps, const Edit& edit) {
    Run host(makeWorld(), config, ResolverKind::Sequential);
    Run device(makeWorld(), config, ResolverKind::Cuda);
    Run silent(makeWorld(), config, ResolverKind::Cuda);
    host.listen();
    device.listen();
    std::uint64_t contacts = 0;
    for (std::uint64_t step = 0; step < steps; ++step) {
        const StepReport expected = host.step(edit, step);
        const StepReport found = device.step(edit, step);
        silent.step(edit, step);
        contacts += expected.contacts;

        EXPECT_EQ(found.contacts, expected.contacts) << "step " << step;
        EXPECT_EQ(found.collisions, expected.collisions) << "step " << step;
        EXPECT_EQ(found.pairsTested, expected.pairsTested) << "step " << step;
        EXPECT_EQ(device.contacts.size(), host.contacts.size()) << "step " << step;
        for (std::size_t i = 0; i < device.contacts.size() && i < host.contacts.size(); ++i) {
            if (fields(device.contacts[i]) == fields(host.contacts[i])) continue;
            ADD_FAILURE() << "step " << step << ": contact " << i << " differs";
            break;
        }
        const std::uint64_t hash = stateHash(host.simulation.world());
        EXPECT_EQ(stateHash(device.simulation.world()), hash) << "step " << step;
        EXPECT_EQ(stateHash(silent.simulation.world()), hash) << "step " << step;
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_EQ(device.simulation.resolverFailure(), "");
    EXPECT_EQ(device.simulation.config().resolver, ResolverKind::Cuda);
    return contacts;
}

}  // namespace quadrille
