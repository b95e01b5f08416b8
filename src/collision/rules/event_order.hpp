#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/contact_order.hpp"

/// What an event of the law `continuous` is, and which comes first, for host and device alike.

namespace quadrille {

/// What is going to happen to a pair of bodies, unless something happens to one of them before.
struct PairEvent {
    double time;                   ///< s
    std::uint32_t a;               ///< row of the moving body that was created first
    BodyRef b;                     ///< the other one
    std::uint32_t stampA, stampB;  ///< of the paths that it was found from; 0 for a static body
    std::uint8_t axes;             ///< of the contact; 0 for a pair that overlaps already
    bool release;                  ///< the axes' support comes to its end

    QUADRILLE_HD bool withStatic() const { return b.isStatic(); }
};

/// An event of a moving body and another, without axes and stamps.
template <class Real>
QUADRILLE_HD inline PairEvent pairEvent(const Bodies<Real>& bodies, std::uint32_t row, BodyRef b,
                                        double time) {
    const auto& created = bodies.moving.created;
    const bool inOrder = b.isStatic() || created[row] < created[b.row()];
    return {.time = time,
            .a = inOrder ? row : b.row(),
            .b = inOrder ? b : BodyRef::moving(row),
            .stampA = 0,
            .stampB = 0,
            .axes = 0,
            .release = false};
}

/// The order in which events are carried out: by time; then by the hash of the pair's entities, by
/// when its bodies were created, and by what happens, so that of two events that differ one is
/// first, whoever found them.
struct EventOrder {
    const std::uint32_t* moving = nullptr;  ///< entities of moving and of static bodies
    const std::uint32_t* fixed = nullptr;
    CreationNumbers movingCreated{}, fixedCreated{};

    QUADRILLE_HD std::uint32_t priority(const PairEvent& e) const {
        return pairPriority(moving[e.a], (e.withStatic() ? fixed : moving)[e.b.row()]);
    }

    /// Whether p comes after q.
    QUADRILLE_HD bool operator()(const PairEvent& p, const PairEvent& q) const {
        if (p.time != q.time) return p.time > q.time;
        return tieIsLater(p, q);
    }
    QUADRILLE_HD bool tieIsLater(const PairEvent& p, const PairEvent& q) const {
        const std::uint32_t first = priority(p);
        const std::uint32_t second = priority(q);
        if (first != second) return first > second;
        if (p.a != q.a) return movingCreated[p.a] > movingCreated[q.a];
        if (!(p.b == q.b)) {
            if (p.withStatic() != q.withStatic()) return p.withStatic();
            const CreationNumbers& created = p.withStatic() ? fixedCreated : movingCreated;
            return created[p.b.row()] > created[q.b.row()];
        }
        if (p.axes != q.axes) return p.axes > q.axes;
        return p.release && !q.release;
    }
};

template <class Real>
QUADRILLE_HD inline EventOrder eventOrder(const Bodies<Real>& bodies) {
    return {.moving = bodies.moving.entity,
            .fixed = bodies.fixed.entity,
            .movingCreated = bodies.moving.created,
            .fixedCreated = bodies.fixed.created};
}

}  // namespace quadrille
