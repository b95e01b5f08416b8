#include "collision/continuous/rest_ends.hpp"

namespace quadrille {

/// Bodies that may hold one up; those that another loop may be changing are too far away for it.
template <class Real, class Path>
std::span<const BodyRef> RestEnds<Real, Path>::supportsOf(std::uint32_t row) {
    const auto all = search_.neighbours()[row];
    if (!window_.isShared()) return all;
    state_.supports.clear();
    for (const BodyRef b : all) {
        if (window_.maySee(b)) state_.supports.push_back(b);
    }
    return state_.supports;
}

/// Lets a body fall unless something holds it, and notes that it has changed.
template <class Real, class Path>
bool RestEnds<Real, Path>::release(std::uint32_t row, int axis, double now) {
    if (!search_.motion().rests(row, axis)) return false;
    if (!quadrille::release(search_.motion(), row, supportsOf(row), axis, now)) return false;
    search_.changed(row);
    state_.changed.push_back(row);
    return true;
}

template <class Real, class Path>
bool RestEnds<Real, Path>::release(const PairEvent& event) {
    const int axis = event.axes == axisX ? 0 : 1;
    const bool first = release(event.a, axis, event.time);
    const bool second = !event.withStatic() && release(event.b.row(), axis, event.time);
    return first || second;
}

template <class Real, class Path>
void RestEnds<Real, Path>::releaseFromChanged(double now) {
    if (!state_.mayRest) return;
    for (std::size_t i = 0; i < state_.changed.size(); ++i) {
        for (int axis = 0; axis < 2; ++axis) {
            const std::uint32_t row = state_.changed[i];
            release(row, axis, now);
            for (const BodyRef b : search_.neighbours()[row]) {
                if (window_.mayChange(b) && mayLieOn(search_.motion(), b.row(), row, axis, now)) {
                    release(b.row(), axis, now);
                }
            }
        }
    }
}

template class RestEnds<double, FallingPath>;
template class RestEnds<float, FallingPath>;

}  // namespace quadrille
