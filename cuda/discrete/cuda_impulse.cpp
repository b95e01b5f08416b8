#include "cuda/discrete/cuda_impulse.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <numeric>
#include <string>

#include <quadrille/error.hpp>

#include "collision/discrete/impulse_bodies.hpp"
#include "collision/pairs/candidate_pairs.hpp"
#include "cuda/device/check.hpp"
#include "cuda/device/range.hpp"

namespace quadrille::cuda {

namespace {

/// Rows and contacts are counted in 32 bits, of which one marks static bodies.
std::uint32_t count32(std::uint64_t count, const char* what) {
    if (count >= PendingContact<double>::staticBit) {
        throw DeviceError("cuda: " + std::to_string(count) + ' ' + what +
                          " in a step are more than 31 bits can count");
    }
    return static_cast<std::uint32_t>(count);
}

}  // namespace

template <class Real>
ContactList<Real> CudaImpulse<Real>::list() const {
    return {.contacts = contacts_.data(),
            .nextA = nextA_.data(),
            .nextB = nextB_.data(),
            .successors = successors_.data(),
            .waiting = waiting_.data(),
            .collided = collided_.data(),
            .capacity = capacity_,
            .heads = heads_.data(),
            .seen = seen_,
            .counts = state_.counts()};
}

/// Makes the lists of all bodies empty, where a step has not left them so.
template <class Real>
void CudaImpulse<Real>::reserveLists() {
    if (!heads_.reserve(state_.movingCount()) && listsEmpty_) return;
    check(cudaMemsetAsync(heads_.data(), 0xff, heads_.capacity() * sizeof(std::uint32_t),
                          state_.launch().stream),
          "cudaMemsetAsync");
}

template <class Real>
void CudaImpulse<Real>::reserveContacts(std::uint64_t count) {
    capacity_ = 0;
    const std::uint32_t wanted = count32(count, "contacts");
    if (contacts_.reserve(wanted)) state_.clear(contacts_);
    nextA_.reserve(wanted);
    nextB_.reserve(wanted);
    successors_.reserve(wanted);
    waiting_.reserve(wanted);
    collided_.reserve(wanted);
    capacity_ = wanted;
}

template <class Real>
void CudaImpulse<Real>::collect(const BodyView<Real>& bodies, const Partition<Real>& partition) {
    const Real inflation = CandidatePairs<Real>::inflationOf(bodies, partition, state_.team());
    if (candidates_.capacity() == 0)
        candidates_.reserve(4 * std::size_t(state_.movingCount()) + 64);
    for (;;) {
        const auto room = std::min<std::size_t>(candidates_.capacity(), none);
        collectCandidates(state_.launch(), state_.bodies(), state_.cells(), state_.ownership(),
                          inflation,
                          {candidates_.data(), static_cast<std::uint32_t>(room), state_.counts()});
        StepCounts counts;
        state_.fetch(&counts, state_.counts(), sizeof counts);
        state_.zeroCounts();
        if (counts.candidates <= candidates_.capacity()) {
            candidateCount_ = count32(counts.candidates, "candidate pairs");
            return;
        }
        candidates_.reserve(count32(counts.candidates, "candidate pairs"));
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
    check(cudaMemsetAsync(seenSlots_.data(), 0xff, slots * sizeof(SeenPairs::empty),
                          state_.launch().stream),
          "cudaMemsetAsync");
}

template <class Real>
void CudaImpulse<Real>::launchStep(const Partition<Real>& partition,
                                   const StepParameters<Real>& step) {
    const Launch& launch = state_.launch();
    forgetSeenPairs(partition);
    if (partition.margin > 0) {
        testCandidates(launch, state_.bodies(), candidates_.data(), candidateCount_, step.dt,
                       list());
    } else {
        findContacts(launch, state_.bodies(), state_.cells(), state_.ownership(), step.dt, list());
    }
    findSuccessors(launch, list(), expected_);
    resolveImpulse(launch, state_.bodies(), list(), step, state_.touched(), expected_);
    state_.begin(Phase::CopyToHost);
    publishImpulse(launch, state_.bodies(), list(), state_.touched(), state_.hostResult(),
                   2 * expected_);
    state_.end(Phase::CopyToHost);
}

template <class Real>
ResolveCounts CudaImpulse<Real>::resolve(const BodyView<Real>& bodies,
                                         const Partition<Real>& partition,
                                         const StepParameters<Real>& step,
                                         std::vector<ContactRecord>* records) {
    const Range range("quadrille impulse");
    const std::uint32_t movingCount = state_.movingCount();
    if (movingCount == 0) return {};
    reserveLists();
    listsEmpty_ = false;
    if (capacity_ == 0) {
        expected_ = movingCount / 2 + 1024;
        reserveContacts(expected_);
    }
    if (state_.updateCells(partition, movingCount) && partition.margin > 0) {
        collect(bodies, partition);
    }
    launchStep(partition, step);
    StepCounts counts = state_.finish();
    while (counts.contacts > capacity_) {
        reserveContacts(counts.contacts + counts.contacts / 4);
        reserveLists();
        state_.zeroCounts();
        expected_ = count32(counts.contacts, "contacts");
        launchStep(partition, step);
        counts = state_.finish();
    }
    const auto found = static_cast<std::uint32_t>(counts.contacts);
    expected_ = std::max<std::uint32_t>(found + found / 4, 64);
    if (records != nullptr) appendRecords(found, step, *records);
    listsEmpty_ = true;
    state_.writeBack(bodies);
    return {.contacts = counts.contacts,
            .collisions = counts.collisions,
            .pairsTested = partition.margin > 0 ? candidateCount_ : counts.tested};
}

template <class Real>
void CudaImpulse<Real>::appendRecords(std::uint32_t count, const StepParameters<Real>& step,
                                      std::vector<ContactRecord>& records) const {
    std::vector<PendingContact<Real>> contacts(count);
    const auto collided = std::make_unique<bool[]>(count);
    state_.fetch(contacts.data(), contacts_.data(), count * sizeof contacts[0]);
    state_.fetch(collided.get(), collided_.data(), count * sizeof(bool));
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t p, std::uint32_t q) { return before(contacts[p], contacts[q]); });
    for (const std::uint32_t i : order) {
        records.push_back(makeRecord(contacts[i], step.start, collided[i]));
    }
}

template class CudaImpulse<double>;
template class CudaImpulse<float>;

}  // namespace quadrille::cuda
