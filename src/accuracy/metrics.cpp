#include "accuracy/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace quadrille::accuracy {

namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 1 : double(part) / double(whole);
}

/// Events of one kind together, each kind in order of time.
void group(std::vector<Event>& events) {
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::tie(a.i, a.j, a.axis, a.time) < std::tie(b.i, b.j, b.axis, b.time);
    });
}

auto kind(const Event& event) { return std::tie(event.i, event.j, event.axis); }

}  // namespace

double EventMatch::recall() const { return ratio(matched, exact); }
double EventMatch::precision() const { return ratio(matched, measured); }
double EventMatch::f1() const { return ratio(2 * matched, exact + measured); }

std::optional<double> EventMatch::rateBias() const {
    if (exact == 0) return measured == 0 ? std::optional(0.0) : std::nullopt;
    return double(measured) / double(exact) - 1;
}

EventMatch matchEvents(std::span<const Event> exact, std::span<const Event> measured,
                       double tolerance) {
    EventMatcher matcher(tolerance);
    for (const Event& event : exact) matcher.addExact(event);
    for (const Event& event : measured) matcher.addMeasured(event);
    matcher.advance(std::numeric_limits<double>::infinity());
    return matcher.match();
}

void EventMatcher::advance(double time) {
    group(exact_);
    group(measured_);
    std::vector<Event> exactLeft, measuredLeft;
    // Without a partner among the present ones; one that is still to come is not before `time`.
    const auto alone = [&](const Event& event, std::uint64_t& count, std::vector<Event>& left) {
        if (time - event.time > tolerance_) {
            ++count;
        } else {
            left.push_back(event);
        }
    };
    // The earliest events that can be matched, are: so none takes the partner of a later one.
    auto a = exact_.begin();
    auto b = measured_.begin();
    while (a != exact_.end() || b != measured_.end()) {
        if (b == measured_.end() || (a != exact_.end() && kind(*a) < kind(*b))) {
            alone(*a++, match_.exact, exactLeft);
        } else if (a == exact_.end() || kind(*b) < kind(*a)) {
            alone(*b++, match_.measured, measuredLeft);
        } else if (std::abs(a->time - b->time) <= tolerance_) {
            ++match_.matched;
            ++match_.exact;
            ++match_.measured;
            ++a;
            ++b;
        } else if (a->time < b->time) {
            ++match_.exact;
            ++a;
        } else {
            ++match_.measured;
            ++b;
        }
    }
    exact_ = std::move(exactLeft);
    measured_ = std::move(measuredLeft);
}

Quantiles quantiles(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double rank = std::ceil(share * double(values.size()));
        return values[std::size_t(std::max(rank, 1.0)) - 1];
    };
    return {.median = at(0.5), .p99 = at(0.99), .max = values.back()};
}

bool velocityDiffers(const Vec2& exact, const Vec2& measured, double tolerance) {
    const Vec2 difference = measured - exact;
    // Written so that NaN counts as different.
    return !(std::abs(difference.x()) <= tolerance && std::abs(difference.y()) <= tolerance);
}

std::size_t wrongBodies(std::span<const BodyState> exact, std::span<const BodyState> measured,
                        double tolerance) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        count += velocityDiffers(exact[i].velocity, measured[i].velocity, tolerance);
    }
    return count;
}

Quantiles positionErrors(std::span<const BodyState> exact, std::span<const BodyState> measured,
                         double length) {
    std::vector<double> errors(exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
        errors[i] = (measured[i].position - exact[i].position).norm() / length;
    }
    return quantiles(std::move(errors));
}

double speedDrift(std::span<const BodyState> before, std::span<const BodyState> after) {
    const auto components = [](std::span<const BodyState> states, int axis) {
        std::vector<double> speeds(states.size());
        std::transform(states.begin(), states.end(), speeds.begin(),
                       [&](const BodyState& s) { return std::abs(s.velocity[axis]); });
        std::sort(speeds.begin(), speeds.end());
        return speeds;
    };
    double drift = 0;
    double largest = 0;
    for (int axis = 0; axis < 2; ++axis) {
        const auto a = components(before, axis);
        const auto b = components(after, axis);
        for (std::size_t k = 0; k < a.size(); ++k) {
            drift = std::max(drift, std::abs(b[k] - a[k]));
            largest = std::max(largest, a[k]);
        }
    }
    return drift == 0 ? 0 : drift / largest;
}

std::optional<double> ErrorMetrics::broadPhaseRecall() const {
    if (auditedSteps == 0) return std::nullopt;
    return ratio(overlappingPairs - missedPairs, overlappingPairs);
}

}  // namespace quadrille::accuracy
