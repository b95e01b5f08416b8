#include <cstring>
#include <cuda_runtime.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "collision/rules/baseline_contact.hpp"
#include "collision/rules/bodies.hpp"
#include "collision/rules/cell_ownership.hpp"
#include "collision/rules/closeness.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/discrete_motion.hpp"
#include "collision/rules/double_double.hpp"
#include "collision/rules/event_order.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/fine_grid.hpp"
#include "collision/rules/impulse_contact.hpp"
#include "collision/rules/keep_out.hpp"
#include "collision/rules/leaf_rule.hpp"
#include "collision/rules/mix64.hpp"
#include "collision/rules/next_event.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "collision/rules/path_sketch.hpp"
#include "collision/rules/paths.hpp"
#include "collision/rules/rest_rules.hpp"
#include "collision/rules/static_map_view.hpp"
#include "collision/rules/step_parameters.hpp"
#include "collision/rules/trajectory.hpp"
#include "kernel_test.hpp"

// The rules of the law `continuous` must give the same bits on host and device.

namespace quadrille {
namespace {

/// The other bodies, as a kernel names them.
struct Others {
    const BodyRef* first;
    const BodyRef* last;

    QUADRILLE_HD const BodyRef* begin() const { return first; }
    QUADRILLE_HD const BodyRef* end() const { return last; }
};

/// Two moving bodies over a static one, and what the rules make of them.
template <class Real>
struct Case {
    Real x[2], y[2], vx[2], vy[2], halfWidth[2], halfHeight[2], mass[2];
    Anchor<Real> anchors[2];
    std::uint8_t rests[2];
    Real fixedX, fixedY, fixedHalfWidth, fixedHalfHeight;
    std::uint32_t entity[2], fixedEntity;
    double gravityX, gravityY, restitution;

    // out
    static constexpr int mostEvents = 12;
    PairEvent events[mostEvents];
    int count;
    EventOutcome outcome[2];
    bool released, leaves;
};

/// Hands events on in the order in which they happen, as a queue would.
template <class Real>
struct Collect {
    Case<Real>& c;
    EventOrder isLater;

    QUADRILLE_HD void operator()(const PairEvent& event) const {
        if (c.count == Case<Real>::mostEvents) return;
        int i = c.count++;
        for (; i > 0 && isLater(c.events[i - 1], event); --i) c.events[i] = c.events[i - 1];
        c.events[i] = event;
    }
};

/// A group of the two bodies themselves.
template <class Motion>
struct NoGroups {
    const Motion& motion;
    const PairEvent& event;

    QUADRILLE_HD PushedSide side(BodyRef body, int axis, double sense) const {
        if (body.isStatic()) return {0, true};
        const double mass = motion.bodies.moving.mass[body.row()];
        return {mass, isHeld(motion, body, axis, sense)};
    }
    QUADRILLE_HD double operator()(int axis, double sense) const {
        const auto goOn = [&](std::uint32_t row, double velocity) {
            goOnWith(motion, row, axis, velocity, event.time);
        };
        return collideGroups(
            motion, event, axis, side(BodyRef::moving(event.a), axis, -sense),
            side(event.b, axis, sense), [&](double velocity) { goOn(event.a, velocity); },
            [&](double velocity) { goOn(event.b.row(), velocity); });
    }
};

/// Finds what happens first within a second and carries it out.
template <class Path, class Real>
QUADRILLE_HD void apply(Case<Real>& c) {
    using Motion = ExactMotion<Real, Path>;
    const Motion motion{
        {{c.x,
          c.y,
          c.vx,
          c.vy,
          {c.halfWidth, Real(0)},
          {c.halfHeight, Real(0)},
          {c.mass, Real(0)},
          c.entity,
          {nullptr},
          c.anchors,
          c.rests},
         {&c.fixedX, &c.fixedY, &c.fixedHalfWidth, &c.fixedHalfHeight, &c.fixedEntity, {nullptr}}},
        c.gravityX,
        c.gravityY,
        c.restitution};
    const Collect<Real> emit{c, eventOrder(motion.bodies)};
    const BodyRef bodies[3] = {BodyRef::moving(0), BodyRef::moving(1), BodyRef::fixed(0)};
    const Others ofFirst{bodies + 1, bodies + 3};
    findBetween(motion, 1, bodies[2], 0, 1, emit);
    findFor(motion, 0, ofFirst, 0.0, 1.0, emit);
    c.leaves = outruns(motion, 0, 0, 1, SpeedBounds{.common = 5});
    if (c.count == 0) return;
    const PairEvent& event = c.events[0];
    if (event.release) {
        c.released = release(motion, event.a, Others{&event.b, &event.b + 1},
                             event.axes == axisX ? 0 : 1, event.time);
    } else {
        const EventContact contact = contactOf(motion, event);
        const NoGroups<Motion> groups{motion, event};
        if ((contact.axes & axisX) != 0) {
            c.outcome[0] = collide(motion, event, 0, contact.senseX, groups);
        }
        if ((contact.axes & axisY) != 0) {
            c.outcome[1] = collide(motion, event, 1, contact.senseY, groups);
        }
        const Path p = motion.path(event.a, 0);
        c.leaves = c.leaves != pushesAlong(motion, event.a, p, event.b, 0, 1, event.time);
    }
    for (std::uint32_t row = 0; row < 2; ++row) motion.place(row, 1);
}

template <class Path, class Real>
__global__ void applyAll(Case<Real>* cases, int count) {
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) apply<Path>(cases[i]);
}

template <class Real>
std::vector<Case<Real>> randomCases(std::uint64_t seed, bool falls) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return static_cast<Real>(low + (high - low) * double(random() >> 11) * 0x1p-53);
    };
    std::vector<Case<Real>> cases(1 << 16);
    std::memset(static_cast<void*>(cases.data()), 0, cases.size() * sizeof cases[0]);
    for (Case<Real>& c : cases) {
        c.fixedHalfWidth = uniform(1, 6);
        c.fixedHalfHeight = uniform(0.5, 1);
        for (std::uint32_t i = 0; i < 2; ++i) {
            c.halfWidth[i] = uniform(0.5, 2);
            c.halfHeight[i] = uniform(0.5, 2);
            c.x[i] = uniform(-4, 4);
            const bool stands = random() % 2 == 0;
            c.y[i] = stands ? c.fixedHalfHeight + c.halfHeight[i] : uniform(1, 8);
            c.vx[i] = uniform(-20, 20);
            c.vy[i] = stands ? Real(0) : uniform(-20, 20);
            c.mass[i] = random() % 2 == 0 ? Real(1) : uniform(0.1, 10);
            c.anchors[i] = {c.x[i], c.y[i], c.vx[i], c.vy[i], 0, 0};
            c.rests[i] = falls && stands && random() % 2 == 0 ? axisY : std::uint8_t(0);
            c.entity[i] = static_cast<std::uint32_t>(random() % 1000);
        }
        c.fixedEntity = 1000;
        c.gravityX = 0;
        c.gravityY = falls ? -30 : 0;
        c.restitution = random() % 2 == 0 ? 1.0 : double(uniform(0, 1));
    }
    return cases;
}

