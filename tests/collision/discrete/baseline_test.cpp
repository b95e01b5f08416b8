// The law `baseline`, frames computed by hand, flaws of the report's law included. A step is 1/64 s
// and velocities are multiples of 16 px/s, so that every number below is exact.

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>

#include "collision/support.hpp"

namespace quadrille {
namespace {

class Baseline : public testing::TestWithParam<Precision> {
  protected:
    /// The world of all cases is 64 x 64 px.
    World world{{.size = {64, 64}}};

    Simulation simulate(const PartitionerConfig& partitioner = BruteForce{}) {
        return Simulation(std::move(world), {.partitioner = partitioner,
                                             .law = Law::Baseline,
                                             .precision = GetParam(),
                                             .step = {.dt = 1.0 / 64}});
    }
};

INSTANTIATE_TEST_SUITE_P(Precisions, Baseline, testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(Baseline, EqualMassesSwapAndAreEachPushedHalfTheWay) {
    // After the move a is at 1; depth 2 - (2.5 - 1) = 0.5, of which each goes half.
    const Entity a = makeBox(world, {0, 0}, moving(64, 16));
    const Entity b = makeBox(world, {2.5, 0.25}, moving(0, 0));
    Simulation sim = simulate();
    const StepReport report = sim.step();
    EXPECT_EQ(report.contacts, 1u);
    EXPECT_EQ(report.collisions, 1u);
    EXPECT_EQ(positionOf(sim, a), Vec2(0.75, 0.25));
    EXPECT_EQ(positionOf(sim, b), Vec2(2.75, 0.25));
    EXPECT_EQ(velocityOf(sim, a), Vec2(0, 16));  // along y nothing happens
    EXPECT_EQ(velocityOf(sim, b), Vec2(64, 0));
}

TEST_P(Baseline, UnequalMassesAreServedByTheOthersShare) {
    // a: share 3/4: pushed 0.5 * 3/4 back; 64 - 64 * 2 * 3/4 = -32.
    // b: share 1/4: pushed 0.5 * 1/4; 0 + 64 * 2 * 1/4 = 32.
    const Entity a = makeBox(world, {0, 0}, moving(64, 0, 1));
    const Entity b = makeBox(world, {2.5, 0}, moving(0, 0, 3));
    Simulation sim = simulate();
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(0.625, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(2.625, 0));
    EXPECT_EQ(velocityOf(sim, a), Vec2(-32, 0));
    EXPECT_EQ(velocityOf(sim, b), Vec2(32, 0));
}

TEST_P(Baseline, AStaticBodyPushesAllTheWay) {
    // a moves to 1; depth 0.5; all of it is a's.
    const Entity a = makeBox(world, {0, 0}, moving(64, 16));
    const Entity wall = makeBox(world, {2.5, 0}, fixed(), {2, 20});
    Simulation sim = simulate();
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(0.5, 0.25));
    EXPECT_EQ(velocityOf(sim, a), Vec2(-64, 16));
    EXPECT_EQ(positionOf(sim, wall), Vec2(2.5, 0));
}

TEST_P(Baseline, AfterAStaticBodyOnTheLowSideItGoesUp) {
    // a moves to (0, -1); the floor's surface is at -0.75 for its centre.
    const Entity a = makeBox(world, {0, 0}, moving(0, -64));
    makeBox(world, {0, -2.75}, fixed(), {20, 2});
    Simulation sim = simulate();
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(0, -0.75));
    EXPECT_EQ(velocityOf(sim, a), Vec2(0, 64));
}

TEST_P(Baseline, APairThatSeparatesButStillOverlapsIsReversedAgain) {
    // After the move a is at 0 and b at 1.5, going apart; depth 0.5.
    const Entity a = makeBox(world, {0.5, 0}, moving(-32, 0));
    const Entity b = makeBox(world, {1, 0}, moving(32, 0));
    Simulation sim = simulate();
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(-0.25, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(1.75, 0));
    EXPECT_EQ(velocityOf(sim, a), Vec2(32, 0));  // towards each other, now
    EXPECT_EQ(velocityOf(sim, b), Vec2(-32, 0));
    // Next step: a at 0.25, b at 1.25, depth 1; pushed to -0.25 and 1.75, and apart again.
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(-0.25, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(1.75, 0));
    EXPECT_EQ(velocityOf(sim, a), Vec2(-32, 0));
    EXPECT_EQ(velocityOf(sim, b), Vec2(32, 0));
}

TEST_P(Baseline, TheLastContactOfTheFrameWins) {
    // a moves to (1, 1). The wall on its right: depth 2 - 1.75 = 0.25 on x; a to x = 0.75, and its
    // velocity would be (-64, 64). The wall above: depth 0.25 on y; a to y = 0.75; its velocity is
    // computed from the old one again, (64, -64), and the reflection on x is lost.
    const Entity a = makeBox(world, {0, 0}, moving(64, 64));
    makeBox(world, {2.75, 1}, fixed(), {2, 8});
    makeBox(world, {1, 2.75}, fixed(), {8, 2});
    Simulation sim = simulate();
    EXPECT_EQ(sim.step().contacts, 2u);
    EXPECT_EQ(positionOf(sim, a), Vec2(0.75, 0.75));
    EXPECT_EQ(velocityOf(sim, a), Vec2(64, -64));
}

TEST_P(Baseline, VelocitiesChangeAtTheEndOfTheFrame) {
    // a moves to 1. (a, b): depth 0.5: a to 0.75, b to 2.75; a would get 0, b 64.
    // (b, c): b is at 2.75 already, so depth 2 - (4.25 - 2.75) = 0.5: b back to 2.5, c to 4.5. It
    // sees the old velocity of b, 0: b and c get 0. The momentum of a is gone.
    const Entity a = makeBox(world, {0, 0}, moving(64, 0));
    const Entity b = makeBox(world, {2.5, 0}, moving(0, 0));
    const Entity c = makeBox(world, {4.25, 0}, moving(0, 0));
    Simulation sim = simulate();
    EXPECT_EQ(sim.step().contacts, 2u);
    EXPECT_EQ(positionOf(sim, a), Vec2(0.75, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(2.5, 0));
    EXPECT_EQ(positionOf(sim, c), Vec2(4.5, 0));
    EXPECT_EQ(velocityOf(sim, a), Vec2(0, 0));
    EXPECT_EQ(velocityOf(sim, b), Vec2(0, 0));
    EXPECT_EQ(velocityOf(sim, c), Vec2(0, 0));
    EXPECT_EQ(momentum(sim.world()), Vec2(0, 0));
}

TEST_P(Baseline, EqualPenetrationsTakeX) {
    // Depth 0.5 on both axes: a to the left of b by 0.25 each, y as it was.
    const Entity a = makeBox(world, {0, 0}, moving(0, 0));
    const Entity b = makeBox(world, {1.5, 1.5}, moving(0, -0.0));
    Simulation sim = simulate();
    Contact contact;
    sim.onContact([&](const Contact& c) { contact = c; });
    sim.step();
    EXPECT_EQ(contact.axis, Axis::X);
    EXPECT_EQ(contact.normal, Vec2(1, 0));
    EXPECT_EQ(positionOf(sim, a), Vec2(-0.25, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(1.75, 1.5));
}

TEST_P(Baseline, LevelEdgesDoNotTouch) {
    makeBox(world, {0, 0}, moving(64, 0));
    makeBox(world, {3, 0}, moving(0, 0));  // a moves to 1: edges level
    Simulation sim = simulate();
    EXPECT_EQ(sim.step().contacts, 0u);
}

/// Two bodies across the border x = 0 of two grid cells, and a wall in the left one only. After the
/// move a is at -1 and b at 1.5, boxes of 4 x 4: depth 4 - 2.5 = 1.5.
struct SharedCells {
    Entity a, b;
    static constexpr double cellWidth = 32;

    SharedCells(World& world, bool withWall) {
        a = makeBox(world, {-1.5, 0}, moving(32, 0), {4, 4});
        b = makeBox(world, {2.5, 0}, moving(-64, 0), {4, 4});
        if (withWall) makeBox(world, {-4.5, 0}, fixed(), {2, 20});
    }
};

TEST_P(Baseline, APairIsResolvedAgainInEachCellInWhichItStillOverlaps) {
    const SharedCells s(world, true);
    Simulation sim = simulate(StaticGrid{{SharedCells::cellWidth, 64}});
    std::vector<Contact> contacts;
    sim.onContact([&](const Contact& c) { contacts.push_back(c); });
    sim.step();
    // Left cell: (a, b): a to -1.75, b to 2.25.
    //            (a, wall): reach 3, distance 2.75, depth 0.25: a to -1.5; a would get -32.
    // Right cell: (a, b): depth 4 - 3.75 = 0.25: a to -1.625, b to 2.375; from the velocities
    //             before the frame: a gets -64, b gets 32.
    ASSERT_EQ(contacts.size(), 3u);
    EXPECT_EQ(contacts[0].b, s.b);
    EXPECT_EQ(contacts[1].numberB, -1);
    EXPECT_EQ(contacts[2].b, s.b);
    EXPECT_EQ(positionOf(sim, s.a), Vec2(-1.625, 0));
    EXPECT_EQ(positionOf(sim, s.b), Vec2(2.375, 0));
    EXPECT_EQ(velocityOf(sim, s.a), Vec2(-64, 0));
    EXPECT_EQ(velocityOf(sim, s.b), Vec2(32, 0));
}

TEST_P(Baseline, TheSameSceneInOneCellGivesAnotherAnswer) {
    const SharedCells s(world, true);
    Simulation sim = simulate();
    EXPECT_EQ(sim.step().contacts, 2u);
    EXPECT_EQ(positionOf(sim, s.a), Vec2(-1.5, 0));
    EXPECT_EQ(positionOf(sim, s.b), Vec2(2.25, 0));
    EXPECT_EQ(velocityOf(sim, s.a), Vec2(-32, 0));
    EXPECT_EQ(velocityOf(sim, s.b), Vec2(32, 0));
}

TEST_P(Baseline, APairThatNoLongerOverlapsIsNotResolvedInTheNextCell) {
    const SharedCells s(world, false);
    Simulation sim = simulate(StaticGrid{{SharedCells::cellWidth, 64}});
    EXPECT_EQ(sim.step().contacts, 1u);
    EXPECT_EQ(positionOf(sim, s.a), Vec2(-1.75, 0));
    EXPECT_EQ(positionOf(sim, s.b), Vec2(2.25, 0));
}

TEST_P(Baseline, BodiesAtTheSamePlaceSeparateAlongX) {
    // Depth 2, half each; the one created first goes to the left.
    const Entity a = makeBox(world, {1, 1});
    const Entity b = makeBox(world, {1, 1});
    Simulation sim = simulate();
    sim.step();
    EXPECT_EQ(positionOf(sim, a), Vec2(0, 1));
    EXPECT_EQ(positionOf(sim, b), Vec2(2, 1));
}

TEST_P(Baseline, ContactsAreTimedAtTheEndOfTheStep) {
    makeBox(world, {0, 0}, moving(64, 0));
    makeBox(world, {2.5, 0}, moving(0, 0));
    Simulation sim = simulate();
    Contact contact;
    sim.onContact([&](const Contact& c) { contact = c; });
    sim.step();
    EXPECT_EQ(contact.time, 1.0 / 64);
    EXPECT_TRUE(contact.collided);
}

}  // namespace
}  // namespace quadrille
