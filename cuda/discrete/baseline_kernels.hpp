#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>

#include "collision/rules/baseline_contact.hpp"
#include "collision/rules/bodies.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// A contact of the law `baseline`: the pair's place in the order, and what happened.
template <class Real>
struct BaselineContact {
    std::uint32_t cell, i, j;  ///< members i and j of the cell
    std::uint32_t a;           ///< row of member i
    BodyRef b;                 ///< member j
    BaselineOutcome<Real> outcome;
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

/// Finds the turns of the entries. The order's heads must be `none`.
template <class Real>
void findCellTurns(const Launch& launch, const DeviceCells& cells,
                   const BaselineOrder<Real>& order);

/// Resolves the cells in ascending order, as far as they share bodies. The order's `done` must be
/// zero.
template <class Real>
void launchBaseline(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                    const BaselineOrder<Real>& order, Real restitution,
                    const TouchedBodies& touched);

/// Gives the touched bodies their future velocities, and writes them and the counts to the host.
template <class Real>
void publishBaseline(const Launch& launch, const Bodies<Real>& bodies,
                     const BaselineOrder<Real>& order, const TouchedBodies& touched,
                     const HostResult<Real>& result, std::uint32_t expected);

}  // namespace quadrille::cuda
