#pragma once

#include <cuda_runtime_api.h>

#include <quadrille/cuda_options.hpp>

#include "collision/rules/step_parameters.hpp"
#include "cuda/types.hpp"

/// Starts the kernels. All work goes to the stream of the launch and is not waited for; errors are
/// DeviceErrors. `expected` items are what a launch is made for; any number of them is treated.

namespace quadrille::cuda {

/// Threads in a block at most, which every kernel must have registers for.
inline constexpr int largestBlock = 1024;

struct Launch {
    cudaStream_t stream;
    CudaOptions options;
    unsigned multiprocessors;
};

/// Error of the driver if kernels cannot run on the device, as on one of another architecture.
cudaError_t tryKernels();

// ---- bodies.cu

/// Zeroes the counts; with `advance`, moves the bodies by a step first.
template <class Real>
void beginStep(const Launch& launch, const Bodies<Real>& bodies, std::uint32_t movingCount,
               const StepParameters<Real>& step, bool advance, StepCounts* counts);

// ---- contacts.cu

/// Appends the pairs of each cell that overlap when `inflation` is added to the sums of their half
/// extents.
template <class Real>
void collectCandidates(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                       const CellOwnership<Real>& ownership, Real inflation,
                       const CandidateList& candidates);

/// Finds the contacts among the pairs of each cell, and counts the pairs.
template <class Real>
void findContacts(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                  const CellOwnership<Real>& ownership, Real dt, const ContactList<Real>& contacts);

/// Finds the contacts among `count` candidate pairs.
template <class Real>
void testCandidates(const Launch& launch, const Bodies<Real>& bodies,
                    const CandidatePair* candidates, std::uint32_t count, Real dt,
                    const ContactList<Real>& contacts);

// ---- impulse.cu

/// Finds which contacts follow each contact, and for how many it must wait.
template <class Real>
void findSuccessors(const Launch& launch, const ContactList<Real>& contacts,
                    std::uint32_t expected);

/// Resolves each contact after those that it waits for. Does nothing if there was no room for all
/// contacts.
template <class Real>
void resolveImpulse(const Launch& launch, const Bodies<Real>& bodies,
                    const ContactList<Real>& contacts, const StepParameters<Real>& step,
                    const TouchedBodies& touched, std::uint32_t expected);

/// Writes the counts, and the bodies that contacts have changed, to the host; makes the lists of
/// these bodies empty again.
template <class Real>
void publishImpulse(const Launch& launch, const Bodies<Real>& bodies,
                    const ContactList<Real>& contacts, const TouchedBodies& touched,
                    const HostResult<Real>& result, std::uint32_t expected);

// ---- baseline.cu

/// Finds the turns of the entries. The order's heads must be `none`.
template <class Real>
void findCellTurns(const Launch& launch, const DeviceCells& cells,
                   const BaselineOrder<Real>& order);

/// Resolves the cells in ascending order, as far as they share bodies. The order's `done` must be
/// zero.
template <class Real>
void resolveBaseline(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                     const BaselineOrder<Real>& order, Real restitution,
                     const TouchedBodies& touched);

/// Gives the touched bodies their future velocities, and writes them and the counts to the host.
template <class Real>
void publishBaseline(const Launch& launch, const Bodies<Real>& bodies,
                     const BaselineOrder<Real>& order, const TouchedBodies& touched,
                     const HostResult<Real>& result, std::uint32_t expected);

}  // namespace quadrille::cuda