/// Everything but the bytes between the members of an event, which have no values.
template <class Real>
void expectSame(const Case<Real>& h, const Case<Real>& d) {
    const auto same = [](const auto& p, const auto& q) {
        return std::memcmp(&p, &q, sizeof p) == 0;
    };
    ASSERT_TRUE(same(h.x, d.x) && same(h.y, d.y) && same(h.vx, d.vx) && same(h.vy, d.vy));
    ASSERT_TRUE(same(h.anchors, d.anchors) && same(h.rests, d.rests));
    ASSERT_TRUE(h.released == d.released && h.leaves == d.leaves);
    ASSERT_EQ(h.count, d.count);
    for (int i = 0; i < h.count; ++i) {
        const PairEvent& p = h.events[i];
        const PairEvent& q = d.events[i];
        ASSERT_TRUE(same(p.time, q.time));
        ASSERT_TRUE(p.a == q.a && p.b == q.b && p.axes == q.axes && p.release == q.release);
    }
    for (int axis = 0; axis < 2; ++axis) {
        const EventOutcome& p = h.outcome[axis];
        const EventOutcome& q = d.outcome[axis];
        ASSERT_TRUE(p.outcome == q.outcome && p.rests == q.rests);
        ASSERT_TRUE(same(p.impulse, q.impulse) && same(p.approach, q.approach));
    }
}

template <class Real, class Path>
void compareHostAndDevice(std::uint64_t seed) {
    std::vector<Case<Real>> host = randomCases<Real>(seed, Path::falls);
    std::vector<Case<Real>> device = host;
    const int count = static_cast<int>(host.size());
    int collisions = 0;
    int rests = 0;
    int released = 0;
    for (Case<Real>& c : host) {
        apply<Path>(c);
        for (const EventOutcome& outcome : c.outcome) {
            collisions += outcome.outcome == Outcome::Collision;
            rests += outcome.rests;
        }
        released += c.released;
    }
    EXPECT_GT(collisions, count / 8);
    if (Path::falls) {
        EXPECT_GT(rests, count / 100);
        EXPECT_GT(released, count / 100);
    }
    if (!hasDevice()) GTEST_SKIP() << "no CUDA device";
    Case<Real>* memory = nullptr;
    const std::size_t bytes = device.size() * sizeof device[0];
    check(cudaMalloc(&memory, bytes));
    check(cudaMemcpy(memory, device.data(), bytes, cudaMemcpyHostToDevice));
    applyAll<Path><<<(count + 127) / 128, 128>>>(memory, count);
    check(cudaGetLastError());
    check(cudaMemcpy(device.data(), memory, bytes, cudaMemcpyDeviceToHost));
    check(cudaFree(memory));
    for (std::size_t i = 0; i < host.size(); ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
        expectSame(host[i], device[i]);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(EventRulesOnDevice, GiveTheBitsOfTheHostInDouble) {
    compareHostAndDevice<double, StraightPath>(20270101);
}

TEST(EventRulesOnDevice, GiveTheBitsOfTheHostInFloat) {
    compareHostAndDevice<float, StraightPath>(20270102);
}

TEST(EventRulesOnDevice, GiveTheBitsOfTheHostInDoubleWhereBodiesFall) {
    compareHostAndDevice<double, FallingPath>(20270103);
}

TEST(EventRulesOnDevice, GiveTheBitsOfTheHostInFloatWhereBodiesFall) {
    compareHostAndDevice<float, FallingPath>(20270104);
}

}  // namespace
}  // namespace quadrille
