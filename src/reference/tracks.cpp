#include "reference/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille::reference {
namespace {

/// The real roots of c + b t + a t^2 / 2, a > 0, in order; without cancellation.
std::optional<Span> roots(double a, double b, double c) {
    const double discriminant = b * b - 2 * a * c;
    if (!(discriminant >= 0)) return std::nullopt;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (q == 0) return Span{0, 0};
    const auto [low, high] = std::minmax({q / a, 2 * c / q});
    return Span{low, high};
}

}  // namespace

Track relative(const Track& a, const Track& b) {
    const double anchor = std::max(a.anchor, b.anchor);
    return {.position = b.at(anchor) - a.at(anchor),
            .velocity = b.speed(anchor) - a.speed(anchor),
            .acceleration = b.acceleration - a.acceleration,
            .anchor = anchor};
}

Spans inside(const Track& track, double reach) {
    Spans spans;
    const double t0 = track.anchor;
    if (track.acceleration != 0) {
        // Seen with the acceleration upwards: inside while below the upper border, except between
        // the passages of the lower one.
        const double sign = track.acceleration > 0 ? 1 : -1;
        const double a = sign * track.acceleration;
        const double v = sign * track.velocity;
        const double x = sign * track.position;
        const auto upper = roots(a, v, x - reach);
        if (!upper) return spans;
        if (const auto lower = roots(a, v, x + reach)) {
            spans.add(t0 + upper->low, t0 + lower->low);
            spans.add(t0 + lower->high, t0 + upper->high);
        } else {
            spans.add(t0 + upper->low, t0 + upper->high);
        }
    } else if (track.velocity != 0) {
        const double first = (-reach - track.position) / track.velocity;
        const double second = (reach - track.position) / track.velocity;
        spans.add(t0 + std::min(first, second), t0 + std::max(first, second));
    } else if (std::abs(track.position) < reach) {
        spans.add(-never, never);
    }
    return spans;
}

std::optional<double> passes(const Track& track, double border, int side, double now) {
    // Seen from the border, upwards is out.
    const double x = side * (track.at(now) - border);
    const double v = side * track.speed(now);
    const double a = side * track.acceleration;
    if (x >= 0 && v > 0) return now;
    if (a == 0) {
        if (v > 0) return now - x / v;
        return std::nullopt;
    }
    const double discriminant = v * v - 2 * a * x;
    if (!(discriminant >= 0)) return std::nullopt;
    const double out = std::sqrt(discriminant);  // the speed at the border
    if (v < 0) {
        const double t = (out - v) / a;
        return t >= 0 ? std::optional(now + t) : std::nullopt;
    }
    if (v + out == 0) return a > 0 ? std::optional(now) : std::nullopt;
    const double t = -2 * x / (v + out);
    return t >= 0 ? std::optional(now + t) : std::nullopt;
}

}  // namespace quadrille::reference
