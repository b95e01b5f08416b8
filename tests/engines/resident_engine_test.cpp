// An engine whose bodies lie on a device: they are fetched when they are read and sent when they
// were edited, and a device that fails loses nothing. The device here is one of the host's engines
// with bodies of its own; tests/gpu has the real one.

#include "engines/resident_engine.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "core/step_times.hpp"
#include "core/world_access.hpp"
#include "engines/fallback.hpp"
#include "engines/host_engine.hpp"

namespace quadrille {
namespace {

enum class Fails { Never, InLoad, InStep, InFetch };

/// What the device has done, and what it is to fail in.
struct Device {
    int loads = 0, steps = 0, fetches = 0;
    Fails fails = Fails::Never;
    int failsIn = 0;  ///< the call that fails, from 1

    void failIn(Fails here, int calls) const {
        if (fails == here && calls == failsIn) throw DeviceError("device: is lost");
    }
};
Device device;

/// A store with the same bodies.
std::unique_ptr<BodyStore> storeOf(const LawBodies<double>& bodies) {
    auto store = std::make_unique<BodyStore>();
    const auto& m = bodies.moving;
    for (std::size_t i = 0; i < m.size(); ++i) {
        store->append({.position = {m.x[i], m.y[i]},
                       .halfSize = {m.halfWidth[i], m.halfHeight[i]},
                       .velocity = {m.vx[i], m.vy[i]},
                       .mass = m.mass[i],
                       .isStatic = false,
                       .entity = m.entity[i]});
    }
    const auto& f = bodies.fixed;
    for (std::size_t i = 0; i < f.size(); ++i) {
        store->append({.position = {f.x[i], f.y[i]},
                       .halfSize = {f.halfWidth[i], f.halfHeight[i]},
                       .velocity = {0, 0},
                       .mass = 1,
                       .isStatic = true,
                       .entity = f.entity[i]});
    }
    return store;
}

/// Writes where a store's bodies are, and how fast.
void copyTo(const LawBodies<double>& bodies, const BodyStore& store) {
    const BodyView<double> here = store.read<double>();
    std::ranges::copy(here.moving.x, bodies.moving.x.begin());
    std::ranges::copy(here.moving.y, bodies.moving.y.begin());
    std::ranges::copy(here.moving.vx, bodies.moving.vx.begin());
    std::ranges::copy(here.moving.vy, bodies.moving.vy.begin());
}

SimulationConfig onOneCore(SimulationConfig config) {
    config.resolver = ResolverKind::Sequential;
    config.countMissedPairs = false;
    return config;
}

class FakePipeline final : public ResidentPipeline<double> {
  public:
    explicit FakePipeline(const SimulationConfig& config, const Vec2& worldSize)
        : engine_(onOneCore(config), worldSize) {}

    bool load(const LawBodies<double>& bodies, double, PhaseClock&) override {
        device.failIn(Fails::InLoad, ++device.loads);
        store_ = storeOf(bodies);
        return true;
    }
    double step(Step<double>& step) override {
        StepWindow window{
            .number = 1, .from = step.from, .to = step.to, .keepContacts = step.keepContacts};
        StepReport report;
        engine_.step(*store_, window, report);
        step.counts = {.events = 0,
                       .contacts = report.contacts,
                       .collisions = report.collisions,
                       .pairsTested = report.pairsTested};
        device.failIn(Fails::InStep, ++device.steps);
        return step.to;
    }
    void fetch(const LawBodies<double>& bodies) override {
        device.failIn(Fails::InFetch, ++device.fetches);
        copyTo(bodies, *store_);
    }
    const Cells& cells() override { return engine_.cells(); }
    std::span<const ContactRecord> contacts() override { return engine_.contacts(); }
    std::size_t bytes() const override { return 0; }

  private:
    HostEngine<double> engine_;
    std::unique_ptr<BodyStore> store_;
};

std::unique_ptr<ResidentPipeline<double>> makeFake(const SimulationConfig& config,
                                                   const Vec2& worldSize, const ThreadTeam&) {
    return std::make_unique<FakePipeline>(config, worldSize);
}

/// The same for the law `continuous`, which keeps anchors: of a step it does all, a part, or
/// nothing, one after the other.
class FakeExactPipeline final : public ResidentPipeline<double> {
  public:
    explicit FakeExactPipeline(const SimulationConfig& config, const Vec2& worldSize)
        : config_(onOneCore(config)), engine_(config_, worldSize) {}

