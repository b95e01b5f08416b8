// The past of a run is the run: what is shown of it has the bits that it had.

#include "app/window/timeline.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

namespace quadrille::app {
namespace {

Simulation crowd(const SimulationConfig& config, const std::string& scene = "imbalanced-clear",
                 std::uint64_t entities = 100) {
    Scene loaded = loadScene(std::string(QUADRILLE_SCENES_DIR) + "/" + scene + ".toml",
                             {.entities = entities});
    SimulationConfig complete = config;
    complete.step = loaded.step;
    return Simulation(std::move(loaded.world), complete);
}

constexpr auto patient = Timeline::Clock::time_point::max();

/// Goes to a step, which must have the bits that the run had there.
void expectPast(Timeline& timeline, const std::vector<std::uint64_t>& hashes, std::uint64_t step) {
    ASSERT_TRUE(timeline.goTo(step, patient)) << step;
    EXPECT_EQ(timeline.past().stepsDone(), step);
    EXPECT_EQ(stateHash(timeline.past().world()), hashes[step]) << step;
    EXPECT_EQ(timeline.hashAt(step), hashes[step]) << step;
}

/// The hashes of a run's states, from its start.
std::vector<std::uint64_t> runOn(Simulation& run, Timeline& timeline, int steps) {
    std::vector<std::uint64_t> hashes = {stateHash(run.world())};
    for (int i = 0; i < steps; ++i) {
        run.step();
        timeline.record();
        hashes.push_back(stateHash(run.world()));
    }
    return hashes;
}

const std::vector<std::uint64_t> places = {150, 149, 148, 3, 0, 77, 78, 79, 78, 20, 150, 1};

TEST(Timeline, TheStepsOfEveryLawHaveTheBitsThatTheyHad) {
    for (const Law law : {Law::Continuous, Law::Impulse, Law::Baseline}) {
        for (const bool roomy : {true, false}) {
            SCOPED_TRACE(std::string(name(law)) + (roomy ? "" : ", little memory"));
            Simulation run = crowd({.law = law});
            // Without room for all, of the law that cannot make its steps again the oldest are
            // gone.
            const std::size_t few = law == Law::Baseline ? 400 : 12;
            Timeline timeline(roomy ? 1'000'000'000 : few * 2 * run.world().bytes());
            timeline.begin(run);
            const auto hashes = runOn(run, timeline, 150);
            EXPECT_EQ(timeline.first(), 0u);
            EXPECT_EQ(timeline.last(), 150u);
            for (const std::uint64_t step : places) expectPast(timeline, hashes, step);
            EXPECT_EQ(stateHash(run.world()), hashes[150]);  // stays where it is
            EXPECT_EQ(run.stepsDone(), 150u);
        }
    }
}

TEST(Timeline, UnderGravityAndAtRestTheBitsAreTheSame) {
    Simulation run = crowd({.law = Law::Continuous}, "pile", 60);
    Timeline timeline(20 * run.world().bytes());
    timeline.begin(run);
    const auto hashes = runOn(run, timeline, 240);
    for (const std::uint64_t step : {240, 239, 238, 100, 5, 200}) {
        expectPast(timeline, hashes, step);
    }
}

TEST(Timeline, MemoryIsBounded) {
    for (const Law law : {Law::Continuous, Law::Baseline}) {
        Simulation run = crowd({.law = law});
        const std::size_t memory = 40 * run.world().bytes();
        Timeline timeline(memory);
        timeline.begin(run);
        const auto hashes = runOn(run, timeline, 200);
        EXPECT_LE(timeline.bytes(), memory + 8 * hashes.size());
        for (std::uint64_t step = 200; step > timeline.first(); step -= 3) {
            expectPast(timeline, hashes, step);
            EXPECT_LE(timeline.bytes(), memory + 8 * hashes.size());
            if (step < 3) break;
        }
        if (law == Law::Baseline) {
            EXPECT_GT(timeline.first(), 100u);
        }
    }
}

TEST(Timeline, ALawThatWasChangedIsChangedInThePastToo) {
    Simulation run = crowd({.law = Law::Impulse});
    Timeline timeline(30 * run.world().bytes());
    timeline.begin(run);
    auto hashes = runOn(run, timeline, 40);
    const auto change = [&](Law law, const PartitionerConfig& partitioner) {
        SimulationConfig config = run.config();
        config.law = law;
        config.partitioner = partitioner;
        run.reconfigure(config);
        timeline.change();
        const auto more = runOn(run, timeline, 40);
        hashes.insert(hashes.end(), more.begin() + 1, more.end());
    };
    change(Law::Continuous, Quadtree{});
    change(Law::Impulse, SemiStaticQuadtree{10, 20, SemiStaticQuadtree::EveryFrames{7}});
    for (const std::uint64_t step : {119, 118, 120, 80, 81, 79, 39, 40, 41, 0, 60, 100}) {
        if (step >= timeline.first()) expectPast(timeline, hashes, std::uint64_t(step));
    }
}

TEST(Timeline, MemoryIsBoundedHoweverOftenARunIsChanged) {
    Simulation run = crowd({.law = Law::Continuous});
    const std::size_t memory = 40 * run.world().bytes();
    Timeline timeline(memory);
    timeline.begin(run);
    auto hashes = runOn(run, timeline, 20);
    for (int i = 0; i < 100; ++i) {
        SimulationConfig config = run.config();
        config.step.restitution = 1 - 1e-4 * i;
        run.reconfigure(config);
        timeline.change();
        const auto more = runOn(run, timeline, 1);
        hashes.push_back(more.back());
        ASSERT_LE(timeline.bytes(), memory + 8 * hashes.size());
    }
    EXPECT_GT(timeline.first(), 0u);
    EXPECT_LT(timeline.first(), 115u);
    // Where nothing is changed any more, states are kept as before.
    const auto more = runOn(run, timeline, 60);
    hashes.insert(hashes.end(), more.begin() + 1, more.end());
    for (std::uint64_t step = 180; step > timeline.first(); --step) {
        expectPast(timeline, hashes, step);
    }
}

TEST(Timeline, StepsThatCannotBeMadeAgainHaveNoGapsAfterAnotherLaw) {
    // Which pairs are missed depends on how long ago the tree was built.
    Simulation run =
        crowd({.partitioner = SemiStaticQuadtree{10, 1, SemiStaticQuadtree::EveryFrames{9}},
               .law = Law::Impulse},
              "imbalanced", 400);
    Timeline timeline(40 * run.world().bytes());
    timeline.begin(run);
    auto hashes = runOn(run, timeline, 15);
    SimulationConfig config = run.config();
    config.partitioner = Quadtree{};
    run.reconfigure(config);
    timeline.change();
    for (int i = 0; i < 12; ++i) {
        const auto more = runOn(run, timeline, 10);
        hashes.insert(hashes.end(), more.begin() + 1, more.end());
        for (std::uint64_t step = timeline.last(); step > timeline.first(); --step) {
            expectPast(timeline, hashes, step);
        }
    }
}

TEST(Timeline, ThePastHasContacts) {
    Simulation run =
        crowd({.law = Law::Continuous, .keepContacts = true}, "imbalanced-clear", 1000);
    Timeline timeline(1'000'000'000);
    timeline.begin(run);
    std::vector<std::size_t> contacts;
    for (int i = 0; i < 20; ++i) {
        run.step();
        timeline.record();
        contacts.push_back(run.contacts().size());
    }
    for (const std::uint64_t step : {20, 7, 8, 1}) {
        ASSERT_TRUE(timeline.goTo(step, patient));
        EXPECT_EQ(timeline.past().contacts().size(), contacts[step - 1]);
        EXPECT_GT(contacts[step - 1], 0u);
    }
}

TEST(Timeline, APatienceThatEndsLeavesItOnTheWay) {
    Simulation run = crowd({.law = Law::Impulse});
    Timeline timeline(1);  // hardly any state is kept
    timeline.begin(run);
    const auto hashes = runOn(run, timeline, 100);
    EXPECT_FALSE(timeline.goTo(90, Timeline::Clock::now()));
    EXPECT_LT(timeline.past().stepsDone(), 90u);
    EXPECT_EQ(stateHash(timeline.past().world()), hashes[timeline.past().stepsDone()]);
    for (int i = 0; i < 1000 && !timeline.goTo(90, Timeline::Clock::now()); ++i) {
    }
    expectPast(timeline, hashes, 90);
}

/// The exact law knows where bodies are between two steps: there, a run with shorter steps is.
TEST(Timeline, BetweenTwoStepsBodiesAreWhereTheExactLawHasThem) {
    Simulation run = crowd({.law = Law::Continuous});
    Timeline timeline(1'000'000'000);
    timeline.begin(run);
    runOn(run, timeline, 12);
    Scene scene =
        loadScene(std::string(QUADRILLE_SCENES_DIR) + "/imbalanced-clear.toml", {.entities = 100});
    scene.step.dt /= 4;
    Simulation finer(std::move(scene.world), {.law = Law::Continuous, .step = scene.step});
    finer.run(4 * 9 + 3);
    ASSERT_TRUE(timeline.goTo(9, patient));
    const World& world = timeline.between(0.75).world();
    const auto a = world.bodies<double>().moving, b = finer.world().bodies<double>().moving;
    ASSERT_EQ(a.size(), b.size());
    double moved = 0;
    const auto at = timeline.past().world().bodies<double>().moving;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a.x[i], b.x[i], 1e-9);
        EXPECT_NEAR(a.y[i], b.y[i], 1e-9);
        EXPECT_EQ(a.vx[i], b.vx[i]);
        moved = std::max(moved, std::abs(a.x[i] - at.x[i]));
    }
    EXPECT_GT(moved, 0.1);
}

}  // namespace
}  // namespace quadrille::app
