#pragma once

#include <array>
#include <limits>
#include <optional>

/// Motion along one axis: where it is, when it is inside an interval, when it passes a border.
namespace quadrille::reference {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// x = position + velocity (t - anchor) + acceleration (t - anchor)^2 / 2.
struct Track {
    double position = 0;      ///< px
    double velocity = 0;      ///< px/s
    double acceleration = 0;  ///< px/s^2
    double anchor = 0;        ///< s

    double at(double time) const {
        const double t = time - anchor;
        return position + velocity * t + acceleration * t * t / 2;
    }
    double speed(double time) const { return velocity + acceleration * (time - anchor); }
};

/// Where `b` is, seen from `a`; anchored at the later of both anchors, so that it does not depend
/// on the time of the question.
Track relative(const Track& a, const Track& b);

/// An open interval of time, s.
struct Span {
    double low;
    double high;
};

/// Up to two spans, in order of time.
struct Spans {
    std::array<Span, 2> list{};
    int count = 0;

    void add(double low, double high) {
        if (low < high) list[std::size_t(count++)] = {low, high};
    }
    const Span* begin() const { return list.data(); }
    const Span* end() const { return list.data() + count; }
};

/// When |x| < reach, over all times. A track that only touches the border is never inside.
Spans inside(const Track& track, double reach);

/// When the track next passes `border` upwards (side = +1) or downwards (-1), not before `now`;
/// `now` if it is past the border and still moves away.
std::optional<double> passes(const Track& track, double border, int side, double now);

}  // namespace quadrille::reference
