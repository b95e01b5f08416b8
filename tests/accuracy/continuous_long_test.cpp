// The law `continuous` over 1e5 s: between walls, and in a row of equal bodies between walls,
// places must be those of exact arithmetic, and the number of hits right, whatever the step. An
// anchor that grows with the way travelled, or that is rounded at each hit, fails here: 3e8 px are
// 3e18 times as long as what is allowed.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "hard_cases/hard_case.hpp"
#include "reference/rational.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

using accuracy::Body;
using accuracy::position;
using accuracy::Setup;
using accuracy::velocity;
using reference::Int128;

// ---- exact arithmetic: lengths in units of 2^-80 px, velocities of 2^-70 px/s

constexpr int lengthUnit = -80;
constexpr int speedUnit = -70;

Int128 inUnits(double value, int exponent) {
    int e = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &e), 53));
    const int shift = e - 53 - exponent;
    if (shift >= 0) return Int128{mantissa} * (Int128{1} << shift);
    const std::int64_t divisor = std::int64_t{1} << std::min(-shift, 62);
    if (mantissa % divisor != 0) throw std::invalid_argument("no multiple of the unit");
    return mantissa / divisor;
}

Int128 length(double px) { return inUnits(px, lengthUnit); }

double toDouble(Int128 value) { return reference::nearestDouble(value, lengthUnit); }

/// As the engine stores it.
double stored(Precision precision, double value) {
    return precision == Precision::Float ? static_cast<float>(value) : value;
}

/// A point between 0 and `room` that reflects it.
struct Ghost {
    Int128 place, room;
    double speed;  // px/s

    /// Its place, the direction that it goes in and the hits that it had, after whole seconds.
    struct Later {
        Int128 place;
        int direction;
        std::int64_t hits;
    };
    Later after(std::int64_t seconds) const {
        const Int128 way = inUnits(speed, speedUnit) * seconds;
        // 2^-80 px and 2^-70 px: ten more bits.
        const Int128 unfolded = place + way * (Int128{1} << (speedUnit - lengthUnit));
        Int128 lap = unfolded / room;
        if (lap * room > unfolded) --lap;  // downward
        const Int128 rest = unfolded - lap * room;
        const bool back = lap % 2 != 0;
        const auto hits = static_cast<std::int64_t>(lap < 0 ? -lap : lap);
        return {back ? room - rest : rest, (speed < 0) != back ? -1 : 1, hits};
    }
};

// ---- walls

struct Box {
    Vec2 low, high;  // centres of the walls
    Vec2 thickness;  // of those along x and along y
};

const Box lattice{{-6900, -4100}, {6900, 4100}, {100, 100}};
// No two of these have their last digit in one place.
const Box crooked{{-3333.3, -70.7}, {5120.1, 2171.3}, {33.3, 0.1}};

std::vector<Body> wallsOf(const Box& box) {
    const Vec2 middle = (box.low + box.high) / 2;
    const Vec2 span = box.high - box.low;
    return {{{box.low.x(), middle.y()}, {0, 0}, {box.thickness.x(), 2 * span.y()}, 1, true},
            {{box.high.x(), middle.y()}, {0, 0}, {box.thickness.x(), 2 * span.y()}, 1, true},
            {{middle.x(), box.low.y()}, {0, 0}, {2 * span.x(), box.thickness.y()}, 1, true},
            {{middle.x(), box.high.y()}, {0, 0}, {2 * span.x(), box.thickness.y()}, 1, true}};
}

/// Where the centre of a body of a size touches the lower and the upper wall.
std::pair<Int128, Int128> faces(const Box& box, double size, int axis, Precision precision) {
    const auto half = [&](double whole) { return length(stored(precision, whole) / 2); };
    const Int128 reach = half(size) + half(box.thickness[axis]);
    return {length(stored(precision, box.low[axis])) + reach,
            length(stored(precision, box.high[axis])) - reach};
}

// ---- runs

constexpr std::int64_t longTime = sanitized ? 20'000 : 100'000;  // s

struct LongRun {
    Simulation sim;
    std::uint64_t hits = 0;

    void until(double time) {
        while (sim.time() < time) {
            hits += sim.step().collisions;
        }
        ASSERT_EQ(sim.time(), time);
    }
};

