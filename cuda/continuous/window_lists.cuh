#pragma once

#include "cuda/continuous/event_window.hpp"
#include "cuda/device/launch.cuh"

namespace quadrille::cuda {

/// Lists a pair for one window, or finds that there is no room.
__device__ inline void listIn(const WindowLists& lists, std::uint32_t window,
                              const CandidatePair& pair) {
    const WindowList list = lists[window];
    const std::uint32_t place = atomicAdd(&list.count->value, 1u);
    if (place < lists.room) list.pairs[place] = pair;
}

/// Lists a pair for the window in which it meets; near the end of one, where rounding decides, for
/// both. Whoever reads the lists looks at times again.
__device__ inline void listMeeting(const WindowLists& lists, const PairEvent& event) {
    constexpr double unsure = 1e-3;  // of a window
    const CandidatePair pair{event.a, event.b};
    const double at = (event.time - lists.from) * lists.perSecond;
    const auto last = static_cast<double>(lists.windows - 1);
    const double whole = floor(at < 0 ? 0 : at > last ? last : at);
    const auto window = static_cast<std::uint32_t>(whole);
    listIn(lists, window, pair);
    if (at - whole < unsure && window > 0) listIn(lists, window - 1, pair);
    if (at - whole > 1 - unsure && window + 1 < lists.windows) listIn(lists, window + 1, pair);
}

/// Calls `visit(other)` for those of a body's neighbours that may come near it. Several are looked
/// at together, so that their loads overlap; `accepts(row)` must be true for those that count, and
/// for the body itself, which stands for static ones.
template <class Real, class Accepts, class Visit>
__device__ void forEachNear(const EventBodies<Real>& bodies, std::uint32_t row,
                            const SketchSpan& span, const Accepts& accepts, const Visit& visit) {
    constexpr std::uint32_t together = 8;
    const PathSketch own = bodies.sketches[row];
    const SketchSize size = sketchSize(bodies.motion, row);
    const std::uint32_t last = bodies.starts[row + 1];
    for (std::uint32_t start = bodies.starts[row]; start < last; start += together) {
        std::uint32_t others[together];
#pragma unroll
        for (std::uint32_t k = 0; k < together; ++k) {
            const BodyRef other = bodies.others[min(start + k, last - 1)];
            others[k] = other.isStatic() ? row : other.row();
        }
        std::uint32_t near = 0;
#pragma unroll
        for (std::uint32_t k = 0; k < together; ++k) {
            const bool counts = start + k < last & accepts(others[k]);
            const bool comes = isNear(own, bodies.sketches[others[k]], size,
                                      sketchSize(bodies.motion, others[k]), span);
            near |= std::uint32_t(counts & comes) << k;
        }
        for (; near != 0; near &= near - 1) {
            visit(bodies.others[start + __ffs(static_cast<int>(near)) - 1]);
        }
    }
}

}  // namespace quadrille::cuda
