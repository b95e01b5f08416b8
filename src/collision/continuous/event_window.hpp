#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>

#include "collision/continuous/event_islands.hpp"
#include "collision/rules/next_event.hpp"

namespace quadrille {

/// The part of a run that a loop of events belongs to.
struct EventWindow {
    double to;           ///< s; the events until then are carried out
    double horizon;      ///< s; those until then are found, and the partition covers the bodies
    SpeedBounds bounds;  ///< for as long as these hold
    std::uint64_t mostEvents;  ///< after so many, the loop ends

    /// Where other loops carry out the rest of the events: the islands of bodies, and whose of them
    /// this loop has. What jams may push any body, and ends the loop.
    const EventIslands* islands = nullptr;
    unsigned worker = 0;

    bool isShared() const { return islands != nullptr; }
    /// Whether no other loop may be changing the body.
    bool maySee(BodyRef body) const {
        return !isShared() || body.isStatic() || !islands->belongsToAnother(body.row(), worker);
    }
    bool mayChange(BodyRef body) const {
        return !body.isStatic() && (!isShared() || islands->belongsTo(body.row(), worker));
    }
};

}  // namespace quadrille
