#pragma once

#include <cstdint>

#include "collision/rules/canonical_order.hpp"
#include "collision/rules/fine_grid.hpp"
#include "collision/rules/impulse_contact.hpp"

/// What kernels are given. All pointers are to device memory unless it says otherwise.

namespace quadrille::cuda {

/// Marks the end of a list.
inline constexpr std::uint32_t none = 0xffff'ffffu;

/// The cells of a partition, as Cells has them.
struct DeviceCells {
    const std::uint32_t* offsets;
    const std::uint32_t* bodies;
    std::uint32_t cells, entries;
    std::uint32_t movingCount;
};

/// To which cell of a partition each pair belongs, as Partition has it. The ranges of bodies are
/// found again: that takes less than sending them.
template <class Real>
struct CellOwnership {
    const CellCoordinates* coordinates;  ///< null if pairs belong to all cells that they share
    FineGrid<Real> grid;
    Real margin;
};

/// What the kernels of a step count.
struct StepCounts {
    unsigned long long tested;      ///< pairs compared
    unsigned long long contacts;    ///< to be listed, whether or not there was room for them
    unsigned long long candidates;  ///< the same of candidate pairs
    unsigned long long collisions;
    unsigned int touched;  ///< bodies that a contact has changed
};

/// A pair of rows, a before b; b with PendingContact::staticBit for a static body.
struct CandidatePair {
    std::uint32_t a, b;
};

struct CandidateList {
    CandidatePair* pairs;
    std::uint32_t capacity;
    StepCounts* counts;
};

/// The pairs that are contacts already: a hash table with open addressing, `empty` where there is
/// none. For cells that may show a pair more than once.
struct SeenPairs {
    static constexpr unsigned long long empty = ~0ull;
    unsigned long long* slots;  ///< null if no cells do that
    std::uint32_t mask;         ///< the number of slots, a power of two, less one
};

/// The contacts that follow a contact in the canonical order of its first body's contacts, and of
/// its second's; `none` where it is the last.
struct Successors {
    std::uint32_t a, b;
};

/// The contacts of a step, in no order, and for each body the list of its own.
template <class Real>
struct ContactList {
    PendingContact<Real>* contacts;
    std::uint32_t *nextA, *nextB;  ///< of a contact: the next in the list of its body a, and b
    Successors* successors;
    std::uint32_t* waiting;  ///< of a contact: for how many others it must wait, 0 to 2
    bool* collided;
    std::uint32_t capacity;
    std::uint32_t* heads;  ///< of a moving body: the first of its contacts; `none` between steps
    SeenPairs seen;
    StepCounts* counts;
};

/// The bodies that the contacts of a step have changed.
struct TouchedBodies {
    std::uint32_t* rows;
    StepCounts* counts;
};

/// Where a step's result goes: page-locked host memory.
template <class Real>
struct HostResult {
    StepCounts* counts;
    std::uint32_t* rows;  ///< of the bodies that contacts have changed
    Real *x, *y, *vx, *vy;
};

/// A contact of the law `baseline`: the pair's place in the order, and what happened.
template <class Real>
struct BaselineContact {
    std::uint32_t cell, i, j;  ///< members i and j of the cell
    std::uint32_t a, b;        ///< rows, b with PendingContact::staticBit for a static body
    Penetration<Real> penetration;
};

/// The cells of each body as the law `baseline` goes through them: in ascending order.
template <class Real>
struct BaselineOrder {
    std::uint32_t* heads;  ///< of a moving body: one of its entries; work space
    std::uint32_t* next;   ///< of an entry: another one of the same body; work space
    std::uint32_t* turns;  ///< of an entry: entries of the same body in earlier cells
    std::uint32_t* done;   ///< of a moving body: its cells that are resolved
    bool* hit;             ///< of a moving body: a contact has changed it; false between steps
    Real *futureX, *futureY;
    BaselineContact<Real>* contacts;  ///< null if nobody wants to know
    std::uint32_t capacity;
};

}  // namespace quadrille::cuda
