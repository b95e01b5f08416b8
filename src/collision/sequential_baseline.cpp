#include "collision/sequential_baseline.hpp"

#include <array>

#include "collision/contact_law.hpp"

namespace quadrille {

template <class Real>
ResolveCounts SequentialBaseline<Real>::resolve(const BodyView<Real>& bodies,
                                                const Partition<Real>& partition,
                                                const StepParameters<Real>& step,
                                                std::vector<ContactRecord>* records) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    const auto movingCount = static_cast<std::uint32_t>(m.size());
    futureX_.resize(movingCount);
    futureY_.resize(movingCount);
    hit_.clear();

    // The velocity that the contact gives to body `self`: only the last one written counts.
    const auto reflect = [&](std::uint32_t self, const std::array<Real, 2>& other, Real share,
                             std::uint8_t axis) {
        std::array<Real, 2> v{m.vx[self], m.vy[self]};
        const std::size_t k = axis == axisX ? 0 : 1;
        v[k] = baselineVelocity(v[k], other[k], share, step.restitution);
        futureX_[self] = v[0];
        futureY_[self] = v[1];
        hit_.push_back(self);
    };

    ResolveCounts counts;
    const auto record = [&](std::uint32_t a, std::int64_t b, const Penetration<Real>& p) {
        ++counts.contacts;
        ++counts.collisions;
        if (records != nullptr) {
            const auto sense = static_cast<std::int8_t>(p.sense);
            records->push_back({.time = step.start + static_cast<double>(step.dt),
                                .a = a,
                                .b = b,
                                .axes = p.axis,
                                .senseX = sense,
                                .senseY = sense,
                                .collided = true});
        }
    };

    const auto resolveMoving = [&](std::uint32_t a, std::uint32_t b) {
        const Real reachX = m.halfWidth[a] + m.halfWidth[b];
        const Real reachY = m.halfHeight[a] + m.halfHeight[b];
        const Real dx = m.x[b] - m.x[a];
        const Real dy = m.y[b] - m.y[a];
        if (!overlaps(dx, dy, reachX, reachY)) return;
        const auto p = leastPenetration(dx, dy, reachX, reachY);
        const Real total = m.mass[a] + m.mass[b];
        const Real shareA = m.mass[b] / total;
        const Real shareB = m.mass[a] / total;
        auto& position = p.axis == axisX ? m.x : m.y;
        position[a] -= p.sense * (p.depth * shareA);
        position[b] += p.sense * (p.depth * shareB);
        reflect(a, {m.vx[b], m.vy[b]}, shareA, p.axis);
        reflect(b, {m.vx[a], m.vy[a]}, shareB, p.axis);
        record(a, static_cast<std::int64_t>(b), p);
    };

    const auto resolveStatic = [&](std::uint32_t a, std::uint32_t fixed) {
        const Real reachX = m.halfWidth[a] + f.halfWidth[fixed];
        const Real reachY = m.halfHeight[a] + f.halfHeight[fixed];
        const Real dx = f.x[fixed] - m.x[a];
        const Real dy = f.y[fixed] - m.y[a];
        if (!overlaps(dx, dy, reachX, reachY)) return;
        const auto p = leastPenetration(dx, dy, reachX, reachY);
        (p.axis == axisX ? m.x : m.y)[a] -= p.sense * p.depth;
        reflect(a, {Real(0), Real(0)}, Real(1), p.axis);
        record(a, -1 - static_cast<std::int64_t>(fixed), p);
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
        m.vx[row] = futureX_[row];
        m.vy[row] = futureY_[row];
    }
    return counts;
}

template class SequentialBaseline<double>;
template class SequentialBaseline<float>;

}  // namespace quadrille
