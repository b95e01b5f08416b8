#include "accuracy/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace quadrille::accuracy {

namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 1 : double(part) / double(whole);
}

/// Events of one kind together, each kind in order of time.
std::vector<Event> grouped(std::span<const Event> events) {
    std::vector<Event> sorted(events.begin(), events.end());
    std::sort(sorted.begin(), sorted.end(), [](const Event& a, const Event& b) {
        return std::tie(a.i, a.j, a.axis, a.time) < std::tie(b.i, b.j, b.axis, b.time);
    });
    return sorted;
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
    EventMatch match{.exact = exact.size(), .measured = measured.size()};
    const std::vector<Event> left = grouped(exact);
    const std::vector<Event> right = grouped(measured);
    // The earliest events that can be matched, are: so none takes the partner of a later one.
    auto a = left.begin();
    auto b = right.begin();
    while (a != left.end() && b != right.end()) {
        if (kind(*a) < kind(*b)) {
            ++a;
        } else if (kind(*b) < kind(*a)) {
            ++b;
        } else if (std::abs(a->time - b->time) <= tolerance) {
            ++match.matched;
            ++a;
            ++b;
        } else {
            a->time < b->time ? ++a : ++b;
        }
    }
    return match;
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

std::size_t wrongBodies(std::span<const BodyState> exact, std::span<const BodyState> measured,
                        double tolerance) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const Vec2 difference = measured[i].velocity - exact[i].velocity;
        // Written so that NaN counts as wrong.
        count += !(std::abs(difference.x()) <= tolerance && std::abs(difference.y()) <= tolerance);
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
