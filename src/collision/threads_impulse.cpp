#include "collision/threads_impulse.hpp"

#include "collision/impulse_bodies.hpp"

namespace quadrille {

template <class Real>
ResolveCounts ThreadsImpulse<Real>::resolve(const BodyView<Real>& view,
                                            const Partition<Real>& partition,
                                            const StepParameters<Real>& step,
                                            std::vector<ContactRecord>* records) {
    const ImpulseBodies<Real> bodies = makeImpulseBodies(view);
    for (auto& list : found_) list.contacts.clear();
    const std::uint64_t tested = narrowPhase_.find(
        view, partition,
        [&](unsigned worker, MovingPair p) {
            found_[worker].contacts.push_back(movingContact(bodies, p.a, p.b, step.dt));
        },
        [&](unsigned worker, StaticPair p) {
            found_[worker].contacts.push_back(staticContact(bodies, p.a, p.fixed, step.dt));
        });

    if (records == nullptr) {
        graph_.link(found_, view.moving.size());
    } else {
        // Only observers ask for an order of all contacts.
        auto& contacts = ordered_.contacts;
        contacts.clear();
        for (const auto& list : found_) {
            contacts.insert(contacts.end(), list.contacts.begin(), list.contacts.end());
        }
        sort_(contacts, step.dt);
        graph_.link({&ordered_, 1}, view.moving.size());
    }
    ResolveCounts counts = graph_.resolve(bodies, step);
    counts.pairsTested = tested;
    if (records != nullptr) {
        graph_.forEach([&](const PendingContact<Real>& c, bool collided) {
            records->push_back(makeRecord(c, step.start, collided));
        });
    }
    return counts;
}

template <class Real>
std::size_t ThreadsImpulse<Real>::bytes() const {
    std::size_t sum = narrowPhase_.bytes() + graph_.bytes() + sort_.bytes() +
                      found_.capacity() * sizeof(ContactList<Real>);
    for (const auto& list : found_) {
        sum += list.contacts.capacity() * sizeof(PendingContact<Real>);
    }
    return sum + ordered_.contacts.capacity() * sizeof(PendingContact<Real>);
}

template class ThreadsImpulse<double>;
template class ThreadsImpulse<float>;

}  // namespace quadrille
