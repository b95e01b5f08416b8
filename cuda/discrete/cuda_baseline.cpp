#include "cuda/discrete/cuda_baseline.hpp"

#include <algorithm>
#include <tuple>

#include <quadrille/error.hpp>

#include "collision/discrete/impulse_bodies.hpp"
#include "cuda/device/check.hpp"
#include "cuda/device/range.hpp"

namespace quadrille::cuda {

/// Makes room for the bodies and cells, and brings what a step needs to its initial value.
template <class Real>
void CudaBaseline<Real>::reserve() {
    const std::size_t count = state_.movingCount();
    const cudaStream_t stream = state_.launch().stream;
    heads_.reserve(count);
    next_.reserve(state_.cells().entries);
    turns_.reserve(state_.cells().entries);
    future_.reserve(2 * count);
    if (hit_.reserve(count) || !hitsFalse_) {
        check(cudaMemsetAsync(hit_.data(), 0, hit_.capacity(), stream), "cudaMemsetAsync");
    }
    done_.reserve(count);
    check(cudaMemsetAsync(done_.data(), 0, count * sizeof(std::uint32_t), stream),
          "cudaMemsetAsync");
}

template <class Real>
ResolveCounts CudaBaseline<Real>::resolve(const BodyView<Real>& bodies,
                                          const Partition<Real>& partition,
                                          const StepParameters<Real>& step,
                                          std::vector<ContactRecord>* records) {
    const Range range("quadrille baseline");
    const std::uint32_t movingCount = state_.movingCount();
    if (movingCount == 0) return {};
    const bool newCells = state_.updateCells(partition, movingCount);
    StepCounts counts;
    for (bool first = true;; first = false) {
        reserve();
        hitsFalse_ = false;
        if (records != nullptr && contacts_.reserve(expected_)) state_.clear(contacts_);
        const BaselineOrder<Real> order{.heads = heads_.data(),
                                        .next = next_.data(),
                                        .turns = turns_.data(),
                                        .done = done_.data(),
                                        .hit = hit_.data(),
                                        .futureX = future_.data(),
                                        .futureY = future_.data() + movingCount,
                                        .contacts = records != nullptr ? contacts_.data() : nullptr,
                                        .capacity = static_cast<std::uint32_t>(
                                            std::min<std::size_t>(contacts_.capacity(), none))};
        const Launch& launch = state_.launch();
        if (first && newCells) {
            check(cudaMemsetAsync(heads_.data(), 0xff, heads_.capacity() * sizeof(std::uint32_t),
                                  launch.stream),
                  "cudaMemsetAsync");
            findCellTurns(launch, state_.cells(), order);
        }
        resolveBaseline(launch, state_.bodies(), state_.cells(), order, step.restitution,
                        state_.touched());
        state_.begin(Phase::CopyToHost);
        publishBaseline(launch, state_.bodies(), order, state_.touched(), state_.hostResult(),
                        2 * expected_);
        state_.end(Phase::CopyToHost);
        counts = state_.finish();
        if (counts.collisions > none) {
            throw DeviceError("cuda: more contacts in a step than 32 bits can count");
        }
        expected_ = static_cast<std::uint32_t>(
            std::clamp<std::uint64_t>(counts.collisions + counts.collisions / 4, 1024, none / 2));
        if (records == nullptr || counts.collisions <= contacts_.capacity()) break;
        state_.restart(bodies);
    }
    if (records != nullptr) appendRecords(counts.collisions, step, *records);
    hitsFalse_ = true;
    state_.writeBack(bodies);
    return {.contacts = counts.collisions,
            .collisions = counts.collisions,
            .pairsTested = counts.tested};
}

template <class Real>
void CudaBaseline<Real>::appendRecords(std::uint64_t count, const StepParameters<Real>& step,
                                       std::vector<ContactRecord>& records) const {
    constexpr std::uint32_t staticBit = PendingContact<Real>::staticBit;
    std::vector<BaselineContact<Real>> contacts(count);
    state_.fetch(contacts.data(), contacts_.data(), count * sizeof contacts[0]);
    std::sort(contacts.begin(), contacts.end(), [](const auto& p, const auto& q) {
        return std::tie(p.cell, p.i, p.j) < std::tie(q.cell, q.i, q.j);
    });
    for (const BaselineContact<Real>& c : contacts) {
        const auto b = static_cast<std::int64_t>(c.b & ~staticBit);
        records.push_back(
            makeRecord(c.a, (c.b & staticBit) != 0 ? -1 - b : b, c.penetration, step));
    }
}

template class CudaBaseline<double>;
template class CudaBaseline<float>;

}  // namespace quadrille::cuda
