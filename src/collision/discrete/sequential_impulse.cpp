#include "collision/discrete/sequential_impulse.hpp"

#include <algorithm>

#include "collision/make_record.hpp"

namespace quadrille {

template <class Real>
void SequentialImpulse<Real>::resolve(const LawBodies<Real>& view, const Partition<Real>& partition,
                                      Step<Real>& step) {
    const Bodies<Real> bodies = view.plain();
    const Real dt = step.parameters.dt;
    contacts_.clear();
    records_.clear();
    step.counts.pairsTested += narrowPhase_.find(
        view.read(), partition,
        [&](MovingPair p) { contacts_.push_back(movingContact(bodies, p.a, p.b, dt)); },
        [&](StaticPair p) { contacts_.push_back(staticContact(bodies, p.a, p.fixed, dt)); });

    sort_(contacts_, canonicalOrder(bodies), dt);
    if (!partition.complete) {
        // Cells that are out of date may share a pair more than once.
        contacts_.erase(std::unique(contacts_.begin(), contacts_.end(), samePair<Real>),
                        contacts_.end());
    }

    step.counts.contacts += contacts_.size();
    std::uint64_t collisions = 0;
    const auto resolveAll = [&](auto&& keep) {
        for (const PendingContact<Real>& c : contacts_) {
            const ContactOutcome<Real> outcome = resolveContact(bodies, c, step.parameters);
            collisions += outcome.collided();
            keep(c, outcome);
        }
    };
    // Two loops, so that without listeners nobody works out what a contact exchanges.
    if (step.keepContacts) {
        resolveAll([&](const auto& c, const auto& outcome) {
            records_.push_back(makeRecord(ResolvedContact<Real>{c, outcome}, step.from));
        });
    } else {
        resolveAll([](const auto&, const auto&) {});
    }
    step.counts.collisions += collisions;
}

template class SequentialImpulse<double>;
template class SequentialImpulse<float>;

}  // namespace quadrille
