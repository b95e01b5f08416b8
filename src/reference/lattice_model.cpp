#include "reference/lattice_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "reference/boxes.hpp"

namespace quadrille::reference {
namespace {

constexpr int mantissaBits = std::numeric_limits<double>::digits;

/// A double as an odd integer times a power of two; zero has no exponent to speak of.
struct Dyadic {
    std::int64_t odd = 0;
    int exponent = std::numeric_limits<int>::max();
};

Dyadic dyadic(double value) {
    if (value == 0) return {};
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, mantissaBits));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    return {mantissa / (std::int64_t{1} << zeros), exponent - mantissaBits + zeros};
}

/// The value in units of 2^exponent, which divide it. Two bits are left for sums and differences.
std::int64_t inUnits(double value, int exponent) {
    const double units = std::ldexp(value, -exponent);
    if (!(std::abs(units) < std::ldexp(1.0, 61))) {
        throw std::invalid_argument("lattice: the common unit leaves no room in 64 bits");
    }
    return static_cast<std::int64_t>(units);
}

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

/// The open interval of time in which a pair overlaps along one axis.
struct Window {
    bool open = false;    ///< it is not empty
    bool always = false;  ///< no relative motion: without ends
    Rational low;
    Rational high;
};

}  // namespace

LatticeModel::LatticeModel(const std::vector<Box>& boxes) {
    int positions = std::numeric_limits<int>::max();
    int velocities = std::numeric_limits<int>::max();
    const Box* first = nullptr;
    for (const Box& box : boxes) {
        for (int k = 0; k < 2; ++k) {
            positions = std::min(
                {positions, dyadic(box.position[k]).exponent, dyadic(box.size[k]).exponent - 1});
            if (!box.isStatic) velocities = std::min(velocities, dyadic(box.velocity[k]).exponent);
        }
        if (box.isStatic) continue;
        if (first == nullptr) first = &box;
        if (box.mass != first->mass) throw std::invalid_argument("lattice: masses are not equal");
    }
    positionExponent_ = boxes.empty() ? 0 : positions;
    velocityExponent_ = velocities == std::numeric_limits<int>::max() ? 0 : velocities;
    for (const Box& box : boxes) {
        Body made;
        for (int k = 0; k < 2; ++k) {
            Line& line = made.line[std::size_t(k)];
            line.a = inUnits(box.position[k], positionExponent_);
            if (!box.isStatic) line.v = inUnits(box.velocity[k], velocityExponent_);
            made.half[std::size_t(k)] = inUnits(box.size[k] / 2, positionExponent_);
        }
        (box.isStatic ? fixed_ : moving_).push_back(made);
    }
    cellWidth_ = inUnits(
        std::ldexp(std::ceil(std::ldexp(cellWidth(boxes), -positionExponent_)), positionExponent_),
        positionExponent_);
    refuseOverlap();
}

void LatticeModel::refuseOverlap() const {
    CellGrid grid;
    const auto check = [&](std::int64_t i, std::int64_t j) {
        for (std::size_t k = 0; k < 2; ++k) {
            const std::int64_t d = checkedSubtract(body(j).line[k].a, body(i).line[k].a);
            if (std::abs(d) >= checkedAdd(body(i).half[k], body(j).half[k])) return;
        }
        throw std::invalid_argument("lattice: boxes " + std::to_string(i) + " and " +
                                    std::to_string(j) + " overlap");
    };
    for (std::int64_t i = 0; i < movingCount(); ++i) {
        const Cell cell = cellAtStart(i);
        grid.each({cell.x - 1, cell.y - 1}, {cell.x + 1, cell.y + 1},
                  [&](std::int64_t j) { check(i, j); });
        for (std::int64_t k = 0; k < staticCount(); ++k) check(i, -1 - k);
        grid.insert(i, cell);
    }
}

Cell LatticeModel::cellAtStart(std::int64_t i) const {
    return {floorDivide(body(i).line[0].a, cellWidth_), floorDivide(body(i).line[1].a, cellWidth_)};
}

