#pragma once

#include "cuda/continuous/device_window.hpp"
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
    const CandidatePair pair{event.a, event.b};
    const double at = (event.time - lists.from) * lists.perSecond;
    const auto last = static_cast<double>(lists.windows - 1);
    const double whole = floor(at < 0 ? 0 : at > last ? last : at);
    const auto window = static_cast<std::uint32_t>(whole);
    listIn(lists, window, pair);
    if (at - whole < unsureOfEnds && window > 0) listIn(lists, window - 1, pair);
    if (at - whole > 1 - unsureOfEnds && window + 1 < lists.windows)
        listIn(lists, window + 1, pair);
}

}  // namespace quadrille::cuda
