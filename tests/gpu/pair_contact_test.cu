#include <cstring>
#include <cuda_runtime.h>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "collision/rules/contact_order.hpp"
#include "collision/rules/pair_contact.hpp"
#include "kernel_test.hpp"

// The contact law and the canonical order must give the same bits on host and device: everything
// that resolves contacts in parallel rests on that.

namespace quadrille {
namespace {

/// A random pair, and what the law makes of it.
template <class Real>
struct Case {
    Real xa, ya, xb, yb, vxa, vya, vxb, vyb, massA, massB, reachX, reachY, dt, restitution, gravity;
    // out
    Impact<Real> impact;
    AxisState<Real> a, b, againstStatic;
    AxisOutcome<Real> outcome, outcomeStatic;
    std::uint32_t priority;
};

template <class Real>
QUADRILLE_HD void apply(Case<Real>& c) {
    c.impact =
        impactOf(c.xb - c.xa, c.yb - c.ya, c.vxb - c.vxa, c.vyb - c.vya, c.reachX, c.reachY, c.dt);
    c.a = {c.xa, c.vxa};
    c.b = {c.xb, c.vxb};
    c.outcome = collide(c.a, c.b, c.massA, c.massB, c.restitution, c.reachX, Real(c.impact.senseX),
                        c.impact.since, c.impact.overlapBefore);
    c.againstStatic = {c.ya, c.vya};
    c.outcomeStatic =
        collideStatic(c.againstStatic, c.massA, c.yb, c.restitution, c.reachY,
                      Real(c.impact.senseY), c.impact.since, c.impact.overlapBefore, c.gravity);
    c.priority = pairPriority(static_cast<std::uint32_t>(c.xa * 1000), 17u);
}

template <class Real>
__global__ void applyAll(Case<Real>* cases, int count) {
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) apply(cases[i]);
}

template <class Real>
void compareHostAndDevice(std::uint64_t seed) {
    constexpr int count = 1 << 18;
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return static_cast<Real>(low + (high - low) * double(random() >> 11) * 0x1p-53);
    };
    std::vector<Case<Real>> host(count);
    std::memset(static_cast<void*>(host.data()), 0, host.size() * sizeof host[0]);
    for (Case<Real>& c : host) {
        c.reachX = uniform(0.5, 4);
        c.reachY = uniform(0.5, 4);
        c.xa = uniform(1, 900);
        c.ya = uniform(-900, 900);
        c.xb = c.xa + c.reachX * uniform(-1, 1);
        c.yb = c.ya + c.reachY * uniform(-1, 1);
        c.vxa = uniform(-50, 50);
        c.vya = uniform(-50, 50);
        c.vxb = uniform(-50, 50);
        c.vyb = uniform(-50, 50);
        c.massA = uniform(0.01, 10);
        c.massB = random() % 2 == 0 ? c.massA : uniform(0.01, 10);
        c.dt = uniform(0.001, 0.1);
        c.restitution = random() % 2 == 0 ? Real(1) : uniform(0, 1);
        c.gravity = uniform(-200, 200);
    }
    std::vector<Case<Real>> device = host;
    Case<Real>* memory = nullptr;
    const std::size_t bytes = device.size() * sizeof device[0];
    check(cudaMalloc(&memory, bytes));
    check(cudaMemcpy(memory, device.data(), bytes, cudaMemcpyHostToDevice));
    applyAll<<<(count + 255) / 256, 256>>>(memory, count);
    check(cudaGetLastError());
    check(cudaMemcpy(device.data(), memory, bytes, cudaMemcpyDeviceToHost));
    check(cudaFree(memory));
    for (Case<Real>& c : host) apply(c);
    for (int i = 0; i < count; ++i) {
        const auto& h = host[static_cast<std::size_t>(i)];
        const auto& d = device[static_cast<std::size_t>(i)];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
        const auto same = [](Real p, Real q) { return std::memcmp(&p, &q, sizeof p) == 0; };
        ASSERT_TRUE(same(h.impact.since, d.impact.since));
        ASSERT_EQ(h.impact.axes, d.impact.axes);
        ASSERT_EQ(h.impact.overlapBefore, d.impact.overlapBefore);
        ASSERT_TRUE(same(h.a.position, d.a.position) && same(h.a.velocity, d.a.velocity));
        ASSERT_TRUE(same(h.b.position, d.b.position) && same(h.b.velocity, d.b.velocity));
        ASSERT_TRUE(same(h.againstStatic.position, d.againstStatic.position));
        ASSERT_TRUE(same(h.againstStatic.velocity, d.againstStatic.velocity));
        const auto sameOutcome = [&](const AxisOutcome<Real>& p, const AxisOutcome<Real>& q) {
            return p.collided == q.collided && same(p.impulse, q.impulse) &&
                   same(p.approach, q.approach);
        };
        ASSERT_TRUE(sameOutcome(h.outcome, d.outcome));
        ASSERT_TRUE(sameOutcome(h.outcomeStatic, d.outcomeStatic));
        ASSERT_EQ(h.priority, d.priority);
    }
}

TEST(ContactLawOnDevice, GivesTheBitsOfTheHostInDouble) {
    if (!hasDevice()) GTEST_SKIP() << "no CUDA device";
    compareHostAndDevice<double>(20261122);
}

TEST(ContactLawOnDevice, GivesTheBitsOfTheHostInFloat) {
    if (!hasDevice()) GTEST_SKIP() << "no CUDA device";
    compareHostAndDevice<float>(20261123);
}

}  // namespace
}  // namespace quadrille