LongRun start(const Box& box, std::vector<Body> bodies, double dt, Precision precision) {
    for (const Body& wall : wallsOf(box)) bodies.push_back(wall);
    return {accuracy::simulate({Law::Continuous, precision}, bodies, {.step = {.dt = dt}})};
}

double allowed(Precision precision, double place) {
    if (precision == Precision::Double) return 1e-9;
    const float x = std::abs(static_cast<float>(place));
    return std::nextafter(x, 2 * x + 1) - x;
}

struct Flight {
    const char* name;
    Box box;
    Vec2 position, velocity, size;
};

std::ostream& operator<<(std::ostream& out, const Flight& flight) { return out << flight.name; }

const Flight flights[] = {
    {"Lattice", lattice, {10.5, -3.25}, {3001, 0}, {8, 8}},
    {"AlongY", lattice, {10.5, -3.25}, {0, -3001}, {8, 8}},
    {"Crooked", crooked, {0.1, 99.9}, {3001.1, -577.77}, {3.3, 1.7}},
    {"Diagonal", crooked, {-100.3, 33.3}, {-1234.567, 1234.567}, {12.1, 0.3}},
    {"Slow", crooked, {7.7, 1.1}, {0.3, 31.41592653589793}, {3.3, 1.7}},
};

class LongFlight : public testing::TestWithParam<std::tuple<Flight, Precision>> {};

TEST_P(LongFlight, EndsWhereExactArithmeticDoes) {
    const auto& [flight, precision] = GetParam();
    Ghost::Later exact[2];
    Int128 low[2];
    std::int64_t hits = 0;
    for (int axis = 0; axis < 2; ++axis) {
        const auto [first, last] = faces(flight.box, flight.size[axis], axis, precision);
        const Ghost ghost{length(stored(precision, flight.position[axis])) - first, last - first,
                          stored(precision, flight.velocity[axis])};
        exact[axis] = ghost.after(longTime);
        low[axis] = first;
        hits += exact[axis].hits;
    }
    std::optional<std::uint64_t> hash;
    for (const double dt : {1000.0, 12.5}) {
        SCOPED_TRACE(dt);
        LongRun run =
            start(flight.box, {{flight.position, flight.velocity, flight.size}}, dt, precision);
        run.until(longTime);
        for (int axis = 0; axis < 2; ++axis) {
            const double place = toDouble(exact[axis].place + low[axis]);
            EXPECT_NEAR(position(run.sim, 0)[axis], place, allowed(precision, place)) << axis;
            EXPECT_EQ(velocity(run.sim, 0)[axis],
                      exact[axis].direction * std::abs(stored(precision, flight.velocity[axis])));
        }
        // The two axes of a corner are one hit; there are none here.
        EXPECT_EQ(run.hits, static_cast<std::uint64_t>(hits));
        const std::uint64_t now = stateHash(run.sim.world());
        EXPECT_EQ(hash.value_or(now), now) << "bits depend on dt";
        hash = now;
    }
}

INSTANTIATE_TEST_SUITE_P(ContinuousLong, LongFlight,
                         testing::Combine(testing::ValuesIn(flights),
                                          testing::Values(Precision::Double, Precision::Float)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param).name) +
                                    (std::get<1>(test.param) == Precision::Double ? "Double"
                                                                                  : "Float");
                         });

