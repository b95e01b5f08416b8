#include "collision/discrete/sequential_impulse.hpp"

#include <algorithm>

#include "collision/discrete/impulse_bodies.hpp"

namespace quadrille {

template <class Real>
ResolveCounts SequentialImpulse<Real>::resolve(const BodyView<Real>& view,
                                               const Partition<Real>& partition,
                                               const StepParameters<Real>& step,
                                               std::vector<ContactRecord>* records) {
    const Bodies<Real> bodies = makeBodies(view);
    contacts_.clear();
    const std::uint64_t tested = narrowPhase_.find(
        view, partition,
        [&](MovingPair p) { contacts_.push_back(movingContact(bodies, p.a, p.b, step.dt)); },
        [&](StaticPair p) { contacts_.push_back(staticContact(bodies, p.a, p.fixed, step.dt)); });

    sort_(contacts_, step.dt);
    if (!partition.complete) {
        // Cells that are out of date may share a pair more than once.
        contacts_.erase(std::unique(contacts_.begin(), contacts_.end(), samePair<Real>),
                        contacts_.end());
    }

    ResolveCounts counts{.contacts = contacts_.size(), .pairsTested = tested};
    for (const PendingContact<Real>& c : contacts_) {
        const bool collided = resolveContact(bodies, c, step);
        counts.collisions += collided;
        if (records != nullptr) records->push_back(makeRecord(c, step.start, collided));
    }
    return counts;
}

template class SequentialImpulse<double>;
template class SequentialImpulse<float>;

}  // namespace quadrille
