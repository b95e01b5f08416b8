#include "cuda/resident/resident_impulse.hpp"

#include <cstdint>

#include "collision/integrate.hpp"
#include "cuda/device/range.hpp"
#include "cuda/resident/resident_grid.hpp"

namespace quadrille::cuda {

template <class Real>
bool ResidentImpulse<Real>::load(const LawBodies<Real>& all, double, PhaseClock& clock) {
    const BodyView<Real> bodies = all.read();
    bodies_.load(bodies, clock);
    grid_.lay(gridFor(config_.partitioner, bodies.moving.size(), meanExtent(bodies), worldSize_),
              worldSize_);
    hostCounts_.reserve(1);
    map_.load(bodies);
    if (!map_.empty()) starts_.reserve(bodies.moving.size());
    return true;
}

template <class Real>
ResidentCounts ResidentImpulse<Real>::tryStep(Step<Real>& step) {
    const DeviceContacts<Real> list = contacts_.begin(true, step.keepContacts);
    findContacts(device_.launch(), bodies_.bodies(), grid_.cells(), grid_.ownership(),
                 step.parameters.dt, list);
    const bool keptOut = !map_.empty();
    if (keptOut) {
        noteStarts(device_.launch(), bodies_.bodies(), list, step.parameters.dt, starts_.data(),
                   contacts_.expected());
    }
    contacts_.resolve(list, step.parameters);
    if (keptOut) {
        keepTouchedOut(device_.launch(), bodies_.bodies(), bodies_.touched(), map_.view(),
                       starts_.data(), 2 * contacts_.expected());
    }
    finishStep(device_.launch(), list.heads, bodies_.touched(), grid_.entries(), grid_.badRow(),
               hostCounts_.data(), 2 * contacts_.expected());
    device_.finish(step.clock);
    return *hostCounts_.data();
}

template <class Real>
double ResidentImpulse<Real>::step(Step<Real>& step) {
    const Range range("quadrille resident impulse");
    records_.clear();
    cellsHere_ = false;
    device_.begin(Phase::Integrate, step.clock);
    bodies_.moveOn(step.parameters);
    device_.end(Phase::Integrate, step.clock);
    device_.begin(Phase::Partition, step.clock);
    grid_.sort();
    device_.end(Phase::Partition, step.clock);

    ResidentCounts counts = tryStep(step);
    while (counts.badRow == none &&
           (grid_.lacksRoom(counts.entries) || contacts_.lacksRoom(counts.step))) {
        if (grid_.lacksRoom(counts.entries)) {
            grid_.sortAgain(counts.entries);
        } else {
            contacts_.makeRoom(counts.step.contacts);
        }
        bodies_.zeroCounts();
        counts = tryStep(step);
    }
    contacts_.end(counts.step);
    if (counts.badRow != none) failNotFinite(bodies_.entityAt(counts.badRow));
    grid_.expect(counts.entries);
    step.counts.contacts += counts.step.contacts;
    step.counts.collisions += counts.step.collisions;
    step.counts.pairsTested += counts.step.tested;
    if (step.keepContacts) contacts_.fetch(counts.step.contacts, step.parameters, records_);
    step.rebuilt = true;
    return step.to;
}

template <class Real>
const Cells& ResidentImpulse<Real>::cells() {
    if (!cellsHere_) grid_.fetch(cells_);
    cellsHere_ = true;
    return cells_;
}

template <class Real>
std::size_t ResidentImpulse<Real>::bytes() const {
    return device_.memoryUsed() + bodies_.hostBytes() + map_.hostBytes() + hostCounts_.bytes() +
           records_.capacity() * sizeof(ContactRecord);
}

template class ResidentImpulse<double>;
template class ResidentImpulse<float>;

}  // namespace quadrille::cuda

namespace quadrille {

template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentImpulse(const SimulationConfig& config,
                                                            const Vec2& worldSize,
                                                            const ThreadTeam& team) {
    return std::make_unique<cuda::ResidentImpulse<Real>>(config, worldSize, team);
}

#define QUADRILLE_INSTANTIATE(Real)                                       \
    template std::unique_ptr<ResidentPipeline<Real>> makeResidentImpulse( \
        const SimulationConfig&, const Vec2&, const ThreadTeam&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille
