#include "collision/discrete/sequential_baseline.hpp"

#include "collision/make_record.hpp"
#include "collision/rules/baseline_contact.hpp"
#include "collision/rules/pair_geometry.hpp"

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
        const std::size_t moving = movingAmong(members);
        for (std::size_t i = 0; i < moving; ++i) {
            const std::uint32_t a = members[i].row();
            Box<Real> box = movingBox(bodies.now, a);
            const auto resolveAmong = [&](std::size_t first, std::size_t last, auto&& boxOf) {
                for (std::size_t j = first; j < last; ++j) {
                    if (!overlap(box, boxOf(members[j].row()))) continue;
                    resolvePair(a, members[j]);
                    box = movingBox(bodies.now, a);
                }
            };
            resolveAmong(i + 1, moving,
                         [&](std::uint32_t row) { return movingBox(bodies.now, row); });
            resolveAmong(moving, members.size(),
                         [&](std::uint32_t row) { return staticBox(bodies.now, row); });
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
