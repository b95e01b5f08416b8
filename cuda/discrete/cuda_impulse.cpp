#include "cuda/discrete/cuda_impulse.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

#include <quadrille/error.hpp>

#include "collision/broad/extents.hpp"
#include "collision/make_record.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "cuda/device/range.hpp"

namespace quadrille::cuda {

namespace {

/// Contacts and pairs are counted in 32 bits on the device, with room for what grows beyond them.
std::uint32_t count31(std::uint64_t count, const char* what) {
    if (count > none / 2) {
        throw DeviceError("cuda: " + std::to_string(count) + ' ' + what +
                          " in a step are more than 31 bits can count");
    }
    return static_cast<std::uint32_t>(count);
}

}  // namespace

/// Makes the lists of all bodies empty, where a step has not left them so.
template <class Real>
void CudaImpulse<Real>::reserveLists() {
    if (heads_.reserve(bodies_.movingCount()) || !listsEmpty_) device_.fill(heads_, 0xff);
    listsEmpty_ = false;
}

template <class Real>
void CudaImpulse<Real>::reserveContacts(std::uint64_t count) {
    capacity_ = 0;
    const std::uint32_t wanted = count31(count, "contacts");
    device_.reserveZeroed(contacts_, wanted);
    nextA_.reserve(wanted);
    nextB_.reserve(wanted);
    successors_.reserve(wanted);
    waiting_.reserve(wanted);
    capacity_ = wanted;
}

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

/// Cells that are out of date may show a pair more than once. The table stays half empty at least,
/// unless there are more contacts than room.
template <class Real>
void CudaImpulse<Real>::forgetSeenPairs(const Partition<Real>& partition) {
    if (partition.complete) {
        seen_ = {};
        return;
    }
    const std::size_t slots = std::bit_ceil(2 * std::size_t(capacity_));
    seenSlots_.reserve(slots);
    seen_ = {seenSlots_.data(), static_cast<std::uint32_t>(slots - 1)};
    device_.fill(seenSlots_, 0xff, slots);
}

/// Does the step's work on the device, unless there turn out to be more contacts than room.
template <class Real>
StepCounts CudaImpulse<Real>::tryStep(const Partition<Real>& partition, Step<Real>& step) {
    reserveLists();
    forgetSeenPairs(partition);
    if (step.keepContacts) device_.reserveZeroed(outcomes_, capacity_);
    const DeviceContacts<Real> list{.contacts = contacts_.data(),
                                    .nextA = nextA_.data(),
                                    .nextB = nextB_.data(),
                                    .successors = successors_.data(),
                                    .waiting = waiting_.data(),
                                    .outcomes = step.keepContacts ? outcomes_.data() : nullptr,
                                    .capacity = capacity_,
                                    .heads = heads_.data(),
                                    .seen = seen_,
                                    .counts = bodies_.counts()};
    const Launch& launch = device_.launch();
    const Bodies<Real>& bodies = bodies_.bodies();
    if (partition.margin > 0) {
        testCandidates(launch, bodies, candidates_.data(), candidateCount_, step.parameters.dt,
                       list);
    } else {
        findContacts(launch, bodies, cells_.cells(), cells_.ownership(), step.parameters.dt, list);
    }
    findSuccessors(launch, list, canonicalOrder(bodies), expected_);
    launchImpulse(launch, bodies, list, step.parameters, bodies_.touched(), expected_);
    device_.begin(Phase::CopyToHost, step.clock);
    publishImpulse(launch, bodies, list, bodies_.touched(), bodies_.hostResult(), 2 * expected_);
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
    if (capacity_ == 0) {
        expected_ = bodies_.movingCount() / 2 + 1024;
        reserveContacts(expected_);
    }
    if (partition.margin > 0) collect(bodies, partition);
    StepCounts counts = tryStep(partition, step);
    while (counts.contacts > capacity_) {
        reserveContacts(counts.contacts + counts.contacts / 4);
        expected_ = count31(counts.contacts, "contacts");
        bodies_.zeroCounts();
        counts = tryStep(partition, step);
    }
    listsEmpty_ = true;
    keepOut(bodies, counts.touched, step.parameters.dt);
    const auto found = static_cast<std::uint32_t>(counts.contacts);
    expected_ = std::max<std::uint32_t>(found + found / 4, 64);
    step.counts.contacts += counts.contacts;
    step.counts.collisions += counts.collisions;
    step.counts.pairsTested += partition.margin > 0 ? candidateCount_ : counts.tested;
}

template <class Real>
void CudaImpulse<Real>::fetchContacts(std::size_t count, const StepParameters<Real>& step,
                                      std::vector<ContactRecord>& records) const {
    std::vector<PendingContact<Real>> contacts(count);
    std::vector<ContactOutcome<Real>> outcomes(count);
    device_.fetch(contacts.data(), contacts_.data(), count * sizeof contacts[0]);
    device_.fetch(outcomes.data(), outcomes_.data(), count * sizeof outcomes[0]);
    std::vector<std::uint32_t> places(count);
    std::iota(places.begin(), places.end(), 0u);
    std::sort(places.begin(), places.end(),
              [&, before = bodies_.hostOrder()](std::uint32_t p, std::uint32_t q) {
                  return before(contacts[p], contacts[q]);
              });
    for (const std::uint32_t i : places) {
        records.push_back(makeRecord(ResolvedContact<Real>{contacts[i], outcomes[i]}, step.start));
    }
}

template class CudaImpulse<double>;
template class CudaImpulse<float>;

}  // namespace quadrille::cuda
