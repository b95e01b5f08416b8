#include <algorithm>
#include <chipmunk/chipmunk.h>
#include <cmath>
#include <limits>

#include "bench/peer.hpp"

namespace quadrille::bench {

namespace {

enum class Index { Tree, Hash };

template <auto Free>
struct Deleter {
    template <class T>
    void operator()(T* object) const {
        Free(object);
    }
};

cpVect toChipmunk(const Vec2& v) { return cpv(v.x(), v.y()); }

class ChipmunkPeer final : public Peer {
  public:
    ChipmunkPeer(const Scene& scene, Index index) : space_(cpSpaceNew()), dt_(scene.step.dt) {
        cpSpaceSetGravity(space_.get(), toChipmunk(scene.step.gravity));
        // The default lets bodies overlap by 0.1 px.
        cpSpaceSetCollisionSlop(space_.get(), 0);
        moving_.reserve(scene.world.movingCount());
        shapes_.reserve(scene.world.movingCount() + scene.world.staticCount());
        // A pair has the product of the two elasticities.
        const double elasticity = std::sqrt(scene.step.restitution);
        double extents = 0;
        eachBody(scene.world,
                 [&](const Transform& transform, const BoxCollider& box, const PhysicsBody& body) {
                     add(transform, box, body, elasticity);
                     if (!body.isStatic) extents += box.size.maxCoeff();
                 });
        if (index == Index::Hash) useHash(extents / double(moving_.size()));
    }

    void step() override { cpSpaceStep(space_.get(), dt_); }

    void read(const MutableBodyView<double>::Moving& rows) const override {
        for (std::size_t i = 0; i < moving_.size(); ++i) {
            const cpVect position = cpBodyGetPosition(moving_[i].get());
            const cpVect velocity = cpBodyGetVelocity(moving_[i].get());
            rows.x[i] = position.x;
            rows.y[i] = position.y;
            rows.vx[i] = velocity.x;
            rows.vy[i] = velocity.y;
        }
    }

  private:
    void add(const Transform& transform, const BoxCollider& box, const PhysicsBody& body,
             double elasticity) {
        const Vec2& centre = transform.position;
        cpShape* shape = nullptr;
        if (body.isStatic) {
            const cpBB bounds =
                cpBBNewForExtents(toChipmunk(centre), box.size.x() / 2, box.size.y() / 2);
            shape = cpBoxShapeNew2(cpSpaceGetStaticBody(space_.get()), bounds, 0);
        } else {
            // An infinite moment of inertia keeps the body from turning.
            constexpr double moment = std::numeric_limits<double>::infinity();
            moving_.emplace_back(cpBodyNew(body.mass, moment));
            cpBody* const made = cpSpaceAddBody(space_.get(), moving_.back().get());
            cpBodySetPosition(made, toChipmunk(centre));
            cpBodySetVelocity(made, toChipmunk(body.velocity));
            shape = cpBoxShapeNew(made, box.size.x(), box.size.y(), 0);
        }
        shapes_.emplace_back(shape);
        cpShapeSetElasticity(shape, elasticity);
        cpShapeSetFriction(shape, 0);
        cpSpaceAddShape(space_.get(), shape);
    }

    /// Chipmunk's manual: cells a little larger than a body, ten times as many as bodies.
    void useHash(double meanExtent) {
        constexpr double largest = std::numeric_limits<int>::max();
        const double cells = std::min(10.0 * double(moving_.size()), largest);
        cpSpaceUseSpatialHash(space_.get(), 1.5 * meanExtent, static_cast<int>(cells));
    }

    // The space goes first, the bodies last: each refers to those declared before it.
    std::vector<std::unique_ptr<cpBody, Deleter<cpBodyFree>>> moving_;
    std::vector<std::unique_ptr<cpShape, Deleter<cpShapeFree>>> shapes_;
    std::unique_ptr<cpSpace, Deleter<cpSpaceFree>> space_;
    double dt_;
};

PeerKind kind(const std::string& index, Index value) {
    return {
        .name = std::string("Chipmunk ") + cpVersionString + " " + index,
        .settings = "double; infinite moment; 10 iterations; slop 0; damping 1",
        .make = [=](const Scene& scene) { return std::make_unique<ChipmunkPeer>(scene, value); }};
}

}  // namespace

std::vector<PeerKind> chipmunkPeers() {
    return {kind("tree", Index::Tree), kind("hash", Index::Hash)};
}

}  // namespace quadrille::bench
