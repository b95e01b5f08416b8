#include <box2d/box2d.h>

#include "bench/peer.hpp"

namespace quadrille::bench {

namespace {

/// What the manual of Box2D 2.4 recommends.
constexpr int velocityIterations = 8;
constexpr int positionIterations = 3;

b2Vec2 toBox2d(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

class Box2dPeer final : public Peer {
  public:
    explicit Box2dPeer(const Scene& scene)
        : world_(toBox2d(scene.step.gravity)), dt_(static_cast<float>(scene.step.dt)) {
        world_.SetAllowSleeping(false);
        moving_.reserve(scene.world.movingCount());
        eachBody(scene.world,
                 [&](const Transform& transform, const BoxCollider& box, const PhysicsBody& body) {
                     add(transform, box, body, static_cast<float>(scene.step.restitution));
                 });
    }

    void step() override { world_.Step(dt_, velocityIterations, positionIterations); }

    void read(const MutableBodyView<double>::Moving& rows) const override {
        for (std::size_t i = 0; i < moving_.size(); ++i) {
            const b2Vec2 position = moving_[i]->GetPosition();
            const b2Vec2 velocity = moving_[i]->GetLinearVelocity();
            rows.x[i] = position.x;
            rows.y[i] = position.y;
            rows.vx[i] = velocity.x;
            rows.vy[i] = velocity.y;
        }
    }

  private:
    void add(const Transform& transform, const BoxCollider& box, const PhysicsBody& body,
             float restitution) {
        b2BodyDef definition;
        definition.type = body.isStatic ? b2_staticBody : b2_dynamicBody;
        definition.position = toBox2d(transform.position);
        definition.linearVelocity = toBox2d(body.velocity);
        definition.fixedRotation = true;
        b2Body* const made = world_.CreateBody(&definition);

        b2PolygonShape shape;
        shape.SetAsBox(static_cast<float>(box.size.x() / 2), static_cast<float>(box.size.y() / 2));
        b2FixtureDef fixture;
        fixture.shape = &shape;
        fixture.density = static_cast<float>(body.mass / (box.size.x() * box.size.y()));
        fixture.friction = 0;
        fixture.restitution = restitution;
        // The default, 1 px/s, would make slow collisions inelastic.
        fixture.restitutionThreshold = 0;
        made->CreateFixture(&fixture);
        if (!body.isStatic) moving_.push_back(made);
    }

    b2World world_;
    float dt_;
    std::vector<b2Body*> moving_;  // owned by the world
};

}  // namespace

PeerKind box2dPeer() {
    // Its revision is of no use: 2.4.1 calls itself 2.4.0.
    return {.name = "Box2D " + std::to_string(b2_version.major) + '.' +
                    std::to_string(b2_version.minor),
            .settings = "float; fixed rotation; 8 velocity + 3 position iterations; no sleep",
            .make = [](const Scene& scene) { return std::make_unique<Box2dPeer>(scene); }};
}

}  // namespace quadrille::bench