TEST(ContinuousLong, ARunThatIsResumedGoesOnWithTheSameBits) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("quadrille-long-" + std::to_string(std::hash<std::string>()(QUADRILLE_DOCS_DIR)));
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        const Flight& flight = flights[2];
        const std::vector<Body> body{{flight.position, flight.velocity, flight.size}};
        LongRun whole = start(flight.box, body, 12.5, precision);
        whole.until(10'000);
        LongRun first = start(flight.box, body, 12.5, precision);
        first.until(5'000);
        saveSnapshot(file, first.sim, "", 1);
        LongRun second = start(flight.box, body, 12.5, precision);
        second.sim.restore(loadSnapshot(file));
        second.until(10'000);
        EXPECT_EQ(stateHash(second.sim.world()), stateHash(whole.sim.world()));
        EXPECT_EQ(first.hits + second.hits, whole.hits);
    }
    std::filesystem::remove(file);
}

// ---- on a floor

TEST(ContinuousLong, ABounceKeepsItsHeightAndItsPeriod) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        const double speed = stored(precision, 201.3);
        const double pull = 190.7;
        Simulation sim = accuracy::simulate(
            {Law::Continuous, precision},
            {{{0, 4}, {0, speed}, {8, 8}}, {{0, -50}, {0, 0}, {100, 100}, 1, true}},
            {.step = {.dt = 12.5, .gravity = {0, -pull}}});
        std::uint64_t hits = 0;
        while (sim.time() < longTime) hits += sim.step().collisions;
        const long double period = 2.0L * speed / pull;
        const long double periods = std::floor(longTime / period);
        const long double s = longTime - periods * period;
        EXPECT_EQ(hits, static_cast<std::uint64_t>(periods));
        const auto height = static_cast<double>(4 + (speed - pull / 2 * s) * s);
        const bool isDouble = precision == Precision::Double;
        EXPECT_NEAR(position(sim, 0).y(), height, isDouble ? 1e-6 : 1e-5);
        EXPECT_NEAR(velocity(sim, 0).y(), static_cast<double>(speed - pull * s),
                    isDouble ? 1e-6 : 1e-5);
    }
}

// ---- a row of equal bodies: without their widths, each velocity goes its own way

struct Row {
    const char* name;
    Box box;
    double size;
    std::vector<double> places, speeds;
};

std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.name; }

const Row rows[] = {
    {"Cradle", lattice, 8, {-16, -8, 0, 8, 16}, {3001, 0, 0, 0, 0}},
    {"TwoIn", lattice, 8, {-16, -8, 0, 8, 16}, {1501, 1501, 0, 0, 0}},
    {"Crooked", crooked, 3.3, {-100.1, 0.3, 55.5, 300.7}, {703.3, -21.7, 0.1, -1001.01}},
};

class LongRow : public testing::TestWithParam<std::tuple<Row, Precision>> {};

std::vector<Body> bodiesOf(const Row& row) {
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < row.places.size(); ++i) {
        const double middle = (row.box.low.y() + row.box.high.y()) / 2;
        bodies.push_back({{row.places[i], middle}, {row.speeds[i], 0}, {row.size, row.size}});
    }
    return bodies;
}

TEST_P(LongRow, EndsWhereExactArithmeticDoes) {
    const auto& [row, precision] = GetParam();
    const auto [first, last] = faces(row.box, row.size, 0, precision);
    const auto count = static_cast<std::int64_t>(row.places.size());
    const Int128 width = length(stored(precision, row.size));
    std::vector<std::pair<Int128, double>> exact;
    for (std::int64_t i = 0; i < count; ++i) {
        const double speed = stored(precision, row.speeds[std::size_t(i)]);
        const Int128 place =
            length(stored(precision, row.places[std::size_t(i)])) - first - i * width;
        const auto later = Ghost{place, last - first - (count - 1) * width, speed}.after(longTime);
        exact.push_back({later.place, later.direction * std::abs(speed)});
    }
    std::sort(exact.begin(), exact.end());
    std::optional<std::uint64_t> hash;
    for (const double dt : {1000.0, 50.0}) {
        SCOPED_TRACE(dt);
        LongRun run = start(row.box, bodiesOf(row), dt, precision);
        run.until(longTime);
        for (std::int64_t i = 0; i < count; ++i) {
            SCOPED_TRACE("body " + std::to_string(i));
            const auto& [ghost, speed] = exact[std::size_t(i)];
            const double place = toDouble(ghost + first + i * width);
            EXPECT_NEAR(position(run.sim, std::size_t(i)).x(), place, allowed(precision, place));
            EXPECT_EQ(velocity(run.sim, std::size_t(i)).x(), speed);
        }
        const std::uint64_t now = stateHash(run.sim.world());
        EXPECT_EQ(hash.value_or(now), now) << "bits depend on dt";
        hash = now;
    }
}

INSTANTIATE_TEST_SUITE_P(ContinuousLong, LongRow,
                         testing::Combine(testing::ValuesIn(rows),
                                          testing::Values(Precision::Double, Precision::Float)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param).name) +
                                    (std::get<1>(test.param) == Precision::Double ? "Double"
                                                                                  : "Float");
                         });

}  // namespace
}  // namespace quadrille
