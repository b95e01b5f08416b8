#include <algorithm>

#include <quadrille/world.hpp>

#include "bench/broad_phase.hpp"
#include "bench/partitioner_spec.hpp"
#include "collision/broad/partitioner.hpp"
#include "collision/pairs/narrow_phase.hpp"

namespace quadrille::bench {

namespace {

class Own final : public BroadPhase {
  public:
    Own(const PartitionerConfig& config, const Setting& setting, const Boxes& first)
        : world_({.size = setting.worldSize}),
          dt_(setting.dt),
          partitioner_(makePartitioner<double>(config, setting.worldSize)) {
        world_.reserveBodies(first.moving);
        for (std::size_t i = 0; i < first.size(); ++i) {
            world_.add(world_.create(), Transform{{first.x[i], first.y[i]}},
                       BoxCollider{{2 * first.halfWidth[i], 2 * first.halfHeight[i]}},
                       PhysicsBody{.isStatic = i >= first.moving});
        }
    }

    void prepare(const Boxes& boxes) override {
        world_.editBodies([&]<class Real>(const MutableBodyView<Real>& bodies) {
            const auto& m = bodies.moving;
            std::copy_n(boxes.x.begin(), m.size(), m.x.begin());
            std::copy_n(boxes.y.begin(), m.size(), m.y.begin());
            std::ranges::copy(boxes.vx, m.vx.begin());
            std::ranges::copy(boxes.vy, m.vy.begin());
        });
    }

    void find(const Boxes& boxes, Pairs& pairs) override {
        world_.visitBodies([&]<class Real>(const BodyView<Real>& bodies) {
            if constexpr (std::is_same_v<Real, double>) {
                // The bodies moved, as in a run: nobody put them elsewhere.
                BodyView<double> moved = bodies;
                moved.revision = moved.layout = 1;
                partitioner_->update(moved, dt_, 0.0);
                narrow_.find(
                    moved, partitioner_->partition(),
                    [&](MovingPair p) { pairs.emplace_back(p.a, p.b); },
                    [&](StaticPair p) {
                        pairs.emplace_back(p.a, static_cast<std::uint32_t>(boxes.moving) + p.fixed);
                    });
            }
        });
    }

  private:
    World world_;
    double dt_;
    std::unique_ptr<Partitioner<double>> partitioner_;
    NarrowPhase<double> narrow_;
};

}  // namespace

std::vector<BroadPhaseKind> ownBroadPhases() {
    std::vector<BroadPhaseKind> kinds;
    for (const char* spec : {"semi-static-quadtree:10/20/skin", "quadtree:10/20",
                             "static-grid:26x26", "static-grid:8x8"}) {
        kinds.push_back(
            {spec, [config = parsePartitioner(spec)](const Setting& setting, const Boxes& first) {
                 return std::make_unique<Own>(config, setting, first);
             }});
    }
    return kinds;
}

}  // namespace quadrille::bench
