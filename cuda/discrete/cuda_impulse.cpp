#include "cuda/discrete/cuda_impulse.hpp"

#include <algorithm>

#include "collision/broad/extents.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "cuda/device/range.hpp"

namespace quadrille::cuda {

/// Collects the candidate pairs anew if the partition was built since the last call.
template <class Real>
void CudaImpulse<Real>::collect(const LawBodies<Real>& bodies, const Partition<Real>& partition) {
    if (candidatesOf_ == partition.generation) return;
    const Real inflation =
        candidateInflation(partition.margin, largestHalfExtent(bodies.read(), device_.team()));
    if (candidates_.capacity() == 0) {
        candidates_.reserve(4 * std::size_t(bodies_.movingCount()) + 64);
    }
    for (;;) {
        const auto room = std::min<std::size_t>(candidates_.capacity(), none);
        collectCandidates(device_.launch(), bodies_.bodies(), cells_.cells(), cells_.ownership(),
                          inflation,
                          {candidates_.data(), static_cast<std::uint32_t>(room), bodies_.counts()});
        StepCounts counts;
        device_.fetch(&counts, bodies_.counts(), sizeof counts);
        bodies_.zeroCounts();
        const std::uint32_t found = count31(counts.candidates, "candidate pairs");
        if (found <= candidates_.capacity()) {
            candidateCount_ = found;
            candidatesOf_ = partition.generation;
            return;
        }
        candidates_.reserve(found);
    }
}

/// Does the step's work on the device, unless there turn out to be more contacts than room.
template <class Real>
StepCounts CudaImpulse<Real>::tryStep(const Partition<Real>& partition, Step<Real>& step) {
    const DeviceContacts<Real> list = contacts_.begin(partition.complete, step.keepContacts);
    const Launch& launch = device_.launch();
    const Bodies<Real>& bodies = bodies_.bodies();
    if (partition.margin > 0) {
        testCandidates(launch, bodies, candidates_.data(), candidateCount_, step.parameters.dt,
                       list);
    } else {
        findContacts(launch, bodies, cells_.cells(), cells_.ownership(), step.parameters.dt, list);
    }
    contacts_.resolve(list, step.parameters);
    device_.begin(Phase::CopyToHost, step.clock);
    publishImpulse(launch, bodies, list, bodies_.touched(), bodies_.hostResult(),
                   2 * contacts_.expected());
    device_.end(Phase::CopyToHost, step.clock);
    return bodies_.finish(step.clock);
}

/// Keeps the bodies that came back out of static boxes. The host does that for the device: it has
/// them at the end of the step without their contacts, as on every resolver, and few must be moved.
template <class Real>
void CudaImpulse<Real>::keepOut(const LawBodies<Real>& bodies, std::uint32_t touched, Real dt) {
    barrier_.update(bodies);
    if (!barrier_.any()) return;
    const Bodies<Real> host = bodies.plain();
    const HostResult<Real> result = bodies_.hostResult();
    const bool moved =
        device_.team().any(touched, &Thresholds::scattered, [&](std::size_t from, std::size_t to) {
            bool any = false;
            for (std::size_t i = from; i < to; ++i) {
                const std::uint32_t row = result.rows[i];
                Box<Real> box = movingBox(host, row);
                box.x = result.x[i];
                box.y = result.y[i];
                const Place<Real> place =
                    barrier_.keepOut(box, placeBefore<Real>(host.moving, row, dt));
                any |= place.x != box.x || place.y != box.y;
                result.x[i] = place.x;
                result.y[i] = place.y;
            }
            return any;
        });
    if (moved) launchTakePlaces(device_.launch(), bodies_.bodies(), result, touched);
}

template <class Real>
void CudaImpulse<Real>::resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                                Step<Real>& step) {
    const Range range("quadrille impulse");
    if (partition.margin > 0) collect(bodies, partition);
    StepCounts counts = tryStep(partition, step);
    while (contacts_.lacksRoom(counts)) {
        contacts_.makeRoom(counts.contacts);
        bodies_.zeroCounts();
        counts = tryStep(partition, step);
    }
    keepOut(bodies, counts.touched, step.parameters.dt);
    contacts_.end(counts);
    step.counts.contacts += counts.contacts;
    step.counts.collisions += counts.collisions;
    step.counts.pairsTested += partition.margin > 0 ? candidateCount_ : counts.tested;
}

template class CudaImpulse<double>;
template class CudaImpulse<float>;

}  // namespace quadrille::cuda
