// The metrics on lists and states whose answers are known by hand.

#include "accuracy/metrics.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <quadrille/random.hpp>

namespace quadrille::accuracy {
namespace {

constexpr double tolerance = 0.25;

EventMatch match(const std::vector<Event>& exact, const std::vector<Event>& measured) {
    return matchEvents(exact, measured, tolerance);
}

TEST(MatchEvents, TheSameListMatchesWhollyInAnyOrder) {
    const std::vector<Event> events{{1, 0, 1, 1}, {1, 0, 1, 2}, {2, 0, -1, 1}, {3, 2, 5, 3}};
    const EventMatch m = match(events, {events.rbegin(), events.rend()});
    EXPECT_EQ(m.matched, 4u);
    EXPECT_EQ(m.recall(), 1);
    EXPECT_EQ(m.precision(), 1);
    EXPECT_EQ(m.f1(), 1);
    EXPECT_EQ(m.rateBias(), 0);
}

TEST(MatchEvents, TimesMayDifferByTheTolerance) {
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{1.25, 0, 1, 1}}).matched, 1u);
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{0.75, 0, 1, 1}}).matched, 1u);
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{1.2501, 0, 1, 1}}).matched, 0u);
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{0.7499, 0, 1, 1}}).matched, 0u);
}

TEST(MatchEvents, PairAndAxisMustAgree) {
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{1, 0, 2, 1}}).matched, 0u);
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{1, 1, 1, 1}}).matched, 0u);
    EXPECT_EQ(match({{1, 0, 1, 1}}, {{1, 0, 1, 2}}).matched, 0u);
    EXPECT_EQ(match({{1, 0, -1, 1}}, {{1, 0, -2, 1}}).matched, 0u);
    // A corner hit is neither of its axes, nor both of them one after the other.
    EXPECT_EQ(match({{1, 0, 1, 3}}, {{1, 0, 1, 1}, {1, 0, 1, 2}}).matched, 0u);
    EXPECT_EQ(match({{1, 0, 1, 3}}, {{1, 0, 1, 3}}).matched, 1u);
}

TEST(MatchEvents, EachCountsOnce) {
    const EventMatch repeated =
        match({{1, 0, 1, 1}}, {{0.9, 0, 1, 1}, {1, 0, 1, 1}, {1.1, 0, 1, 1}});
    EXPECT_EQ(repeated.matched, 1u);
    EXPECT_EQ(repeated.recall(), 1);
    EXPECT_EQ(repeated.precision(), 1.0 / 3);
    EXPECT_EQ(repeated.f1(), 0.5);
    EXPECT_EQ(repeated.rateBias(), 2);
}

TEST(MatchEvents, AsManyAsPossibleAreMatched) {
    // To give the second to the first by nearness would leave the others without partners.
    EXPECT_EQ(match({{1, 0, 1, 1}, {1.2, 0, 1, 1}, {1.4, 0, 1, 1}},
                    {{1.2, 0, 1, 1}, {1.4, 0, 1, 1}, {1.6, 0, 1, 1}})
                  .matched,
              3u);
    EXPECT_EQ(match({{1, 0, 1, 1}, {2, 0, 1, 1}}, {{1.9, 0, 1, 1}, {2.9, 0, 1, 1}}).matched, 1u);
}

/// Whatever is in which slice, the same events find partners.
TEST(EventMatcher, InSlicesCountsWhatMatchEventsCounts) {
    Random random(7);
    std::vector<Event> exact, measured;
    for (int k = 0; k < 4000; ++k) {
        const Event event{random.uniform(0, 100), k % 5, 5 + k % 7, 1 + k % 2};
        if (random.uniform(0, 1) < 0.8) exact.push_back(event);
        Event other = event;
        other.time = std::min(100.0, other.time + random.uniform(0, 1.5 * tolerance));
        if (random.uniform(0, 1) < 0.8) measured.push_back(other);
    }
    const EventMatch whole = match(exact, measured);
    ASSERT_GT(whole.missed(), 100u);
    ASSERT_GT(whole.invented(), 100u);
    for (const double slice : {0.03, tolerance, 1.0, 200.0}) {
        EventMatcher matcher(tolerance);
        std::uint64_t settled = 0;
        for (double from = 0; from <= 100; from += slice) {
            const auto inSlice = [&](const Event& event) {
                return event.time >= from && event.time < from + slice;
            };
            for (const Event& event : exact) {
                if (inSlice(event)) matcher.addExact(event);
            }
            for (const Event& event : measured) {
                if (inSlice(event)) matcher.addMeasured(event);
            }
            matcher.advance(from + slice);
            // What is settled stays.
            EXPECT_GE(matcher.match().exact, settled);
            settled = matcher.match().exact;
        }
        matcher.advance(1000);
        EXPECT_EQ(matcher.match().matched, whole.matched) << slice;
        EXPECT_EQ(matcher.match().missed(), whole.missed()) << slice;
        EXPECT_EQ(matcher.match().invented(), whole.invented()) << slice;
    }
}

