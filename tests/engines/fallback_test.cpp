// What happens without a device, or when one fails on the way: the engine that takes over gives
// what it would have given from the start. That real devices fail is tested in tests/gpu.

#include "engines/fallback.hpp"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/random_scene.hpp"
#include "core/step_times.hpp"
#include "core/world_access.hpp"
#include "engines/host_engine.hpp"
#include "engines/registry.hpp"

namespace quadrille {
namespace {

World twoBoxes() {
    World world({.size = {100, 100}});
    for (const double side : {-1.0, 1.0}) {
        world.add(world.create(), Transform{{4 * side, 0}}, BoxCollider{{2, 2}},
                  PhysicsBody{.velocity = {-30 * side, 0}});
    }
    return world;
}

TEST(MissingDevice, IsAnErrorThatSaysWhy) {
    const CudaDevice device = findCudaDevice();
    if (device.usable()) GTEST_SKIP() << "there is a device";
    EXPECT_FALSE(device.reason.empty());
    try {
        Simulation(twoBoxes(), {.law = Law::Impulse, .resolver = ResolverKind::Cuda});
        FAIL() << "no error";
    } catch (const DeviceError& error) {
        EXPECT_EQ(std::string(error.what()), "cuda: " + device.reason);
    }
}

TEST(MissingDevice, IsReplacedWhereThatIsAllowed) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device";
    Simulation sim(twoBoxes(),
                   {.law = Law::Impulse, .resolver = ResolverKind::Cuda, .fallback = true});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_FALSE(sim.resolverFailure().empty());
    sim.setPartitioner(Quadtree{});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_FALSE(sim.resolverFailure().empty());
    Simulation sequential(twoBoxes());
    EXPECT_EQ(sequential.resolverFailure(), "");
    sim.run(20);
    sequential.run(20);
    EXPECT_EQ(stateHash(sim.world()), stateHash(sequential.world()));
}

TEST(MissingDevice, LeavesThePartitionToTheThreads) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device";
    const auto crowd = [] {
        return loadScene(QUADRILLE_SCENES_DIR "/balanced.toml", {.entities = 20'000}).world;
    };
    for (const PartitionerConfig& partitioner :
         {PartitionerConfig(Quadtree{}), PartitionerConfig(SemiStaticQuadtree{})}) {
        Simulation sim(crowd(), {.partitioner = partitioner,
                                 .law = Law::Impulse,
                                 .resolver = ResolverKind::Cuda,
                                 .threads = 3,
                                 .fallback = true});
        EXPECT_EQ(sim.threads(), 3);
        Simulation sequential(crowd(), {.partitioner = partitioner, .law = Law::Impulse});
        EXPECT_EQ(sequential.threads(), 1);
        sim.run(5);
        sequential.run(5);
        EXPECT_EQ(stateHash(sim.world()), stateHash(sequential.world()));
    }
}

TEST(CudaOptions, BlockSizesThatCannotBeAreRefused) {
    for (const int size : {0, -32, 16, 33, 1056}) {
        EXPECT_THROW(Simulation(twoBoxes(), {.cuda = {.blockSize = size}}), Error) << size;
    }
}

// ---- engines that fail, in the hands of FallbackEngine

/// When an engine loses its device.
enum class Fails { AtConstruction, BeforeTheStep, InTheStep, Never };

std::ostream& operator<<(std::ostream& out, Fails fails) {
    constexpr const char* names[] = {"at construction", "before the step", "in the step", "never"};
    return out << names[static_cast<std::size_t>(fails)];
}

/// An engine as HostEngine is one, up to the step in which its device fails.
template <class Real>
class FailingEngine final : public Engine {
  public:
    FailingEngine(const SimulationConfig& config, const Vec2& worldSize, Fails fails,
                  std::uint64_t failsIn)
        : config_(config),
          engine_(config, worldSize),
          law_(makeLaw<Real>(config, ThreadTeam::serial())),
          fails_(fails),
          failsIn_(failsIn) {
        if (fails == Fails::AtConstruction) throw DeviceError("device: is not there");
    }

    void step(BodyStore& store, StepWindow& window, StepReport& report) override {
        if (window.number != failsIn_ || fails_ == Fails::Never) {
            engine_.step(store, window, report);
            return;
        }
        if (fails_ == Fails::InTheStep) {
            // What such an engine has done by then: begun, partitioned, counted.
            const LawBodies<Real> bodies = store.advance<Real>(law_->kept());
            PhaseClock clock(report, false);
            Step<Real> step{.parameters = parametersOf<Real>(config_.step, window.from),
                            .from = window.from,
                            .to = window.to,
                            .keepContacts = false,
                            .clock = clock};
            law_->begin(bodies, step);
            window.begun = true;
            report.overlappingPairs += 1000;
            report.missedPairs += 1000;
        }
        throw DeviceError("device: is lost");
    }

    const Cells& cells() const override { return engine_.cells(); }
    std::span<const ContactRecord> contacts() override { return engine_.contacts(); }
    ResolverKind resolver() const override { return ResolverKind::Cuda; }
    const std::string& failure() const override { return engine_.failure(); }
    unsigned threads() const override { return engine_.threads(); }
    std::size_t bytes() const override { return engine_.bytes(); }

  private:
    SimulationConfig config_;
    HostEngine<Real> engine_;
    std::unique_ptr<ContactLaw<Real>> law_;
    Fails fails_;
    std::uint64_t failsIn_;
};

/// What each step shows of itself.
struct Seen {
    std::uint64_t hash, contacts, collisions, pairsTested, overlappingPairs, missedPairs;
    std::size_t records, cells;

    friend bool operator==(const Seen&, const Seen&) = default;
};

std::ostream& operator<<(std::ostream& out, const Seen& s) {
    return out << std::hex << s.hash << std::dec << ", " << s.contacts << " contacts, "
               << s.collisions << " collisions, " << s.pairsTested << " pairs, "
               << s.overlappingPairs << " overlap, " << s.missedPairs << " missed, " << s.records
               << " records, " << s.cells << " cells";
}

std::vector<Seen> stepsOf(Engine& engine, World world, const SimulationConfig& config, int steps) {
    world.setPrecision(config.precision);
    std::vector<Seen> result;
    const StepTimes times(config.step.dt);
    for (int i = 0; i < steps; ++i) {
        const auto number = static_cast<std::uint64_t>(i);
        StepWindow window{.number = number + 1,
                          .from = times.at(number),
                          .to = times.at(number + 1),
                          .keepContacts = true};
        StepReport report;
        engine.step(WorldAccess::store(world), window, report);
        EXPECT_TRUE(window.begun);
        result.push_back({stateHash(world), report.contacts, report.collisions, report.pairsTested,
                          report.overlappingPairs, report.missedPairs, engine.contacts().size(),
                          engine.cells().size()});
    }
    return result;
}

struct Fallback {
    Law law;
    Precision precision;
    Fails fails;
};

std::ostream& operator<<(std::ostream& out, const Fallback& f) {
    return out << name(f.law) << ", " << name(f.precision) << ", " << f.fails;
}

std::vector<Fallback> fallbacks() {
    std::vector<Fallback> result;
    for (const Law law : {Law::Baseline, Law::Impulse}) {
        for (const Precision precision : {Precision::Double, Precision::Float}) {
            for (const Fails fails :
                 {Fails::AtConstruction, Fails::BeforeTheStep, Fails::InTheStep, Fails::Never}) {
                result.push_back({law, precision, fails});
            }
        }
    }
    return result;
}

class FallbackTest : public testing::TestWithParam<Fallback> {
  protected:
    static World scene() { return randomScene(SceneKind::Clustered, 61, 150, 150); }
    SimulationConfig config() const {
        return {.partitioner = Quadtree{6, 5},
                .law = GetParam().law,
                .precision = GetParam().precision,
                .step = {.gravity = {0, -30}, .restitution = 0.8},
                .countMissedPairs = true};
    }
    std::unique_ptr<Engine> sequential() const {
        return makeEngine(config(), scene().config().size);
    }
    std::unique_ptr<Engine> failing(std::uint64_t step) const {
        const Vec2 size = scene().config().size;
        if (GetParam().precision == Precision::Double) {
            return std::make_unique<FailingEngine<double>>(config(), size, GetParam().fails, step);
        }
        return std::make_unique<FailingEngine<float>>(config(), size, GetParam().fails, step);
    }
};

INSTANTIATE_TEST_SUITE_P(Engines, FallbackTest, testing::ValuesIn(fallbacks()));

TEST_P(FallbackTest, TheResultIsThatOfAnEngineThatNeverFailed) {
    const auto expected = stepsOf(*sequential(), scene(), config(), 12);
    ASSERT_GE(expected.back().contacts, 10u);
    for (const std::uint64_t step : {1u, 6u, 12u}) {
        SCOPED_TRACE("step " + std::to_string(step));
        int made = 0;
        FallbackEngine engine([&] { return failing(step); },
                              [&] {
                                  ++made;
                                  return sequential();
                              });
        const bool atOnce = GetParam().fails == Fails::AtConstruction;
        EXPECT_EQ(made, atOnce ? 1 : 0) << "a substitute is made when it is needed";
        EXPECT_EQ(engine.failure(), atOnce ? "device: is not there" : "");
        EXPECT_EQ(stepsOf(engine, scene(), config(), 12), expected);
        const bool never = GetParam().fails == Fails::Never;
        EXPECT_EQ(made, never ? 0 : 1);
        EXPECT_EQ(engine.resolver(), never ? ResolverKind::Cuda : ResolverKind::Sequential);
        EXPECT_EQ(engine.failure(), never    ? ""
                                    : atOnce ? "device: is not there"
                                             : "device: is lost");
    }
}

TEST(FallbackEngineErrors, OfAnotherKindGoThrough) {
    // What is wrong with the bodies or the configuration no other engine would mend.
    const auto refuse = []() -> std::unique_ptr<Engine> { throw NotAvailable("no such law"); };
    const auto never = []() -> std::unique_ptr<Engine> {
        ADD_FAILURE() << "nobody needs a substitute";
        return nullptr;
    };
    EXPECT_THROW(FallbackEngine(refuse, never), NotAvailable);

    World world;
    const Entity fast = world.create();
    world.add(fast, Transform{}, BoxCollider{}, PhysicsBody{.velocity = {1e308, 0}});
    const SimulationConfig config{.partitioner = Quadtree{}, .step = {.dt = 1}};
    FallbackEngine engine([&] { return makeEngine(config, world.config().size); }, never);
    EXPECT_THROW(stepsOf(engine, std::move(world), config, 5), Error);
    EXPECT_EQ(engine.failure(), "");
}

TEST(FallbackEngineErrors, OfTheSubstituteGoThrough) {
    const auto fail = []() -> std::unique_ptr<Engine> { throw DeviceError("none"); };
    EXPECT_THROW(FallbackEngine(fail, fail), DeviceError);
}

}  // namespace
}  // namespace quadrille
