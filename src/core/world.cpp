#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <quadrille/world.hpp>

#include "core/body_store.hpp"
#include "core/fits.hpp"

namespace quadrille {

namespace {

std::string describe(Entity entity) { return "entity " + std::to_string(entity.index); }

void requireFinite(Entity entity, const char* what, const Vec2& value) {
    if (!value.allFinite()) throw Error(describe(entity) + ": " + what + " is not finite");
}

void requireFits(Entity entity, const char* what, double value, Precision precision,
                 bool positive = false) {
    const bool good = precision == Precision::Double ? fits<double>(value, positive)
                                                     : fits<float>(value, positive);
    if (!good) {
        throw Error(describe(entity) + ": " + what + " does not fit the precision of the world");
    }
}

}  // namespace

World::World(const WorldConfig& config)
    : config_(config), random_(config.seed), store_(std::make_unique<BodyStore>()) {
    if (!config.size.allFinite() || !(config.size.minCoeff() > 0)) {
        throw Error("world: size must be finite and positive");
    }
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

BodyStore& World::store() {
    if (!store_) throw Error("world: it was moved from");
    return *store_;
}
const BodyStore& World::store() const { return const_cast<World*>(this)->store(); }

World World::clone() const {
    World copy(config_);
    copy.random_ = random_;
    copy.generations_ = generations_;
    copy.dead_ = dead_;
    copy.slots_ = slots_;
    copy.free_ = free_;
    copy.condemned_ = condemned_;
    copy.alive_ = alive_;
    copy.store().replace(store().columns(), store().edits(), store().physics());
    for (const auto& [key, pool] : pools_) copy.pools_.emplace_back(key, pool->clone());
    return copy;
}

Entity World::create(std::string_view name) {
    Entity entity;
    if (free_.empty()) {
        if (generations_.size() >= BodyRef::mostRows) throw Error("world: too many entities");
        entity = {static_cast<std::uint32_t>(generations_.size()), 0};
        generations_.push_back(0);
        dead_.push_back(false);
        slots_.push_back(BodyRef{});
    } else {
        entity.index = free_.back();
        free_.pop_back();
        entity.generation = generations_[entity.index];
        dead_[entity.index] = false;
    }
    ++alive_;
    if (!name.empty()) pool<Name>().put(entity, Name{std::string(name)});
    return entity;
}

void World::destroy(Entity entity) {
    requireAlive(entity);
    dead_[entity.index] = true;
    condemned_.push_back(entity);
    --alive_;
}

void World::flush() {
    if (condemned_.empty()) return;
    bool bodies = false;
    for (const Entity entity : condemned_) {
        for (auto& [key, pool] : pools_) pool->erase(entity.index);
        bodies = bodies || isBody(entity);
    }
    if (bodies) eraseDeadBodies();
    for (const Entity entity : condemned_) {
        ++generations_[entity.index];
        free_.push_back(entity.index);
    }
    condemned_.clear();
}

Entity World::find(std::string_view name) const {
    if (const auto* names = findPool<Name>()) {
        for (const Entity entity : names->entities()) {
            if (alive(entity) && (*names)[entity.index].value == name) return entity;
        }
    }
    return {};
}

std::string_view World::name(Entity entity) const {
    const auto* names = findPool<Name>();
    return has<Name>(entity) ? std::string_view((*names)[entity.index].value) : std::string_view();
}

Entity World::at(std::uint32_t index) const {
    if (index >= generations_.size() || dead_[index]) return {};
    return {index, generations_[index]};
}

void World::requireAlive(Entity entity) const {
    if (!alive(entity)) throw Error(describe(entity) + " is not alive");
}

void World::throwMissing(Entity entity) const {
    throw Error(describe(entity) + " has no such component");
}

void World::validate(Entity entity, const Transform& transform) const {
    requireFinite(entity, "position", transform.position);
    for (const double value : transform.position) {
        requireFits(entity, "position", value, precision());
    }
}

void World::validate(Entity entity, const BoxCollider& collider) const {
    requireFinite(entity, "size", collider.size);
    if (!(collider.size.minCoeff() > 0)) throw Error(describe(entity) + ": size must be positive");
    for (const double value : collider.size) {
        requireFits(entity, "size", value / 2, precision(), true);
    }
}

void World::validate(Entity entity, const PhysicsBody& body) const {
    requireFinite(entity, "velocity", body.velocity);
    if (!body.isStatic && !(std::isfinite(body.mass) && body.mass > 0)) {
        throw Error(describe(entity) + ": mass must be finite and positive");
    }
    if (body.isStatic && body.velocity != Vec2(0, 0)) {
        throw Error(describe(entity) + ": a static body has no velocity");
    }
    if (body.isStatic) return;
    for (const double value : body.velocity) requireFits(entity, "velocity", value, precision());
    requireFits(entity, "mass", body.mass, precision(), true);
}

// ---- bodies

std::size_t World::movingCount() const { return store().movingCount(); }
std::size_t World::staticCount() const { return store().staticCount(); }
Precision World::precision() const { return store().precision(); }
void World::setPrecision(Precision precision) { store().setPrecision(precision); }

template <class Real>
BodyView<Real> World::bodies() const {
    return store().read<Real>();
}

template <class Real>
MutableBodyView<Real> World::mutableBodies() {
    return store().mutableView<Real>();
}

void World::countEdit() { store().countValueEdit(); }

#define QUADRILLE_INSTANTIATE(Real)                \
    template BodyView<Real> World::bodies() const; \
    template MutableBodyView<Real> World::mutableBodies();
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

void World::reserveBodies(std::size_t moving) {
    store().reserve(moving);
    const std::size_t entities = generations_.size() + moving;
    generations_.reserve(entities);
    slots_.reserve(entities);
    dead_.reserve(entities);
}

std::array<Entity, 4> World::addWalls(WallsConfig walls) {
    const double t = walls.thickness;
    if (!std::isfinite(t) || !(t > 0)) throw Error("walls: thickness must be finite and positive");
    const Vec2 inner = config_.size / 2 - Vec2(walls.inset, walls.inset);
    if (!inner.allFinite() || !(inner.minCoeff() > 0)) {
        throw Error("walls: the inset leaves no room inside the world");
    }
    // The side walls span the corners, so that nothing slips out between two walls.
    const Vec2 side(t, 2 * (inner.y() + t));
    const Vec2 flat(2 * (inner.x() + t), t);
    const std::array<std::pair<Vec2, Vec2>, 4> boxes = {{{{-inner.x() - t / 2, 0}, side},
                                                         {{inner.x() + t / 2, 0}, side},
                                                         {{0, -inner.y() - t / 2}, flat},
                                                         {{0, inner.y() + t / 2}, flat}}};
    for (const auto& [centre, size] : boxes) {
        const double largest = std::max(centre.cwiseAbs().maxCoeff(), size.maxCoeff());
        const bool good = precision() == Precision::Double ? fits<double>(largest, true)
                                                           : fits<float>(largest, true);
        if (!good) throw Error("walls: they do not fit the precision of the world");
    }
    std::array<Entity, 4> entities;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        entities[i] = create();
        add(entities[i], Transform{boxes[i].first}, BoxCollider{boxes[i].second},
            PhysicsBody{.isStatic = true});
    }
    return entities;
}

void World::formBody(Entity entity) {
    auto* transforms = findPool<Transform>();
    auto* colliders = findPool<BoxCollider>();
    auto* bodies = findPool<PhysicsBody>();
    auto in = [&](auto* pool) { return pool != nullptr && pool->contains(entity.index); };
    if (!in(transforms) || !in(colliders) || !in(bodies)) return;
    appendBody(entity, (*transforms)[entity.index], (*colliders)[entity.index],
               (*bodies)[entity.index]);
    transforms->erase(entity.index);
    colliders->erase(entity.index);
    bodies->erase(entity.index);
}

void World::appendBody(Entity entity, const Transform& transform, const BoxCollider& collider,
                       const PhysicsBody& body) {
    slots_[entity.index] = store().append({.position = transform.position,
                                           .halfSize = collider.size / 2,
                                           .velocity = body.velocity,
                                           .mass = body.mass,
                                           .isStatic = body.isStatic,
                                           .entity = entity.index});
}

void World::dissolveBody(Entity entity) {
    Transform transform;
    BoxCollider collider;
    PhysicsBody body;
    readBody(entity, transform);
    readBody(entity, collider);
    readBody(entity, body);
    eraseBody(entity);
    pool<Transform>().put(entity, transform);
    pool<BoxCollider>().put(entity, collider);
    pool<PhysicsBody>().put(entity, body);
}

void World::eraseBody(Entity entity) {
    store().eraseRow(std::exchange(slots_[entity.index], BodyRef{}),
                     [&](std::uint32_t index, BodyRef to) { slots_[index] = to; });
}

void World::eraseDeadBodies() {
    store().erase(
        [&](std::uint32_t index) {
            if (dead_[index]) slots_[index] = BodyRef{};
            return dead_[index];
        },
        [&](std::uint32_t index, BodyRef to) { slots_[index] = to; });
}

void World::readBody(Entity entity, Transform& out) const {
    out.position = store().position(slots_[entity.index]);
}

void World::readBody(Entity entity, BoxCollider& out) const {
    out.size = 2 * store().halfSize(slots_[entity.index]);
}

void World::readBody(Entity entity, PhysicsBody& out) const {
    const BodyRef body = slots_[entity.index];
    out = PhysicsBody{};
    out.isStatic = body.isStatic();
    out.mass = store().mass(body);
    if (!out.isStatic) out.velocity = store().velocity(body.row());
}

void World::writeBody(Entity entity, const Transform& in) {
    store().setPosition(slots_[entity.index], in.position);
}

void World::writeBody(Entity entity, const BoxCollider& in) {
    store().setHalfSize(slots_[entity.index], in.size / 2);
}

void World::writeBody(Entity entity, const PhysicsBody& in) {
    const BodyRef body = slots_[entity.index];
    if (in.isStatic != body.isStatic()) {
        // Static and moving bodies live in different columns: leave the one, join the other.
        dissolveBody(entity);
        pool<PhysicsBody>().put(entity, in);
        formBody(entity);
        return;
    }
    if (in.isStatic) {
        store().setStaticMass(body.row(), in.mass);
    } else {
        store().setVelocityAndMass(body.row(), in.velocity, in.mass);
    }
}

std::size_t World::bytes() const {
    auto size = [](const auto& vector) {
        return vector.capacity() * sizeof(typename std::decay_t<decltype(vector)>::value_type);
    };
    const std::size_t entities =
        size(generations_) + size(slots_) + size(free_) + size(condemned_) + dead_.capacity() / 8;
    return entities + store().bytes();
}

}  // namespace quadrille
