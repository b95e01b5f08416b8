#include "collision/sequential_impulse.hpp"

#include <algorithm>

namespace quadrille {

namespace {

using std::uint32_t;

template <class Real>
PendingContact<Real> pending(const Impact<Real>& impact, Real dt, uint32_t entityA,
                             uint32_t entityB, uint32_t a, uint32_t b) {
    return {.sinceStart = impact.overlapBefore ? Real(0) : dt - impact.since,
            .priority = pairPriority(entityA, entityB),
            .a = a,
            .b = b,
            .axes = impact.axes,
            .overlapBefore = impact.overlapBefore,
            .senseX = impact.senseX,
            .senseY = impact.senseY};
}

/// One axis of a contact between two moving bodies.
template <class Real>
bool resolveAxis(std::span<Real> position, std::span<Real> velocity, const ColumnView<Real>& half,
                 const ColumnView<Real>& mass, const PendingContact<Real>& c, Real sense,
                 const StepParameters<Real>& step) {
    AxisState<Real> a{position[c.a], velocity[c.a]};
    AxisState<Real> b{position[c.b], velocity[c.b]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    const bool collided = collide(a, b, mass[c.a], mass[c.b], step.restitution,
                                  half[c.a] + half[c.b], sense, since, c.overlapBefore != 0);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    position[c.b] = b.position;
    velocity[c.b] = b.velocity;
    return collided;
}

/// One axis of a contact between a moving body and a static one.
template <class Real>
bool resolveStaticAxis(std::span<Real> position, std::span<Real> velocity,
                       const ColumnView<Real>& half, Real fixedPosition, Real fixedHalf,
                       const PendingContact<Real>& c, Real sense, Real gravity,
                       const StepParameters<Real>& step) {
    AxisState<Real> a{position[c.a], velocity[c.a]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    // An old overlap counts as an impact at the start of the step, as its sinceStart says.
    const Real gained = gainedSinceImpact(gravity, step.dt - c.sinceStart, step.dt);
    const bool collided = collideStatic(a, fixedPosition, step.restitution, half[c.a] + fixedHalf,
                                        sense, since, c.overlapBefore != 0, gained);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    return collided;
}

template <class Real>
bool resolveContact(const BodyView<Real>& bodies, const PendingContact<Real>& c,
                    const StepParameters<Real>& step) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    bool collided = false;
    if ((c.b & PendingContact<Real>::staticBit) == 0) {
        if ((c.axes & axisX) != 0) {
            collided |= resolveAxis(m.x, m.vx, m.halfWidth, m.mass, c, Real(c.senseX), step);
        }
        if ((c.axes & axisY) != 0) {
            collided |= resolveAxis(m.y, m.vy, m.halfHeight, m.mass, c, Real(c.senseY), step);
        }
    } else {
        const uint32_t k = c.b & ~PendingContact<Real>::staticBit;
        if ((c.axes & axisX) != 0) {
            collided |= resolveStaticAxis(m.x, m.vx, m.halfWidth, f.x[k], f.halfWidth[k], c,
                                          Real(c.senseX), step.gravityX, step);
        }
        if ((c.axes & axisY) != 0) {
            collided |= resolveStaticAxis(m.y, m.vy, m.halfHeight, f.y[k], f.halfHeight[k], c,
                                          Real(c.senseY), step.gravityY, step);
        }
    }
    return collided;
}

}  // namespace

template <class Real>
ResolveCounts SequentialImpulse<Real>::resolve(const BodyView<Real>& bodies,
                                               const Partition<Real>& partition,
                                               const StepParameters<Real>& step,
                                               std::vector<ContactRecord>* records) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    constexpr uint32_t staticBit = PendingContact<Real>::staticBit;

    contacts_.clear();
    const std::uint64_t tested = narrowPhase_.find(
        bodies, partition,
        [&](MovingPair p) {
            const auto impact =
                impactOf(m.x[p.b] - m.x[p.a], m.y[p.b] - m.y[p.a], m.vx[p.b] - m.vx[p.a],
                         m.vy[p.b] - m.vy[p.a], m.halfWidth[p.a] + m.halfWidth[p.b],
                         m.halfHeight[p.a] + m.halfHeight[p.b], step.dt);
            contacts_.push_back(pending(impact, step.dt, m.entity[p.a], m.entity[p.b], p.a, p.b));
        },
        [&](StaticPair p) {
            const auto impact =
                impactOf(f.x[p.fixed] - m.x[p.a], f.y[p.fixed] - m.y[p.a], -m.vx[p.a], -m.vy[p.a],
                         m.halfWidth[p.a] + f.halfWidth[p.fixed],
                         m.halfHeight[p.a] + f.halfHeight[p.fixed], step.dt);
            contacts_.push_back(pending(impact, step.dt, m.entity[p.a], f.entity[p.fixed], p.a,
                                        p.fixed | staticBit));
        });

    sort_(contacts_, step.dt);
    if (!partition.complete) {
        // Cells that are out of date may share a pair more than once.
        const auto same = [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b; };
        contacts_.erase(std::unique(contacts_.begin(), contacts_.end(), same), contacts_.end());
    }

    ResolveCounts counts{.contacts = contacts_.size(), .pairsTested = tested};
    for (const PendingContact<Real>& c : contacts_) {
        const bool collided = resolveContact(bodies, c, step);
        counts.collisions += collided;
        if (records != nullptr) {
            const bool isStatic = (c.b & staticBit) != 0;
            const auto b = static_cast<std::int64_t>(c.b & ~staticBit);
            records->push_back({.time = step.start + static_cast<double>(c.sinceStart),
                                .a = c.a,
                                .b = isStatic ? -1 - b : b,
                                .axes = c.axes,
                                .senseX = c.senseX,
                                .senseY = c.senseY,
                                .collided = collided});
        }
    }
    return counts;
}

template class SequentialImpulse<double>;
template class SequentialImpulse<float>;

}  // namespace quadrille
