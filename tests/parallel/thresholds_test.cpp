// From where on a loop is shared out is a number in Thresholds, and none() shares out all of them.

#include <cstddef>
#include <gtest/gtest.h>
#include <limits>

#include "parallel/thread_team.hpp"

namespace quadrille {
namespace {

/// All that are numbers of items.
constexpr std::size_t Thresholds::*items[] = {
    &Thresholds::streamed,  &Thresholds::tested,   &Thresholds::built,
    &Thresholds::walked,    &Thresholds::resolved, &Thresholds::linked,
    &Thresholds::scattered, &Thresholds::copied,   &Thresholds::events};

TEST(Thresholds, DecideWhichLoopsAreSharedOut) {
    for (const auto named : items) {
        Thresholds thresholds;
        EXPECT_GT(thresholds.*named, 1u) << "no loop of one item is worth it";
        thresholds.*named = 77;
        const ThreadTeam team(3, thresholds);
        EXPECT_EQ(team.workersFor(76, named), 1u);
        EXPECT_EQ(team.workersFor(77, named), team.size());
        EXPECT_EQ(team.thresholds().*named, 77u);
    }
}

TEST(Thresholds, EachLoopGoesByItsOwn) {
    Thresholds thresholds;
    thresholds.resolved = 10;
    thresholds.linked = 1000;
    const ThreadTeam team(2, thresholds);
    EXPECT_EQ(team.workersFor(100, &Thresholds::resolved), team.size());
    EXPECT_EQ(team.workersFor(100, &Thresholds::linked), 1u);
    EXPECT_EQ(team.workersFor(100, std::size_t(100)), team.size());
    EXPECT_EQ(team.workersFor(100, std::size_t(101)), 1u);
}

TEST(Thresholds, NoneSharesOutEvenEmptyLoops) {
    const Thresholds none = Thresholds::none();
    const ThreadTeam team(2, none);
    for (const auto named : items) EXPECT_EQ(team.workersFor(0, named), team.size());
    EXPECT_EQ(none.graphThreads, 0u);
    EXPECT_EQ(none.heapThreads, 0u);
    EXPECT_EQ(none.treePart, 1u);
    EXPECT_EQ(none.eventQuarters, 4u) << "a worker may have all events";
    EXPECT_EQ(none.longestPause, 0u) << "a way that was not worth it is tried again at once";
}

TEST(Thresholds, OneThreadSharesOutNothing) {
    for (const auto named : items) {
        EXPECT_EQ(ThreadTeam(1, Thresholds::none()).workersFor(1'000'000, named), 1u);
        EXPECT_EQ(ThreadTeam::serial().workersFor(1'000'000, named), 1u);
    }
}

}  // namespace
}  // namespace quadrille
