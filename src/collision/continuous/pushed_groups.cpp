#include "collision/continuous/pushed_groups.hpp"

#include <algorithm>
#include <vector>

namespace quadrille {

/// The bodies that `row` pushes along when it is pushed: those that it touches on that side and
/// that move with it, and so on. Their masses are added in the order of creation.
template <class Real, class Path>
void PushedGroups<Real, Path>::gather(const Motion& motion, std::uint32_t row, int axis,
                                      double sense, double now, PushedGroup& group) {
    std::vector<std::uint64_t>& gathered = *state_.gathered;
    if (gathered.size() < search_.rows()) gathered.resize(search_.rows());
    gathered[row] = ++state_.gathering;
    group.rows.assign(1, row);
    group.held = isHeld(motion, BodyRef::moving(row), axis, sense);
    for (std::size_t i = 0; i < group.rows.size() && !group.held; ++i) {
        const std::uint32_t a = group.rows[i];
        const Path p = motion.path(a, axis);
        for (const BodyRef b : search_.neighbours()[a]) {
            // What another loop may be changing is too far away to touch.
            if (!window_.maySee(b) || !pushesAlong(motion, a, p, b, axis, sense, now)) continue;
            group.held = group.held || isHeld(motion, b, axis, sense);
            if (b.isStatic() || gathered[b.row()] == state_.gathering) continue;
            gathered[b.row()] = state_.gathering;
            group.rows.push_back(b.row());
        }
    }
    const auto& m = motion.bodies.moving;
    std::sort(group.rows.begin(), group.rows.end(),
              [&](std::uint32_t p, std::uint32_t q) { return m.created[p] < m.created[q]; });
    group.mass = 0;
    for (const std::uint32_t i : group.rows) group.mass += m.mass[i];
}

template <class Real, class Path>
void PushedGroups<Real, Path>::move(const PushedGroup& group, int axis, double velocity,
                                    double now) {
    for (const std::uint32_t row : group.rows) {
        goOnWith(search_.motion(), row, axis, velocity, now);
        state_.groupChanged.push_back(row);
    }
}

template <class Real, class Path>
double PushedGroups<Real, Path>::collide(const Motion& motion, const PairEvent& event, int axis,
                                         double sense) {
    const double now = event.time;
    PushedGroup& a = state_.groupA;
    PushedGroup& b = state_.groupB;
    gather(motion, event.a, axis, -sense, now, a);
    if (event.withStatic()) {
        b.held = true;
    } else {
        gather(motion, event.b.row(), axis, sense, now, b);
    }
    return collideGroups(
        motion, event, axis, {a.mass, a.held}, {b.mass, b.held},
        [&](double velocity) { move(a, axis, velocity, now); },
        [&](double velocity) { move(b, axis, velocity, now); });
}

template class PushedGroups<double, StraightPath>;
template class PushedGroups<double, FallingPath>;
template class PushedGroups<float, StraightPath>;
template class PushedGroups<float, FallingPath>;

}  // namespace quadrille
