#include "hard_cases/hard_case.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <memory>
#include <sstream>
#include <utility>

namespace quadrille::accuracy {

const Texts& HardCase::expected(Law law) const {
    return law == Law::Baseline ? baseline : law == Law::Impulse ? impulse : continuous;
}

const std::vector<HardCase>& hardCases() {
    static const std::vector<HardCase> all = [] {
        std::vector<HardCase> cases;
        for (const auto theme : {chainCases, cornerCases, extremeCases, overlapCases, gravityCases,
                                 borderCases, crowdCases, inputCases, billiardCases}) {
            std::vector<HardCase> more = theme();
            std::move(more.begin(), more.end(), std::back_inserter(cases));
        }
        return cases;
    }();
    return all;
}

PartitionerConfig partitionerFor(Law law) {
    if (law == Law::Baseline) return BruteForce{};
    return SemiStaticQuadtree{};
}

Simulation simulate(const Setup& setup, const std::vector<Body>& bodies,
                    const Conditions& conditions) {
    World world({.size = conditions.world});
    for (const Body& b : bodies) {
        world.add(world.create(), Transform{b.position}, BoxCollider{b.size},
                  PhysicsBody{b.velocity, b.mass, b.isStatic});
    }
    return Simulation(std::move(world), {.partitioner = partitionerFor(setup.law),
                                         .law = setup.law,
                                         .precision = setup.precision,
                                         .step = conditions.step});
}

Vec2 position(const Simulation& sim, std::size_t i) {
    return sim.world().get<Transform>(sim.world().at(static_cast<std::uint32_t>(i))).position;
}

Vec2 velocity(const Simulation& sim, std::size_t i) {
    return sim.world().get<PhysicsBody>(sim.world().at(static_cast<std::uint32_t>(i))).velocity;
}

ContactLog::ContactLog(Simulation& sim) : collisions_(std::make_shared<std::vector<Contact>>()) {
    sim.onContact([log = collisions_](const Contact& c) {
        if (c.collided) log->push_back(c);
    });
}

Outcome exactIf(bool holds, std::string instead, std::string detail) {
    return {holds ? "exact" : std::move(instead), std::move(detail)};
}

std::string number(double value, int digits) {
    std::ostringstream out;
    const double size = std::abs(value);
    if (size >= 1e-3 && size < 1e6) {
        const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
        out << std::fixed << std::setprecision(std::max(digits - before, 0)) << value;
    } else {
        out << std::setprecision(digits) << value;
    }
    return out.str();
}

std::string percent(double ratio) { return (ratio > 0 ? "+" : "") + number(100 * ratio, 2) + " %"; }

std::string belowPower(double value) {
    int exponent = -300;
    while (std::pow(10.0, exponent) < std::abs(value)) ++exponent;
    return "1e" + std::to_string(exponent);
}

std::string listing(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) {
        std::ostringstream out;
        out << std::setprecision(17) << value;
        text += (text.empty() ? "" : " ") + out.str();
    }
    return text;
}

}  // namespace quadrille::accuracy
