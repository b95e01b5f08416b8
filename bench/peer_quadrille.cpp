#include <algorithm>
#include <utility>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "bench/partitioner_spec.hpp"
#include "bench/peer.hpp"

namespace quadrille::bench {

namespace {

/// The bodies alone: what the other engines get too.
World copyBodies(const World& world) {
    World copy(world.config());
    copy.reserveBodies(world.movingCount());
    eachBody(world, [&](const Transform& transform, const BoxCollider& box, const PhysicsBody& b) {
        copy.add(copy.create(), transform, box, b);
    });
    return copy;
}

class QuadrillePeer final : public Peer {
  public:
    QuadrillePeer(const Scene& scene, const PartitionerConfig& partitioner, Law law,
                  Precision precision)
        : simulation_(copyBodies(scene.world), {.partitioner = partitioner,
                                                .law = law,
                                                .precision = precision,
                                                .step = scene.step}) {}

    void step() override { simulation_.step(); }

    void read(const MutableBodyView<double>::Moving& rows) const override {
        simulation_.world().visitBodies([&](const auto& bodies) {
            std::ranges::copy(bodies.moving.x, rows.x.begin());
            std::ranges::copy(bodies.moving.y, rows.y.begin());
            std::ranges::copy(bodies.moving.vx, rows.vx.begin());
            std::ranges::copy(bodies.moving.vy, rows.vy.begin());
        });
    }

  private:
    Simulation simulation_;
};

}  // namespace

PeerKind quadrillePeer(const PartitionerConfig& partitioner, Law law, Precision precision) {
    return {.name = "Quadrille " + std::string(name(law)) + " " + std::string(name(precision)),
            .settings = specOf(partitioner),
            .make = [=](const Scene& scene) {
                return std::make_unique<QuadrillePeer>(scene, partitioner, law, precision);
            }};
}

}  // namespace quadrille::bench
