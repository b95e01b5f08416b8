#include "cuda/discrete/cuda_baseline.hpp"

#include <algorithm>
#include <tuple>

#include <quadrille/error.hpp>

#include "collision/make_record.hpp"
#include "cuda/device/range.hpp"

namespace quadrille::cuda {

/// Makes room for the bodies, cells and contacts, and brings what a step needs to its initial
/// value.
template <class Real>
void CudaBaseline<Real>::reserve(bool keepContacts) {
    const std::size_t count = bodies_.movingCount();
    heads_.reserve(count);
    next_.reserve(cells_.cells().entries);
    turns_.reserve(cells_.cells().entries);
    future_.reserve(2 * count);
    if (hit_.reserve(count) || !hitsFalse_) device_.fill(hit_, 0);
    hitsFalse_ = false;
    done_.reserve(count);
    device_.fill(done_, 0, count);
    if (keepContacts) device_.reserveZeroed(contacts_, expected_);
}

template <class Real>
BaselineOrder<Real> CudaBaseline<Real>::order(bool keepContacts) const {
    return {
        .heads = heads_.data(),
        .next = next_.data(),
        .turns = turns_.data(),
        .done = done_.data(),
        .hit = hit_.data(),
        .futureX = future_.data(),
        .futureY = future_.data() + bodies_.movingCount(),
        .contacts = keepContacts ? contacts_.data() : nullptr,
        .capacity = static_cast<std::uint32_t>(std::min<std::size_t>(contacts_.capacity(), none))};
}

template <class Real>
StepCounts CudaBaseline<Real>::tryStep(const Partition<Real>& partition, Step<Real>& step) {
    reserve(step.keepContacts);
    const BaselineOrder<Real> order = this->order(step.keepContacts);
    const Launch& launch = device_.launch();
    if (turnsOf_ != partition.generation) {
        device_.fill(heads_, 0xff);
        findCellTurns(launch, cells_.cells(), order);
        turnsOf_ = partition.generation;
    }
    launchBaseline(launch, bodies_.bodies(), cells_.cells(), order, step.parameters.restitution,
                   bodies_.touched());
    device_.begin(Phase::CopyToHost, step.clock);
    publishBaseline(launch, bodies_.bodies(), order, bodies_.touched(), bodies_.hostResult(),
                    2 * expected_);
    device_.end(Phase::CopyToHost, step.clock);
    const StepCounts counts = bodies_.finish(step.clock);
    if (counts.collisions > none) {
        throw DeviceError("cuda: more contacts in a step than 32 bits can count");
    }
    expected_ = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(counts.collisions + counts.collisions / 4, 1024, none / 2));
    return counts;
}

template <class Real>
void CudaBaseline<Real>::resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                                 Step<Real>& step) {
    const Range range("quadrille baseline");
    StepCounts counts = tryStep(partition, step);
    while (step.keepContacts && counts.collisions > contacts_.capacity()) {
        bodies_.restart(bodies, step.clock);
        counts = tryStep(partition, step);
    }
    hitsFalse_ = true;
    step.counts.contacts += counts.collisions;
    step.counts.collisions += counts.collisions;
    step.counts.pairsTested += counts.tested;
}

template <class Real>
void CudaBaseline<Real>::fetchContacts(std::size_t count, const StepParameters<Real>& step,
                                       std::vector<ContactRecord>& records) const {
    std::vector<BaselineContact<Real>> contacts(count);
    device_.fetch(contacts.data(), contacts_.data(), count * sizeof contacts[0]);
    std::sort(contacts.begin(), contacts.end(), [](const auto& p, const auto& q) {
        return std::tie(p.cell, p.i, p.j) < std::tie(q.cell, q.i, q.j);
    });
    for (const BaselineContact<Real>& c : contacts) {
        records.push_back(makeRecord(c.a, c.b, c.outcome, step));
    }
}

template class CudaBaseline<double>;
template class CudaBaseline<float>;

}  // namespace quadrille::cuda
