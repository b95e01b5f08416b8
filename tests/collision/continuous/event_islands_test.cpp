#include "collision/continuous/event_islands.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "collision/pairs/threads_candidate_pairs.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"

namespace quadrille {
namespace {

PairEvent eventOf(std::uint32_t a, std::uint32_t b) {
    return {.time = 0,
            .a = a,
            .b = BodyRef::moving(b),
            .stampA = 0,
            .stampB = 0,
            .axes = 1,
            .release = false};
}

/// A world, its candidate pairs, and the islands of some events in it.
struct Split {
    Split(World w, int threads, double reach, const Thresholds& thresholds = {})
        : world(std::move(w)), team(static_cast<unsigned>(threads), thresholds), islands(team) {
        const auto bodies = world.bodies<double>();
        partitioner = makePartitioner<double>(StaticGrid{}, world.config().size, team);
        partitioner->update(bodies, 1, reach);
        ThreadsCandidatePairs<double> pairs(team);
        pairs.update(bodies, partitioner->partition());
        neighbours.link(bodies.moving.size(), pairs);
    }
    bool operator()(const std::vector<PairEvent>& events, double way) {
        return islands.split(world.bodies<double>(), neighbours, events, way);
    }
    void forget() {
        for (unsigned w = 0; w < team.size(); ++w) islands.forget(w);
    }

    World world;
    ThreadTeam team;
    std::unique_ptr<Partitioner<double>> partitioner;
    Neighbours neighbours;
    EventIslands islands;
};

int workerOf(const EventIslands& islands, std::uint32_t row, unsigned workers) {
    for (unsigned w = 0; w < workers; ++w) {
        if (islands.belongsTo(row, w)) return static_cast<int>(w);
    }
    return -1;
}

TEST(EventIslands, BodiesThatMayMeetBelongToOneWorker) {
    std::size_t spread = 0;
    for (const SceneKind kind : sceneKinds) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(std::string(name(kind)) + ", seed " + std::to_string(seed));
            const double way = 2;
            Split split(randomScene(kind, seed), 5, way, Thresholds::none());
            const auto bodies = split.world.bodies<double>();
            const auto rows = static_cast<std::uint32_t>(bodies.moving.size());
            for (std::uint32_t first : {0u, 1u}) {
                std::vector<PairEvent> events;
                for (std::uint32_t a = first; a < rows; a += 7) {
                    for (const BodyRef b : split.neighbours[a]) {
                        if (!b.isStatic() && a < b.row()) {
                            events.push_back(eventOf(a, b.row()));
                            break;
                        }
                    }
                }
                ASSERT_TRUE(split(events, way) || events.empty());
                std::size_t given = 0;
                for (unsigned w = 0; w < split.team.size(); ++w) {
                    given += split.islands.eventsOf(w).size();
                    spread += !events.empty() && !split.islands.eventsOf(w).empty();
                    for (const PairEvent& event : split.islands.eventsOf(w)) {
                        ASSERT_TRUE(split.islands.belongsTo(event.a, w));
                        ASSERT_TRUE(split.islands.belongsTo(event.b.row(), w));
                    }
                }
                ASSERT_EQ(events.empty() ? 0 : given, events.size());
                for (std::uint32_t a = 0; a < rows; ++a) {
                    const int worker = workerOf(split.islands, a, split.team.size());
                    if (worker < 0) continue;
                    for (std::uint32_t b = 0; b < rows; ++b) {
                        const auto& m = bodies.moving;
                        if (std::abs(m.x[b] - m.x[a]) < m.halfWidth[a] + m.halfWidth[b] + way &&
                            std::abs(m.y[b] - m.y[a]) < m.halfHeight[a] + m.halfHeight[b] + way) {
                            ASSERT_EQ(workerOf(split.islands, b, split.team.size()), worker)
                                << a << ", " << b;
                        }
                    }
                }
                split.forget();
                for (std::uint32_t a = 0; a < rows; ++a) {
                    ASSERT_EQ(workerOf(split.islands, a, split.team.size()), -1);
                }
            }
        }
    }
    EXPECT_GT(spread, 400u) << "these scenes would not show the difference";
}

/// Pairs in a row, so far apart.
World pairsInARow(int pairs, double distance) {
    World world({.size = {pairs * distance + 100, 100}});
    for (int i = 0; i < pairs; ++i) {
        makeBox(world, {distance * i - pairs * distance / 2, 0});
        makeBox(world, {distance * i - pairs * distance / 2 + 2.5, 0});
    }
    return world;
}

std::vector<PairEvent> eventsOfPairs(std::uint32_t pairs) {
    std::vector<PairEvent> events;
    for (std::uint32_t i = 0; i < pairs; ++i) events.push_back(eventOf(2 * i, 2 * i + 1));
    return events;
}

TEST(EventIslands, AreSpreadEvenly) {
    Split split(pairsInARow(90, 10), 3, 1);
    ASSERT_TRUE(split(eventsOfPairs(90), 2));
    for (unsigned w = 0; w < split.team.size(); ++w) {
        EXPECT_NEAR(double(split.islands.eventsOf(w).size()), 90.0 / split.team.size(), 0.5);
    }
}

TEST(EventIslands, OneLargeIslandIsNotWorthIt) {
    Split split(pairsInARow(90, 5), 3, 1);
    EXPECT_FALSE(split(eventsOfPairs(90), 1.5));
    split.forget();
    EXPECT_TRUE(split(eventsOfPairs(90), 0.25));
}

TEST(EventIslands, NorAreManyBodiesForFewEvents) {
    Split split(pairsInARow(90, 5), 3, 1);
    EXPECT_FALSE(split({eventOf(0, 1), eventOf(178, 179)}, 1.5));
    split.forget();
    EXPECT_TRUE(split({eventOf(0, 1), eventOf(178, 179)}, 0.25));
}

}  // namespace
}  // namespace quadrille