    KeptColumns kept() const override { return {.anchors = true}; }
    bool load(const LawBodies<double>& bodies, double, PhaseClock&) override {
        device.failIn(Fails::InLoad, ++device.loads);
        store_ = storeOf(bodies);
        std::ranges::copy(bodies.anchors, advanced().anchors.begin());
        return true;
    }
    double step(Step<double>& step) override {
        constexpr double shares[] = {1, 1, 0.625, 1, 0};
        const double share = shares[device.steps % 5];
        const double to = share == 1 ? step.to : step.from + share * (step.to - step.from);
        device.failIn(Fails::InStep, ++device.steps);
        StepWindow window{
            .number = 1, .from = step.from, .to = to, .keepContacts = step.keepContacts};
        StepReport report;
        records_.clear();
        if (to == step.from) return to;
        engine_.step(*store_, window, report);
        const auto records = engine_.contacts();
        records_.assign(records.begin(), records.end());
        step.counts = {.events = 0,
                       .contacts = report.contacts,
                       .collisions = report.collisions,
                       .pairsTested = report.pairsTested};
        return to;
    }
    void fetch(const LawBodies<double>& bodies) override {
        device.failIn(Fails::InFetch, ++device.fetches);
        copyTo(bodies, *store_);
        std::ranges::copy(advanced().anchors, bodies.anchors.begin());
    }
    const Cells& cells() override { return engine_.cells(); }
    std::span<const ContactRecord> contacts() override { return records_; }
    std::size_t bytes() const override { return 0; }

  private:
    LawBodies<double> advanced() {
        return store_->advance<double>(kept(), physicsOf(config_.law, config_.step));
    }

    SimulationConfig config_;
    HostEngine<double> engine_;
    std::unique_ptr<BodyStore> store_;
    std::vector<ContactRecord> records_;
};

World scene() { return randomScene(SceneKind::Clustered, 61, 150, 150); }

SimulationConfig configured() {
    return {.partitioner = Quadtree{6, 5},
            .law = Law::Impulse,
            .resolver = ResolverKind::CudaResident,
            .step = {.gravity = {0, -30}, .restitution = 0.8}};
}

std::unique_ptr<Engine> residentEngine(const SimulationConfig& config = configured()) {
    return std::make_unique<ResidentEngine<double>>(config, scene().config().size, 2, makeFake);
}

std::unique_ptr<Engine> hostEngine() {
    SimulationConfig config = configured();
    config.resolver = ResolverKind::Sequential;
    return makeEngine(config, scene().config().size);
}

/// A world and an engine that steps it.
struct Stepped {
    std::unique_ptr<Engine> engine;
    World world = scene();
    std::uint64_t done = 0;

