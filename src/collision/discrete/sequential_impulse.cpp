#include "collision/discrete/sequential_impulse.hpp"

#include <algorithm>

#include "collision/make_record.hpp"

namespace quadrille {

/// Not inlined: contacts with static bodies are few, and the code would stand in the way of the
/// loop that looks for pairs.
template <class Real>
[[gnu::noinline]] void SequentialImpulse<Real>::addStatic(const Bodies<Real>& bodies, StaticPair p,
                                                          Real dt) {
    contacts_.push_back(staticContact(bodies, p.a, p.fixed, dt));
}

/// Lists the bodies that have contacts, and where they stood when the step began.
template <class Real>
void SequentialImpulse<Real>::listTouched(const Bodies<Real>& bodies, std::size_t movingCount,
                                          Real dt) {
    if (++mark_ == 0 || movingCount > marks_.size()) {
        marks_.assign(movingCount, 0);
        mark_ = 1;
    }
    // Room for one more, which is written and not counted: whether a body is listed already is a
    // coin toss that a branch would lose.
    const std::size_t most = std::min(2 * contacts_.size(), movingCount) + 1;
    if (touched_.size() < most) touched_.resize(most);
    std::size_t count = 0;
    const auto list = [&](std::uint32_t row) {
        touched_[count] = row;
        count += marks_[row] != mark_;
        marks_[row] = mark_;
    };
    for (const PendingContact<Real>& c : contacts_) {
        list(c.a);
        if (!c.b.isStatic()) list(c.b.row());
    }
    touchedCount_ = count;
    if (starts_.size() < most) starts_.resize(most);
    for (std::size_t i = 0; i < count; ++i) {
        starts_[i] = placeBefore<Real>(bodies.moving, touched_[i], dt);
    }
}

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
        [&](StaticPair p) { addStatic(bodies, p, dt); });
    barrier_.update(view);
    if (barrier_.any()) listTouched(bodies, view.moving.size(), dt);

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
    if (!barrier_.any()) return;
    for (std::size_t i = 0; i < touchedCount_; ++i) {
        barrier_.keepOut(bodies, touched_[i], starts_[i]);
    }
}

template class SequentialImpulse<double>;
template class SequentialImpulse<float>;

}  // namespace quadrille
