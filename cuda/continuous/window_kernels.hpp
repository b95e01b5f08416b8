#pragma once

#include <cstdint>

#include "cuda/continuous/device_window.hpp"
#include "cuda/device/launch.hpp"

/// The events of a window, by islands: bodies that cannot come together before it ends, whatever
/// happens to them, do not concern each other, so each island is one warp's (as in
/// collision/continuous/event_islands.hpp).

namespace quadrille::cuda {

/// What the host is told of a window.
struct WindowResult {
    std::uint32_t troubles;
    std::uint32_t entries;  ///< in the window's list
    std::uint32_t events, concerned, claimed, records;
    unsigned long long collisions;

    // Of the partition:
    std::uint32_t gridEntries, badRow;
    unsigned long long pairs;
    Survey survey;
};

/// Carries out the events of a window, and finds what its bodies do in later ones. Where there is
/// trouble, takes back what it has done. Writes the result to page-locked memory.
template <class Real>
void runWindow(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
               const WindowExpectation& expected, WindowResult* result);

}  // namespace quadrille::cuda
