#include "collision/discrete/sequential_baseline.hpp"

#include "collision/discrete/impulse_bodies.hpp"
#include "collision/rules/baseline_contact.hpp"

namespace quadrille {

template <class Real>
ResolveCounts SequentialBaseline<Real>::resolve(const BodyView<Real>& view,
                                                const Partition<Real>& partition,
                                                const StepParameters<Real>& step,
                                                std::vector<ContactRecord>* records) {
    const auto movingCount = static_cast<std::uint32_t>(view.moving.size());
    futureX_.resize(movingCount);
    futureY_.resize(movingCount);
    hit_.clear();
    const BaselineBodies<Real> bodies{makeBodies(view), futureX_.data(), futureY_.data()};

    ResolveCounts counts;
    const auto record = [&](std::uint32_t a, std::int64_t b, const Penetration<Real>& p) {
        hit_.push_back(a);
        if (b >= 0) hit_.push_back(static_cast<std::uint32_t>(b));
        ++counts.contacts;
        ++counts.collisions;
        if (records != nullptr) records->push_back(makeRecord(a, b, p, step));
    };

    const auto resolveMoving = [&](std::uint32_t a, std::uint32_t b) {
        if (!movingOverlap(bodies.now, a, b)) return;
        record(a, static_cast<std::int64_t>(b), resolveBaseline(bodies, a, b, step.restitution));
    };

    const auto resolveStatic = [&](std::uint32_t a, std::uint32_t k) {
        if (!staticOverlap(bodies.now, a, k)) return;
        record(a, -1 - static_cast<std::int64_t>(k),
               resolveBaselineStatic(bodies, a, k, step.restitution));
    };

    const Cells& cells = partition.cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto members = cells[c];
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (members[i] >= movingCount) break;  // members ascend: only static ones follow
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                if (members[j] < movingCount) {
                    resolveMoving(members[i], members[j]);
                } else {
                    resolveStatic(members[i], members[j] - movingCount);
                }
            }
            counts.pairsTested += members.size() - i - 1;
        }
    }
    for (const std::uint32_t row : hit_) {
        view.moving.vx[row] = futureX_[row];
        view.moving.vy[row] = futureY_[row];
    }
    return counts;
}

template class SequentialBaseline<double>;
template class SequentialBaseline<float>;

}  // namespace quadrille
