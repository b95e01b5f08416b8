#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>

#include "collision/contact_record.hpp"
#include "collision/rules/event_order.hpp"
#include "collision/rules/path_sketch.hpp"
#include "collision/rules/paths.hpp"
#include "cuda/pairs/pair_kernels.hpp"

/// What the kernels of the law `continuous` work on. Time is cut into windows, and what may happen
/// in each is listed when the bodies are partitioned, for as many windows as the partition covers.
/// All pointers are to device memory.

namespace quadrille::cuda {

/// Counters that many threads count up lie apart.
struct alignas(128) Counter {
    std::uint32_t value;
};

/// So near to the end of a window, in windows, a pair is listed for the next one as well.
inline constexpr double unsureOfEnds = 1e-3;
/// By so much the ends of steps may differ from those of the windows that pairs are listed for.
inline constexpr double mostDifference = 1e-4;
static_assert(2 * mostDifference < unsureOfEnds, "else a pair might be listed for the wrong one");

/// Why a window was not carried out. What it had changed is undone.
namespace trouble {
inline constexpr std::uint32_t partition = 1;    ///< no room for its entries or pairs
inline constexpr std::uint32_t entries = 2;      ///< no room in the list of a window
inline constexpr std::uint32_t events = 4;       ///< no room for events
inline constexpr std::uint32_t claimed = 8;      ///< no room for the bodies of the islands
inline constexpr std::uint32_t records = 16;     ///< no room for contacts to be kept
inline constexpr std::uint32_t crowded = 32;     ///< an island is too much for a warp
inline constexpr std::uint32_t tooFast = 64;     ///< a body outran what the partition covers
inline constexpr std::uint32_t notFinite = 128;  ///< a position is none
}  // namespace trouble

/// What becomes of an event.
enum class Fate : std::uint8_t {
    Concerned,  ///< others may have to do with it: it belongs to an island
    Nothing,    ///< nobody has, and it does nothing
    Collision,  ///< nobody has
};

/// A body's last event: with whom, and in which window.
struct alignas(8) EventMark {
    std::uint32_t window;  ///< its number
    BodyRef other;
};

/// What a window counts. There are two, and the one that is not in use is zero.
struct WindowCounts {
    Counter events, concerned, claimed, islands, records, troubles;
    unsigned long long collisions;
};

/// Pairs that may meet in a window, in no order; some come twice.
struct WindowList {
    CandidatePair* pairs;
    Counter* count;
};

/// The lists of all windows that a partition covers.
struct WindowLists {
    CandidatePair* pairs;
    Counter* counts;
    std::uint32_t windows, room;  ///< room in each
    double from, perSecond;       ///< s; windows/s

    QUADRILLE_HD WindowList operator[](std::uint32_t window) const {
        return {pairs + std::size_t(window) * room, counts + window};
    }
};

/// A contact to be kept. An event may come at once after one that it would have preceded, had it
/// been known: it counts as that one, and within its island contacts have numbers.
struct RecordedContact {
    PairEvent after;
    std::uint32_t number;
    ContactRecord record;
};

/// The largest speed and coordinate along an axis, as the bits of doubles.
struct Survey {
    unsigned long long fastest, farthest;
};

/// The bodies and what is known of them while a partition lasts.
template <class Real>
struct EventBodies {
    ExactMotion<Real, StraightPath> motion;
    const std::uint32_t* starts;  ///< of each body's neighbours, and the end
    const BodyRef* others;        ///< the neighbours
    WindowLists lists;
    double horizon;        ///< s, to which the partition covers the bodies
    double bound;          ///< px/s along an axis, at which it does
    PathSketch* sketches;  ///< of each body, as seen from `lists.from`
    float slack;           ///< px, of the sketches

    std::uint32_t* stamps;      ///< changes of each path
    std::uint32_t* parents;     ///< towards the root of a body's island; `none` outside of windows
    std::uint32_t* firstEvent;  ///< of the island of a root; the same
    std::uint32_t* changedIn;   ///< the number of the last window in which a body's path changed
    EventMark* marks;           ///< of each body
    std::uint32_t* busyIn;      ///< the number of the last window in which it had several events
    std::uint32_t* eventOf;     ///< of its mark, where it is the only one

    PairEvent* events;
    Fate* fates;
    Anchor<Real>* anchorsOf;   ///< of both bodies of each event, before it
    ContactRecord* recordOf;   ///< of each event that belongs to no island; null as `records`
    std::uint32_t* concerned;  ///< events that belong to islands, and others not
    std::uint32_t* nextEvent;  ///< of the same island
    std::uint32_t* roots;      ///< of islands with events
    std::uint32_t eventRoom;
    std::uint32_t* claimed;  ///< bodies of the islands
    Anchor<Real>* before;    ///< what they were
    std::uint32_t claimedRoom;
    RecordedContact* records;  ///< null if nobody wants them
    std::uint32_t recordRoom;

    WindowCounts* counts;
    WindowCounts* nextCounts;

    // Of the partition:
    const StepCounts* found;  ///< its pairs
    std::uint32_t pairRoom;
    const std::uint32_t* gridEntries;
    std::uint32_t gridRoom;
    const std::uint32_t* badRow;  ///< the lowest whose position is not finite, else `none`
    const Survey* survey;
};

/// A stretch of time.
struct Window {
    double from, to;       ///< s; what happens at its end belongs to it
    std::uint32_t number;  ///< never that of another one, and not 0
    std::uint32_t list;
    bool first;   ///< after a partition: what happens at its beginning belongs to it, too
    float close;  ///< px; bodies farther from each other do not meet in it
};

/// How many items kernels are launched for.
struct WindowExpectation {
    std::uint32_t entries, events, concerned, claimed;
};

}  // namespace quadrille::cuda
