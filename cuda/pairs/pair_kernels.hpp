#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/cell_coordinates.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/fine_grid.hpp"
#include "collision/rules/impulse_contact.hpp"
#include "collision/rules/keep_out.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.hpp"

/// From cells to pairs. All pointers are to device memory.

namespace quadrille::cuda {

/// The cells of a partition, as Cells has them. In a cell the static bodies stand last.
struct DeviceCells {
    const std::uint32_t* offsets;
    const BodyRef* bodies;
    const std::uint32_t* cellOfEntry;  ///< null to search for it
    std::uint32_t cells;
    /// Room for entries. Where there turn out to be more, nothing is done.
    std::uint32_t entries;
};

/// To which cell of a partition each pair belongs, as Partition has it. The ranges of bodies are
/// found again: that takes less than sending them.
template <class Real>
struct CellOwnership {
    const CellCoordinates* coordinates;  ///< null if pairs belong to all cells that they share
    FineGrid<Real> grid;
    Real margin;
};

/// A moving body and another one.
struct CandidatePair {
    std::uint32_t a;
    BodyRef b;
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
struct DeviceContacts {
    PendingContact<Real>* contacts;
    std::uint32_t *nextA, *nextB;  ///< of a contact: the next in the list of its body a, and b
    Successors* successors;
    std::uint32_t* waiting;          ///< of a contact: for how many others it must wait, 0 to 2
    ContactOutcome<Real>* outcomes;  ///< null if nobody wants to know
    std::uint32_t capacity;
    std::uint32_t* heads;  ///< of a moving body: the first of its contacts; `none` between steps
    Place<Real>* starts;   ///< of a moving body with contacts: where it was; null if nobody asks
    SeenPairs seen;
    StepCounts* counts;
};

/// Appends the pairs of each cell that overlap when `inflation` is added to the sums of their half
/// extents.
template <class Real>
void collectCandidates(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                       const CellOwnership<Real>& ownership, Real inflation,
                       const CandidateList& candidates);

/// Finds the contacts among the pairs of each cell, and counts the pairs.
template <class Real>
void findContacts(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                  const CellOwnership<Real>& ownership, Real dt,
                  const DeviceContacts<Real>& contacts);

/// Finds the contacts among `count` candidate pairs.
template <class Real>
void testCandidates(const Launch& launch, const Bodies<Real>& bodies,
                    const CandidatePair* candidates, std::uint32_t count, Real dt,
                    const DeviceContacts<Real>& contacts);

}  // namespace quadrille::cuda