/// A collision of this step may have its partner in the next.
TEST(EventMatcher, AnEventThatMayStillFindAPartnerIsNotMissed) {
    EventMatcher matcher(tolerance);
    matcher.addExact({1, 0, 1, 1});
    matcher.advance(1.2);
    EXPECT_EQ(matcher.match().missed(), 0u);
    matcher.addMeasured({1.25, 0, 1, 1});
    matcher.advance(1.4);
    EXPECT_EQ(matcher.match().matched, 1u);
    matcher.addExact({2, 0, 1, 1});
    matcher.advance(2.26);
    EXPECT_EQ(matcher.match().missed(), 1u);
    EXPECT_EQ(matcher.match().invented(), 0u);
}

TEST(MatchEvents, NothingIsFoundCompletely) {
    const EventMatch none = match({}, {});
    EXPECT_EQ(none.recall(), 1);
    EXPECT_EQ(none.precision(), 1);
    EXPECT_EQ(none.f1(), 1);
    EXPECT_EQ(none.rateBias(), 0);
    const EventMatch spurious = match({}, {{1, 0, 1, 1}});
    EXPECT_EQ(spurious.recall(), 1);
    EXPECT_EQ(spurious.precision(), 0);
    EXPECT_EQ(spurious.f1(), 0);
    EXPECT_EQ(spurious.rateBias(), std::nullopt);
    const EventMatch missed = match({{1, 0, 1, 1}}, {});
    EXPECT_EQ(missed.recall(), 0);
    EXPECT_EQ(missed.precision(), 1);
    EXPECT_EQ(missed.f1(), 0);
    EXPECT_EQ(missed.rateBias(), -1);
}

TEST(Quantiles, AreOfNearestRank) {
    std::vector<double> values;
    for (int i = 200; i >= 1; --i) values.push_back(i);
    EXPECT_EQ(quantiles(values).median, 100);
    EXPECT_EQ(quantiles(values).p99, 198);
    EXPECT_EQ(quantiles(values).max, 200);
    EXPECT_EQ(quantiles({7}).median, 7);
    EXPECT_EQ(quantiles({7}).p99, 7);
    EXPECT_EQ(quantiles({3, 1, 2}).median, 2);
    EXPECT_EQ(quantiles({}).max, 0);
}

TEST(WrongBodies, AreThoseWithAnyComponentThatDiffers) {
    const std::vector<BodyState> exact{
        {{0, 0}, {1, 2}}, {{0, 0}, {3, 4}}, {{0, 0}, {0, 5}}, {{9, 9}, {6, 7}}};
    std::vector<BodyState> measured = exact;
    EXPECT_EQ(wrongBodies(exact, measured, 0), 0u);
    measured[0].velocity.x() = -1;
    measured[1].velocity.y() = std::nextafter(4.0, 5.0);
    measured[2].velocity.x() = -0.0;
    measured[3].position.x() = 0;  // a place is no velocity
    EXPECT_EQ(wrongBodies(exact, measured, 0), 2u);
    EXPECT_EQ(wrongBodies(exact, measured, 1e-9), 1u);
    measured[2].velocity.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(wrongBodies(exact, measured, 1e9), 1u);
}

TEST(PositionErrors, AreDistancesInUnitsOfTheLength) {
    const std::vector<BodyState> exact{{{0, 0}, {0, 0}}, {{1, 1}, {0, 0}}, {{5, 5}, {0, 0}}};
    const std::vector<BodyState> measured{{{3, 4}, {0, 0}}, {{1, 1}, {0, 0}}, {{5, 4}, {0, 0}}};
    const Quantiles q = positionErrors(exact, measured, 2);
    EXPECT_EQ(q.median, 0.5);
    EXPECT_EQ(q.p99, 2.5);
    EXPECT_EQ(q.max, 2.5);
}

TEST(SpeedDrift, IsOfTheSortedComponents) {
    const std::vector<BodyState> before{{{0, 0}, {1, -8}}, {{0, 0}, {-2, 6}}, {{0, 0}, {3, 0}}};
    // Permuted per axis, signs changed: nothing drifted.
    EXPECT_EQ(
        speedDrift(before,
                   std::vector<BodyState>{{{0, 0}, {-3, 0}}, {{0, 0}, {1, 8}}, {{0, 0}, {2, 6}}}),
        0);
    EXPECT_EQ(
        speedDrift(before,
                   std::vector<BodyState>{{{0, 0}, {1, 8}}, {{0, 0}, {2, 6}}, {{0, 0}, {5, 0}}}),
        2.0 / 8);
    // |vx| and |vy| are not exchanged for each other.
    EXPECT_GT(
        speedDrift(before,
                   std::vector<BodyState>{{{0, 0}, {8, 1}}, {{0, 0}, {6, 2}}, {{0, 0}, {0, 3}}}),
        0);
    EXPECT_EQ(speedDrift({}, {}), 0);
}

TEST(ErrorMetrics, BroadPhaseRecallIsUnknownWhereNobodyLooked) {
    ErrorMetrics metrics;
    EXPECT_EQ(metrics.broadPhaseRecall(), std::nullopt);
    metrics.auditedSteps = 3;
    EXPECT_EQ(metrics.broadPhaseRecall(), 1);
    metrics.overlappingPairs = 8;
    metrics.missedPairs = 2;
    EXPECT_EQ(metrics.broadPhaseRecall(), 0.75);
    EXPECT_EQ(metrics.wrongBodyFraction(), 0);
}

}  // namespace
}  // namespace quadrille::accuracy