std::optional<Hit<Rational>> LatticeModel::hit(std::int64_t i, std::int64_t j,
                                               const Rational& now) const {
    std::array<Window, 2> windows;
    for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t d = checkedSubtract(body(j).line[k].a, body(i).line[k].a);
        const std::int64_t w = checkedSubtract(body(j).line[k].v, body(i).line[k].v);
        const std::int64_t contact = checkedAdd(body(i).half[k], body(j).half[k]);
        Window& window = windows[k];
        if (w == 0) {
            window.always = window.open = std::abs(d) < contact;
        } else {
            // While they approach the sign of d is that of -w.
            const std::int64_t before = w > 0 ? -contact : contact;
            window.open = true;
            window.low = Rational(checkedSubtract(before, d), w);
            window.high = Rational(checkedSubtract(-before, d), w);
        }
        if (!window.open) return std::nullopt;
    }
    const auto& [x, y] = windows;
    if (x.always && y.always) return std::nullopt;
    int axis = 0;
    if (x.always || y.always) {
        axis = x.always ? 2 : 1;
    } else {
        if (!(x.low < y.high) || !(y.low < x.high)) return std::nullopt;
        axis = y.low < x.low ? 1 : x.low < y.low ? 2 : 3;
    }
    const Rational& time = axis == 2 ? y.low : x.low;
    if (time < now) return std::nullopt;
    return Hit<Rational>{time, axis};
}

std::optional<Crossing<Rational>> LatticeModel::crossing(std::int64_t i, const Cell& cell,
                                                         const Rational&) const {
    std::optional<Crossing<Rational>> next;
    for (int k = 0; k < 2; ++k) {
        const Line& line = body(i).line[std::size_t(k)];
        if (line.v == 0) continue;
        const int side = line.v > 0 ? 1 : -1;
        const std::int64_t index = (k == 0 ? cell.x : cell.y) + (side > 0 ? 1 : 0);
        const Rational time(checkedSubtract(checkedMultiply(index, cellWidth_), line.a), line.v);
        if (!next || time < next->time) next = {time, k + 1, side};
    }
    return next;
}

bool LatticeModel::collide(std::int64_t i, std::int64_t j, int axis, const Rational&, const Near&,
                           std::vector<std::int64_t>& changed) {
    for (std::size_t k = 0; k < 2; ++k) {
        if ((axis & (int(k) + 1)) == 0) continue;
        Line& a = moving_[std::size_t(i)].line[k];
        const std::int64_t contact = checkedAdd(body(i).half[k], body(j).half[k]);
        const std::int64_t offset = body(j).line[k].v > a.v ? -contact : contact;
        if (j < 0) {
            const std::int64_t border = checkedSubtract(body(j).line[k].a, offset);
            a.a = checkedSubtract(checkedMultiply(2, border), a.a);
            a.v = -a.v;
        } else {
            Line& b = moving_[std::size_t(j)].line[k];
            std::swap(a, b);
            a.a = checkedSubtract(a.a, offset);
            b.a = checkedAdd(b.a, offset);
        }
    }
    changed.push_back(i);
    if (j >= 0) changed.push_back(j);
    return true;
}

Rational LatticeModel::timeOf(double seconds) const {
    const Dyadic time = dyadic(seconds);
    if (time.odd == 0) return {};
    const int shift = time.exponent - timeExponent();
    if (shift < -62 || shift > 62) throw std::overflow_error("lattice: time does not fit");
    if (shift < 0) return {time.odd, std::int64_t{1} << -shift};
    return {checkedMultiply(time.odd, std::int64_t{1} << shift), 1};
}

double LatticeModel::position(std::int64_t i, int k, double seconds) const {
    const Line& line = body(i).line[std::size_t(k)];
    const Dyadic time = dyadic(seconds);
    const Int128 path = Int128{line.v} * time.odd;  // in units of 2^(velocity + time)
    if (path == 0) return nearestDouble(Int128{line.a}, positionExponent_);
    const int pathExponent = velocityExponent_ + time.exponent;
    const int shift = pathExponent - positionExponent_;
    const int limit = 62;  // 63 bits of anchor, or 64 of path, stay below 127
    if (shift < 0) {
        if (-shift > limit) throw std::overflow_error("lattice: time does not fit");
        return nearestDouble(path + Int128{line.a} * (Int128{1} << -shift), pathExponent);
    }
    const Int128 bound = Int128{1} << (126 - std::min(shift, 126));
    if (path > bound || path < -bound) throw std::overflow_error("lattice: time does not fit");
    return nearestDouble(Int128{line.a} + path * (Int128{1} << shift), positionExponent_);
}

double LatticeModel::velocity(std::int64_t i, int k) const {
    return nearestDouble(Int128{body(i).line[std::size_t(k)].v}, velocityExponent_);
}

}  // namespace quadrille::reference
