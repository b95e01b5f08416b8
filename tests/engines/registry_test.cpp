// What runs where is one table: makeEngine makes what it lists, and refuses by name what it does
// not.

#include "engines/registry.hpp"

#include <cstddef>
#include <gtest/gtest.h>
#include <string>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>

#include "core/engine.hpp"

namespace quadrille {
namespace {

constexpr Vec2::Scalar side = 100;

enum class Made { Yes, NoDevice, NotAvailable };

Made tryToMake(const SimulationConfig& config) {
    try {
        const auto engine = makeEngine(config, Vec2(side, side));
        EXPECT_EQ(engine->resolver(), config.resolver);
        EXPECT_EQ(engine->failure(), "");
        return Made::Yes;
    } catch (const DeviceError&) {
        return Made::NoDevice;
    } catch (const NotAvailable& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(name(config.law)), std::string::npos) << text;
        EXPECT_NE(text.find(name(config.resolver)), std::string::npos) << text;
        return Made::NotAvailable;
    }
}

TEST(Registry, EveryPairRunsAsTheTableSays) {
    const bool device = findCudaDevice().usable();
    for (const auto& law : laws()) {
        for (const auto& resolver : resolvers()) {
            if (resolver.kind == ResolverKind::Auto) continue;
            for (const auto& precision : precisions()) {
                SCOPED_TRACE(std::string(law.name) + " on " + std::string(resolver.name) + " in " +
                             std::string(precision.name));
                const Made made = tryToMake({.law = law.kind,
                                             .precision = precision.kind,
                                             .resolver = resolver.kind,
                                             .threads = 2});
                const Made expected = !runsOn(law.kind, resolver.kind)        ? Made::NotAvailable
                                      : needsDevice(resolver.kind) && !device ? Made::NoDevice
                                                                              : Made::Yes;
                EXPECT_EQ(made, expected);
            }
        }
    }
}

TEST(Registry, EveryLawRunsOnOneCore) {
    for (const auto& law : laws()) {
        EXPECT_TRUE(runsOn(law.kind, ResolverKind::Sequential)) << law.name;
        EXPECT_TRUE(runsOn(law.kind, ResolverKind::Auto)) << law.name;
    }
    EXPECT_FALSE(runsOn(Law::Baseline, ResolverKind::Threads))
        << "it resolves in the order of the cells, one after the other";
}

TEST(Registry, AFallbackDoesNotRunWhatTheResolverCannot) {
    for (const ResolverKind resolver : {ResolverKind::Cuda, ResolverKind::CudaResident}) {
        SimulationConfig config{.law = Law::Continuous, .resolver = resolver};
        config.fallback = true;
        if (runsOn(config.law, config.resolver)) continue;
        EXPECT_EQ(tryToMake(config), Made::NotAvailable) << name(resolver);
    }
}

/// It would give other results: those of a partition that misses nothing.
TEST(Registry, ResidentCellsAreNotThoseOfATreeThatMissesPairs) {
    SimulationConfig config{.law = Law::Impulse, .resolver = ResolverKind::CudaResident};
    config.partitioner = SemiStaticQuadtree{10, 20, SemiStaticQuadtree::EveryFrames{10}};
    for (const bool fallback : {false, true}) {
        config.fallback = fallback;
        EXPECT_THROW(makeEngine(config, Vec2(side, side)), NotAvailable);
    }
    config.partitioner = StaticGrid{{-1, 1}};
    EXPECT_THROW(makeEngine(config, Vec2(side, side)), Error);
}

TEST(Registry, ThreadsAreThoseAskedForOrOneForEachCore) {
    EXPECT_EQ(threadsOf({.resolver = ResolverKind::Sequential, .threads = 7}), 1u);
    EXPECT_EQ(threadsOf({.resolver = ResolverKind::Threads, .threads = 7}), 7u);
    EXPECT_EQ(threadsOf({.resolver = ResolverKind::Cuda, .threads = 7}), 7u)
        << "the partition is the host's";
    EXPECT_EQ(threadsOf({.resolver = ResolverKind::Threads}), unsigned(Simulation::cores()));
}

// ---- auto

ResolverKind chosen(Law law, int threads, std::size_t moving) {
    return chooseResolver({.law = law, .resolver = ResolverKind::Auto, .threads = threads}, moving);
}

TEST(Auto, TakesOneCoreForFewBodies) {
    for (const auto& law : laws()) {
        for (const std::size_t moving : {0u, 1u, 1000u, 4999u}) {
            EXPECT_EQ(chosen(law.kind, 16, moving), ResolverKind::Sequential) << law.name;
        }
    }
}

TEST(Auto, TakesThreadsForManyBodies) {
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        EXPECT_EQ(chosen(law, 4, 5'000), ResolverKind::Threads) << name(law);
        EXPECT_EQ(chosen(law, 2, 9'999), ResolverKind::Sequential) << name(law);
        if (findCudaDevice().usable()) continue;
        EXPECT_EQ(chosen(law, 2, 10'000), ResolverKind::Threads) << name(law);
        EXPECT_EQ(chosen(law, 1, 1'000'000), ResolverKind::Sequential) << name(law);
    }
}

TEST(Auto, TakesADeviceForManyBodiesIfThereIsOne) {
    if (!findCudaDevice().usable()) GTEST_SKIP() << "there is none";
    EXPECT_EQ(chosen(Law::Impulse, 16, 10'000), ResolverKind::Cuda);
    EXPECT_EQ(chosen(Law::Impulse, 16, 9'999), ResolverKind::Threads);
    EXPECT_EQ(chosen(Law::Continuous, 16, 10'000), ResolverKind::CudaResident);
    EXPECT_EQ(chosen(Law::Continuous, 16, 9'999), ResolverKind::Threads);
    SimulationConfig falling{.law = Law::Continuous, .resolver = ResolverKind::Auto, .threads = 16};
    falling.step.gravity = {0, -10};
    EXPECT_EQ(chooseResolver(falling, 1'000'000), ResolverKind::Threads)
        << "the device would leave each step to the host";
}

TEST(Auto, TakesOnlyWhatRunsTheLaw) {
    for (const auto& law : laws()) {
        for (const int threads : {0, 1, 2, 16}) {
            for (const std::size_t moving : {0u, 5'000u, 10'000u, 1'000'000u}) {
                const ResolverKind kind = chosen(law.kind, threads, moving);
                EXPECT_NE(kind, ResolverKind::Auto);
                EXPECT_TRUE(runsOn(law.kind, kind)) << law.name << " on " << name(kind);
                EXPECT_NE(needsDevice(kind) && !findCudaDevice().usable(), true);
            }
        }
    }
}

TEST(Auto, IsReplacedInASimulationByWhatItStandsFor) {
    Simulation sim(World{}, {.resolver = ResolverKind::Auto});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_EQ(sim.resolverFailure(), "");
    SimulationConfig config = sim.config();
    config.resolver = ResolverKind::Threads;
    config.threads = 2;
    sim.reconfigure(config);
    EXPECT_EQ(sim.config().resolver, ResolverKind::Threads);
    config.resolver = ResolverKind::Auto;
    sim.reconfigure(config);
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    sim.run(2);
}

}  // namespace
}  // namespace quadrille
