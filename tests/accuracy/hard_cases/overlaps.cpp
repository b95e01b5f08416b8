// Boxes that overlap from the start.

#include <algorithm>
#include <cmath>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

/// Depth of the overlap of the boxes 0 and 1 along the axis of least penetration, px; negative if
/// they are apart.
double depth(const Simulation& sim, const Vec2& reach) {
    return (reach - (position(sim, 1) - position(sim, 0)).cwiseAbs()).minCoeff();
}

Outcome samePlace(const Setup& setup) {
    for (const double sense : {1.0, -1.0}) {
        Simulation sim = simulate(setup, {{{0, 0}, {sense, 0.25}}, {{0, 0}, {-sense, -0.25}}});
        const double energy = kineticEnergy(sim.world());
        sim.run(180);
        const Vec2 d = position(sim, 1) - position(sim, 0);
        const double gain = kineticEnergy(sim.world()) / energy - 1;
        const std::string detail = listing({sense, d.x(), d.y(), gain});
        if (!d.allFinite()) return {"NaN", detail};
        if (gain != 0) return {"energy " + percent(gain), detail};
        if (depth(sim, {1, 1}) > 0) return {"stay together", detail};
        // The one that was created first goes left.
        if (!(d.x() > 0)) return {"separate as they move", detail};
    }
    return {"exact", {}};
}

Outcome deepOverlap(const Setup& setup) {
    const Vec2 size(4, 4);
    for (const double mass : {1.0, 5.0}) {
        // 1 px deep along x, 3 px along y.
        Simulation sim = simulate(setup, {{{0, 0}, {1, 1}, size}, {{3, 1}, {-1, -1}, size, mass}});
        const ContactLog log(sim);
        const double energy = kineticEnergy(sim.world());
        const Vec2 sum = momentum(sim.world());
        double last = depth(sim, size);
        bool falls = true;
        for (int i = 0; i < 120; ++i) {
            sim.step();
            const double now = std::max(depth(sim, size), 0.0);
            falls = falls && now <= last;
            last = now;
        }
        const double gain = kineticEnergy(sim.world()) / energy - 1;
        const double drift = (momentum(sim.world()) - sum).norm();
        const auto& hits = log.collisions();
        const std::string detail = listing({mass, gain, drift, last, double(hits.size())});
        const double rounding = setup.rounding(1e-14, 1e-6);
        if (std::abs(gain) > rounding) return {"energy " + percent(gain), detail};
        if (drift > rounding) return {"momentum off by " + number(drift, 2), detail};
        if (hits.size() != 1) return {std::to_string(hits.size()) + " hits", detail};
        if (hits[0].axis != Axis::X) return {"wrong axis", detail};
        if (!falls) return {"overlap grows", detail};
        if (last > 0) return {"stay together", detail};
    }
    return {"exact", {}};
}

}  // namespace

std::vector<HardCase> overlapCases() {
    return {{"SamePlace", "two squares at the same place", samePlace, "separate as they move",
             "separate as they move", "exact"},
            {"DeepOverlap", "deep overlap at the start", deepOverlap, "exact", "exact", "exact"}};
}

}  // namespace quadrille::accuracy
