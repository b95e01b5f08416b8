#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/components.hpp>
#include <quadrille/config.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/scene.hpp>

namespace quadrille::bench {

/// A physics engine that runs a scene.
class Peer {
  public:
    virtual ~Peer() = default;

    virtual void step() = 0;

    /// Writes where the bodies are and how fast, into the rows of the world that they came from.
    virtual void read(const MutableBodyView<double>::Moving& rows) const = 0;
};

/// How to make one; a row of the table.
struct PeerKind {
    std::string name;
    std::string settings;
    std::function<std::unique_ptr<Peer>(const Scene&)> make;
};

PeerKind quadrillePeer(const PartitionerConfig& partitioner, Law law, Precision precision);
PeerKind box2dPeer();
/// One with its default tree, one with its spatial hash.
std::vector<PeerKind> chipmunkPeers();

/// Calls `visit(Transform, BoxCollider, PhysicsBody)` for each body: the static ones, then those
/// that move, in order of creation.
template <class Visit>
void eachBody(const World& world, Visit&& visit) {
    world.visitBodies([&](const auto& bodies) {
        const auto& f = bodies.fixed;
        for (std::size_t i = 0; i < f.size(); ++i) {
            visit(Transform{{f.x[i], f.y[i]}},
                  BoxCollider{{2 * f.halfWidth[i], 2 * f.halfHeight[i]}},
                  PhysicsBody{.isStatic = true});
        }
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            visit(Transform{{m.x[i], m.y[i]}},
                  BoxCollider{{2 * m.halfWidth[i], 2 * m.halfHeight[i]}},
                  PhysicsBody{.velocity = {m.vx[i], m.vy[i]}, .mass = m.mass[i]});
        }
    });
}

}  // namespace quadrille::bench
