#include "cuda/resident/resident_impulse.hpp"

#include <cstdint>
#include <utility>

#include "collision/integrate.hpp"
#include "cuda/device/range.hpp"
#include "cuda/resident/resident_grid.hpp"

namespace quadrille::cuda {

template <class Real>
bool ResidentImpulse<Real>::load(const LawBodies<Real>& all, double, PhaseClock& clock) {
    const BodyView<Real> bodies = all.read();
    bodies_.load(bodies, clock);
    // Larger cells cost fewer entries and more pairs; so large, both cost about the same.
    const double extent = 1.5 * meanExtent(bodies);
    grid_.lay(gridFor(config_.partitioner, bodies.moving.size(), extent, worldSize_), worldSize_);
    hostCounts_.reserve(1);
    replay_.forget();
    shape_ = {};
    map_.load(bodies);
    if (!map_.empty()) starts_.reserve(bodies.moving.size());
    return true;
}

template <class Real>
DeviceContacts<Real> ResidentImpulse<Real>::begin(bool keepContacts) {
    DeviceContacts<Real> list = contacts_.begin(true, keepContacts);
    if (!map_.empty()) list.starts = starts_.data();
    return list;
}

/// Finds contacts in the cells and resolves them, unless there is no room for entries or contacts.
template <class Real>
void ResidentImpulse<Real>::enqueueTry(const DeviceContacts<Real>& list, const Step<Real>& step) {
    findContacts(device_.launch(), bodies_.bodies(), grid_.cells(), grid_.ownership(),
                 step.parameters.dt, list);
    contacts_.resolve(list, step.parameters);
    finishStep(device_.launch(), bodies_.bodies(), list, bodies_.touched(),
               map_.empty() ? StaticMapView<Real>{} : map_.view(), grid_.entries(), grid_.badRow(),
               hostCounts_.data(), 2 * contacts_.expected());
}

template <class Real>
void ResidentImpulse<Real>::enqueueStep(const DeviceContacts<Real>& list, const Step<Real>& step) {
    device_.begin(Phase::Integrate, step.clock);
    bodies_.moveOn(step.parameters);
    device_.end(Phase::Integrate, step.clock);
    device_.begin(Phase::Partition, step.clock);
    grid_.sort();
    device_.end(Phase::Partition, step.clock);
    enqueueTry(list, step);
}

template <class Real>
double ResidentImpulse<Real>::step(Step<Real>& step) {
    const Range range("quadrille resident impulse");
    records_.clear();
    cellsHere_ = false;
    grid_.prepare();
    const DeviceContacts<Real> list = begin(step.keepContacts);
    const Shape shape{contacts_.expected(), list.capacity, grid_.room(), step.keepContacts};
    if (shape != shape_) replay_.forget();
    // Recording a step pays if the next one is the same. One that is profiled has its clocks in it.
    if (std::exchange(shape_, shape) == shape && !step.clock.enabled()) {
        replay_.run(device_.launch().stream, [&] { enqueueStep(list, step); });
    } else {
        enqueueStep(list, step);
    }
    device_.finish(step.clock);

    ResidentCounts counts = *hostCounts_.data();
    while (counts.badRow == none &&
           (grid_.lacksRoom(counts.entries) || contacts_.lacksRoom(counts.step))) {
        if (grid_.lacksRoom(counts.entries)) {
            grid_.sortAgain(counts.entries);
        } else {
            contacts_.makeRoom(counts.step.contacts);
        }
        bodies_.zeroCounts();
        enqueueTry(begin(step.keepContacts), step);
        device_.finish(step.clock);
        counts = *hostCounts_.data();
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
