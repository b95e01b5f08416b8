#include "cuda/discrete/impulse_contacts.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

#include <quadrille/error.hpp>

#include "collision/make_record.hpp"

namespace quadrille::cuda {

std::uint32_t count31(std::uint64_t count, const char* what) {
    if (count > none / 2) {
        throw DeviceError("cuda: " + std::to_string(count) + ' ' + what +
                          " in a step are more than 31 bits can count");
    }
    return static_cast<std::uint32_t>(count);
}

template <class Real>
void ImpulseContacts<Real>::reserve(std::uint64_t count) {
    capacity_ = 0;
    const std::uint32_t wanted = count31(count, "contacts");
    device_.reserveZeroed(contacts_, wanted);
    nextA_.reserve(wanted);
    nextB_.reserve(wanted);
    successors_.reserve(wanted);
    waiting_.reserve(wanted);
    capacity_ = wanted;
}

template <class Real>
void ImpulseContacts<Real>::makeRoom(std::uint64_t contacts) {
    reserve(contacts + contacts / 4);
    expected_ = count31(contacts, "contacts");
}

/// Cells that are out of date may show a pair more than once. The table stays half empty at least,
/// unless there are more contacts than room.
template <class Real>
SeenPairs ImpulseContacts<Real>::forgetSeenPairs() {
    const std::size_t slots = std::bit_ceil(2 * std::size_t(capacity_));
    seenSlots_.reserve(slots);
    device_.fill(seenSlots_, 0xff, slots);
    return {seenSlots_.data(), static_cast<std::uint32_t>(slots - 1)};
}

template <class Real>
DeviceContacts<Real> ImpulseContacts<Real>::begin(bool shownOnce, bool keep) {
    if (capacity_ == 0) {
        expected_ = bodies_.movingCount() / 2 + 1024;
        reserve(expected_);
    }
    // The lists of all bodies are empty, unless a step has not left them so.
    if (heads_.reserve(bodies_.movingCount()) || !listsEmpty_) device_.fill(heads_, 0xff);
    listsEmpty_ = false;
    if (keep) device_.reserveZeroed(outcomes_, capacity_);
    return {.contacts = contacts_.data(),
            .nextA = nextA_.data(),
            .nextB = nextB_.data(),
            .successors = successors_.data(),
            .waiting = waiting_.data(),
            .outcomes = keep ? outcomes_.data() : nullptr,
            .capacity = capacity_,
            .heads = heads_.data(),
            .starts = nullptr,
            .seen = shownOnce ? SeenPairs{} : forgetSeenPairs(),
            .counts = bodies_.counts()};
}

template <class Real>
void ImpulseContacts<Real>::resolve(const DeviceContacts<Real>& list,
                                    const StepParameters<Real>& step) {
    const Launch& launch = device_.launch();
    findSuccessors(launch, list, canonicalOrder(bodies_.bodies()), expected_);
    launchImpulse(launch, bodies_.bodies(), list, step, bodies_.touched(), expected_);
}

template <class Real>
void ImpulseContacts<Real>::end(const StepCounts& counts) {
    listsEmpty_ = true;
    // Only where it differs much, so that most steps are launched as the one before.
    const auto found = static_cast<std::uint32_t>(counts.contacts);
    if (found > expected_ || expected_ / 2 > found + 256) expected_ = found + found / 4 + 128;
}

template <class Real>
void ImpulseContacts<Real>::fetch(std::size_t count, const StepParameters<Real>& step,
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

template class ImpulseContacts<double>;
template class ImpulseContacts<float>;

}  // namespace quadrille::cuda
