#include "app/window/comparison_layer.hpp"

namespace quadrille::app {

namespace {

// The colours of a scene would hide what is red.
constexpr Color rightColor{0x6f, 0x8f, 0xb0}, wrongColor{0xff, 0x50, 0x42};

}  // namespace

void ComparisonLayer::prepare(const Workbench& bench, const Viewport& second, BoxLayer& boxes) {
    const RunBeside& beside = *bench.session().beside();
    const Simulation& simulation = beside.run().simulation;
    boxes_.prepare(simulation.world(), second);
    cells_.prepare(simulation.cells());
    colour(bench.simulation().world(), beside.wrong(), boxes);
    colour(simulation.world(), beside.wrong(), boxes_);
}

void ComparisonLayer::colour(const World& world, std::span<const std::uint8_t> wrong,
                             BoxLayer& boxes) {
    colors_.clear();
    world.visitBodies([&](const auto& bodies) {
        const auto shown = [&](std::uint32_t index) {
            return world.has<RectangleRenderer>(world.entityAt(index));
        };
        const auto& f = bodies.fixed;
        const auto& m = bodies.moving;
        colors_.resize(bodies.size(), Color{0, 0, 0, 0});
        for (std::size_t i = 0; i < f.size(); ++i) {
            const Entity entity = world.entityAt(f.entity[i]);
            if (shown(f.entity[i])) colors_[i] = world.get<RectangleRenderer>(entity).color;
        }
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t i = 0; i < m.size(); ++i) {
            if (!shown(m.entity[i])) continue;
            colors_[f.size() + i] = wrong[ranks[i]] != 0 ? wrongColor : rightColor;
        }
    });
    boxes.setColors(colors_);
}

void ComparisonLayer::draw(const Viewport& second, const Overlays& overlays, double opacity) const {
    cells_.draw(second, overlays);
    boxes_.draw(second, opacity);
}

}  // namespace quadrille::app
