#include "collision/discrete/sequential_baseline.hpp"

#include "collision/make_record.hpp"
#include "collision/rules/baseline_contact.hpp"

namespace quadrille {

template <class Real>
void SequentialBaseline<Real>::resolve(const LawBodies<Real>& view,
                                       const Partition<Real>& partition, Step<Real>& step) {
    futureX_.resize(view.moving.size());
    futureY_.resize(view.moving.size());
    hit_.clear();
    records_.clear();
    const BaselineBodies<Real> bodies{view.plain(), futureX_.data(), futureY_.data()};
    const Real restitution = step.parameters.restitution;

    const auto resolvePair = [&](std::uint32_t a, BodyRef b) {
        if (!overlap(bodies.now, a, b)) return;
        const BaselineOutcome<Real> outcome = resolveBaseline(bodies, a, b, restitution);
        hit_.push_back(a);
        if (!b.isStatic()) hit_.push_back(b.row());
        ++step.counts.contacts;
        ++step.counts.collisions;
        if (step.keepContacts) records_.push_back(makeRecord(a, b, outcome, step.parameters));
    };

    const Cells& cells = partition.cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto members = cells[c];
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (members[i].isStatic()) break;  // members ascend: only static ones follow
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                resolvePair(members[i].row(), members[j]);
            }
            step.counts.pairsTested += members.size() - i - 1;
        }
    }
    for (const std::uint32_t row : hit_) {
        view.moving.vx[row] = futureX_[row];
        view.moving.vy[row] = futureY_[row];
    }
}

template class SequentialBaseline<double>;
template class SequentialBaseline<float>;

}  // namespace quadrille