    StepReport step() {
        const StepTimes times(configured().step.dt);
        StepWindow window{.number = done + 1,
                          .from = times.at(done),
                          .to = times.at(done + 1),
                          .keepContacts = true};
        ++done;
        StepReport report;
        engine->step(WorldAccess::store(world), window, report);
        return report;
    }
};

/// Pushes a body, which is an edit.
void edit(World& world) {
    world.editBodies([](const auto& bodies) {
        if (bodies.moving.size() > 0) bodies.moving.vx[0] += 40;
    });
}

class ResidentEngineTest : public testing::Test {
  protected:
    void SetUp() override { device = {}; }
};

TEST_F(ResidentEngineTest, SendsAndFetchesNothingThatNobodyWants) {
    Stepped run{residentEngine()};
    for (int i = 0; i < 20; ++i) run.step();
    EXPECT_EQ(device.loads, 1);
    EXPECT_EQ(device.fetches, 0);
    stateHash(run.world);
    stateHash(run.world);
    EXPECT_EQ(device.fetches, 1);
    run.step();
    EXPECT_EQ(device.loads, 1) << "reading is no edit";
    edit(run.world);
    EXPECT_EQ(device.fetches, 2);
    run.step();
    EXPECT_EQ(device.loads, 2);
}

TEST_F(ResidentEngineTest, HasTheBitsOfTheHost) {
    Stepped host{hostEngine()};
    Stepped resident{residentEngine()};
    std::uint64_t contacts = 0;
    for (int i = 0; i < 40; ++i) {
        if (i % 9 == 4) {
            edit(host.world);
            edit(resident.world);
        }
        const StepReport expected = host.step();
        const StepReport found = resident.step();
        contacts += expected.contacts;
        EXPECT_EQ(found.contacts, expected.contacts);
        EXPECT_EQ(found.collisions, expected.collisions);
        EXPECT_EQ(resident.engine->contacts().size(), host.engine->contacts().size());
        if (i % 5 == 0) {
            EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
        }
    }
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    EXPECT_GT(contacts, 10u);
}

/// Whatever fails, and however many steps the host has not seen by then.
TEST_F(ResidentEngineTest, ADeviceThatFailsLosesNothing) {
    Stepped host{hostEngine()};
    for (int i = 0; i < 30; ++i) {
        if (i == 14) edit(host.world);
        host.step();
    }
    for (const Fails fails : {Fails::InLoad, Fails::InStep, Fails::InFetch}) {
        for (const int failsIn : {1, 2, 17}) {
            SCOPED_TRACE(std::to_string(static_cast<int>(fails)) + " in " +
                         std::to_string(failsIn));
            device = {.fails = fails, .failsIn = failsIn};
            Stepped resident{std::make_unique<FallbackEngine>([] { return residentEngine(); },
                                                              [] { return hostEngine(); })};
            for (int i = 0; i < 30; ++i) {
                if (i == 14) edit(resident.world);
                resident.step();
                if (i % 11 == 3) stateHash(resident.world);
            }
            EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
            if (failsIn < 3) {
                EXPECT_EQ(resident.engine->failure(), "device: is lost");
            }
        }
    }
}

TEST_F(ResidentEngineTest, WithoutAFallbackTheErrorLeavesTheWorldBeforeTheStep) {
    Stepped host{hostEngine()};
    for (int i = 0; i < 9; ++i) host.step();
    device = {.fails = Fails::InStep, .failsIn = 10};
    Stepped resident{residentEngine()};
    for (int i = 0; i < 9; ++i) resident.step();
    EXPECT_THROW(resident.step(), DeviceError);
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    EXPECT_THROW(resident.step(), DeviceError) << "a device that was lost stays so";
}

TEST_F(ResidentEngineTest, LeavesTheWorldWhatItAloneKnew) {
    Stepped host{hostEngine()};
    Stepped resident{residentEngine()};
    for (int i = 0; i < 12; ++i) {
        host.step();
        resident.step();
    }
    resident.engine = hostEngine();  // as when a simulation is reconfigured
    EXPECT_EQ(device.fetches, 1);
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    host.step();
    resident.step();
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
}

TEST_F(ResidentEngineTest, AWorldThatEndsFirstIsNotWrittenTo) {
    auto engine = residentEngine();
    {
        Stepped run{std::move(engine)};
        run.step();
        engine = std::move(run.engine);
    }
    engine.reset();
    EXPECT_EQ(device.fetches, 0);
}

TEST_F(ResidentEngineTest, StepsThatAreAuditedAreTheHosts) {
    SimulationConfig config = configured();
    config.countMissedPairs = true;
    config.missedPairsEvery = 3;
    Stepped host{hostEngine()};
    Stepped resident{residentEngine(config)};
    int audited = 0;
    for (int i = 0; i < 30; ++i) {
        const StepReport expected = host.step();
        const StepReport found = resident.step();
        audited += found.audited;
        EXPECT_EQ(found.contacts, expected.contacts);
        EXPECT_EQ(found.missedPairs, 0u);
        EXPECT_EQ(resident.engine->contacts().size(), host.engine->contacts().size());
    }
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    EXPECT_GT(audited, 1);
    EXPECT_LT(device.steps, 30);
    EXPECT_GT(device.steps, 1);
}

TEST_F(ResidentEngineTest, FollowsStaticBodiesThatComeAndGo) {
    Stepped host{hostEngine()};
    Stepped resident{residentEngine()};
    Entity wall;
    for (int i = 0; i < 30; ++i) {
        for (Stepped* run : {&host, &resident}) {
            if (i == 10) wall = makeBox(run->world, {0, 0}, fixed(), {20, 20});
            if (i == 20) run->world.destroy(wall);
            run->world.flush();
            run->step();
        }
        EXPECT_EQ(resident.engine->contacts().size(), host.engine->contacts().size());
    }
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    EXPECT_EQ(device.steps, 30);
    EXPECT_EQ(device.loads, 3);
}

/// Simulation::resumeAt counts on from another number.
TEST_F(ResidentEngineTest, StepsMayBeNumberedAnew) {
    Stepped host{hostEngine()};
    Stepped resident{residentEngine()};
    device.fails = Fails::InStep;
    device.failsIn = 9;
    for (int i = 0; i < 9; ++i) {
        if (i == 5) resident.done = 1;
        host.step();
        if (i < 8) {
            resident.step();
        } else {
            EXPECT_THROW(resident.step(), DeviceError);
            resident.engine = hostEngine();
            --resident.done;
            resident.step();
        }
    }
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
}

std::unique_ptr<ResidentPipeline<double>> makeFakeExact(const SimulationConfig& config,
                                                        const Vec2& worldSize, const ThreadTeam&) {
    return std::make_unique<FakeExactPipeline>(config, worldSize);
}

/// Steps of an exact law that the device does in part, or not at all; with edits in between.
TEST_F(ResidentEngineTest, TheHostGoesOnWhereTheDeviceStopped) {
    SimulationConfig config = configured();
    config.law = Law::Continuous;
    config.step = {};
    SimulationConfig hosts = config;
    hosts.resolver = ResolverKind::Sequential;
    const Vec2 size = scene().config().size;
    Stepped host{makeEngine(hosts, size)};
    Stepped resident{std::make_unique<ResidentEngine<double>>(config, size, 2, makeFakeExact)};
    std::uint64_t contacts = 0;
    int left = 0;
    for (int i = 0; i < 120; ++i) {
        SCOPED_TRACE(i);
        if (i % 29 == 28) {
            edit(host.world);
            edit(resident.world);
        }
        const StepReport expected = host.step();
        const StepReport found = resident.step();
        contacts += expected.contacts;
        left += found.leftToHost;
        ASSERT_EQ(found.contacts, expected.contacts);
        ASSERT_EQ(found.collisions, expected.collisions);
        const auto records = host.engine->contacts();
        const auto others = resident.engine->contacts();
        ASSERT_EQ(others.size(), records.size());
        for (std::size_t k = 0; k < records.size(); ++k) {
            ASSERT_EQ(others[k].time, records[k].time);
            ASSERT_EQ(others[k].impulseX, records[k].impulseX);
        }
        if (i % 3 == 0) {
            ASSERT_EQ(stateHash(resident.world), stateHash(host.world));
        }
    }
    EXPECT_EQ(stateHash(resident.world), stateHash(host.world));
    EXPECT_GT(contacts, 100u);
    EXPECT_GT(device.steps, 20);
    EXPECT_GT(left, 5);
    EXPECT_LT(left, 110);
}

/// A pipeline that knows what time it is must not be told another one.
TEST_F(ResidentEngineTest, BodiesThatKeepAnchorsAreSentAgainWhenStepsAreNumberedAnew) {
    SimulationConfig config = configured();
    config.law = Law::Continuous;
    config.step = {};
    Stepped run{
        std::make_unique<ResidentEngine<double>>(config, scene().config().size, 2, makeFakeExact)};
    run.step();
    run.step();
    stateHash(run.world);
    EXPECT_EQ(device.loads, 1);
    run.step();
    EXPECT_EQ(device.loads, 1) << "reading is no edit";
    stateHash(run.world);
    run.done = 40;
    run.step();
    EXPECT_EQ(device.loads, 2);
}

}  // namespace
}  // namespace quadrille
