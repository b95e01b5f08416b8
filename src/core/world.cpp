#include <algorithm>
#include <cmath>
#include <string>

#include <quadrille/world.hpp>

namespace quadrille {

namespace {

std::string describe(Entity entity) { return "entity " + std::to_string(entity.index); }

void requireFinite(Entity entity, const char* what, const Vec2& value) {
    if (!value.allFinite()) throw Error(describe(entity) + ": " + what + " is not finite");
}

template <class Real>
bool fits(double value, bool positive) {
    const auto result = static_cast<Real>(value);
    return std::isfinite(result) && (!positive || result > 0);
}

/// Rounds to Real; a value that overflows or vanishes would silently change the body.
template <class Real>
Real toReal(double value, const char* what, bool positive = false) {
    if (!fits<Real>(value, positive)) {
        throw Error(std::string(what) + " does not fit the precision of the world");
    }
    return static_cast<Real>(value);
}

void requireFits(Entity entity, const char* what, double value, Precision precision,
                 bool positive = false) {
    const bool good = precision == Precision::Double ? fits<double>(value, positive)
                                                     : fits<float>(value, positive);
    if (!good) {
        throw Error(describe(entity) + ": " + what + " does not fit the precision of the world");
    }
}

template <class Real>
Real halfExtent(double size) {
    return toReal<Real>(size / 2, "size", true);
}

}  // namespace

World::World(WorldConfig config) : config_(config), random_(config.seed) {
    if (!config.size.allFinite() || !(config.size.minCoeff() > 0)) {
        throw Error("world: size must be finite and positive");
    }
}

Entity World::create(std::string_view name) {
    Entity entity;
    if (free_.empty()) {
        if (generations_.size() >= staticBit) throw Error("world: too many entities");
        entity = {static_cast<std::uint32_t>(generations_.size()), 0};
        generations_.push_back(0);
        dead_.push_back(false);
        slots_.push_back(Entity::none);
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
    if (bodies) eraseBodies([this](std::uint32_t index) { return dead_[index]; });
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

std::size_t World::movingCount() const {
    return std::visit([](const auto& columns) { return columns.moving.size(); }, columns_);
}

std::size_t World::staticCount() const {
    return std::visit([](const auto& columns) { return columns.fixed.size(); }, columns_);
}

template <class Real>
BodyView<Real> World::bodies() {
    auto* columns = std::get_if<Columns<Real>>(&columns_);
    if (columns == nullptr) throw Error("world: its bodies have the other precision");
    auto& m = columns->moving;
    auto& f = columns->fixed;
    return {.moving = {m.x, m.y, m.vx, m.vy, m.halfWidth.view(), m.halfHeight.view(), m.mass.view(),
                       m.entity, &m.anchors},
            .fixed = {f.x, f.y, f.halfWidth, f.halfHeight, f.entity},
            .revision = revision_};
}

template BodyView<double> World::bodies<double>();
template BodyView<float> World::bodies<float>();

void World::setPrecision(Precision precision) {
    if (precision == this->precision()) return;
    auto convert = [&]<class To>(const auto& from, Columns<To>& to) {
        auto convertRow = [&](const auto& source, std::size_t row,
                              const std::vector<std::uint32_t>& entity, const char* what,
                              bool positive) {
            const auto value = static_cast<double>(source[row]);
            requireFits(entityAt(entity[row]), what, value, precision, positive);
            return static_cast<To>(value);
        };
        auto copy = [&](const auto& source, const auto& entity, std::vector<To>& target,
                        const char* what, bool positive = false) {
            target.reserve(source.size());
            for (std::size_t i = 0; i < source.size(); ++i) {
                target.push_back(convertRow(source, i, entity, what, positive));
            }
        };
        auto copyColumn = [&](const auto& source, const auto& entity, Column<To>& target,
                              const char* what) {
            for (std::size_t i = 0; i < source.size(); ++i) {
                target.push_back(convertRow(source, i, entity, what, true));
            }
        };
        const auto& moving = from.moving.entity;
        const auto& fixed = from.fixed.entity;
        copy(from.moving.x, moving, to.moving.x, "position");
        copy(from.moving.y, moving, to.moving.y, "position");
        copy(from.moving.vx, moving, to.moving.vx, "velocity");
        copy(from.moving.vy, moving, to.moving.vy, "velocity");
        copyColumn(from.moving.halfWidth, moving, to.moving.halfWidth, "size");
        copyColumn(from.moving.halfHeight, moving, to.moving.halfHeight, "size");
        copyColumn(from.moving.mass, moving, to.moving.mass, "mass");
        to.moving.entity = moving;
        copy(from.fixed.x, fixed, to.fixed.x, "position");
        copy(from.fixed.y, fixed, to.fixed.y, "position");
        copy(from.fixed.halfWidth, fixed, to.fixed.halfWidth, "size", true);
        copy(from.fixed.halfHeight, fixed, to.fixed.halfHeight, "size", true);
        to.fixed.entity = fixed;
    };
    if (precision == Precision::Float) {
        Columns<float> converted;
        convert(std::get<Columns<double>>(columns_), converted);
        columns_ = std::move(converted);
    } else {
        Columns<double> converted;
        convert(std::get<Columns<float>>(columns_), converted);
        columns_ = std::move(converted);
    }
    ++revision_;
}

void World::reserveBodies(std::size_t moving) {
    std::visit(
        [&](auto& columns) {
            auto& m = columns.moving;
            const std::size_t total = m.size() + moving;
            m.x.reserve(total);
            m.y.reserve(total);
            m.vx.reserve(total);
            m.vy.reserve(total);
            m.entity.reserve(total);
        },
        columns_);
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
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto x = toReal<Real>(transform.position.x(), "position");
            const auto y = toReal<Real>(transform.position.y(), "position");
            const auto halfWidth = halfExtent<Real>(collider.size.x());
            const auto halfHeight = halfExtent<Real>(collider.size.y());
            if (body.isStatic) {
                auto& f = columns.fixed;
                slots_[entity.index] = static_cast<std::uint32_t>(f.size()) | staticBit;
                f.x.push_back(x);
                f.y.push_back(y);
                f.halfWidth.push_back(halfWidth);
                f.halfHeight.push_back(halfHeight);
                f.entity.push_back(entity.index);
            } else {
                auto& m = columns.moving;
                const auto vx = toReal<Real>(body.velocity.x(), "velocity");
                const auto vy = toReal<Real>(body.velocity.y(), "velocity");
                const auto mass = toReal<Real>(body.mass, "mass", true);
                slots_[entity.index] = static_cast<std::uint32_t>(m.size());
                m.x.push_back(x);
                m.y.push_back(y);
                m.vx.push_back(vx);
                m.vy.push_back(vy);
                m.halfWidth.push_back(halfWidth);
                m.halfHeight.push_back(halfHeight);
                m.mass.push_back(mass);
                m.entity.push_back(entity.index);
                m.anchors.append();
            }
        },
        columns_);
    ++revision_;
}

void World::dissolveBody(Entity entity) {
    Transform transform;
    BoxCollider collider;
    PhysicsBody body;
    readBody(entity, transform);
    readBody(entity, collider);
    readBody(entity, body);
    eraseBodies([&](std::uint32_t index) { return index == entity.index; });
    pool<Transform>().put(entity, transform);
    pool<BoxCollider>().put(entity, collider);
    pool<PhysicsBody>().put(entity, body);
}

void World::eraseBodies(const std::function<bool(std::uint32_t)>& gone) {
    // Keeps the order of the rows, which is the order of creation that dumps and hashes promise.
    auto compact = [&](auto& entity, std::uint32_t bit, auto&& move) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < entity.size(); ++i) {
            if (gone(entity[i])) {
                slots_[entity[i]] = Entity::none;
                continue;
            }
            entity[kept] = entity[i];
            slots_[entity[kept]] = static_cast<std::uint32_t>(kept) | bit;
            move(i, kept++);
        }
        entity.resize(kept);
        return kept;
    };
    std::visit(
        [&](auto& columns) {
            auto& m = columns.moving;
            const auto moving = compact(m.entity, 0, [&](std::size_t from, std::size_t to) {
                for (auto* column : {&m.x, &m.y, &m.vx, &m.vy}) (*column)[to] = (*column)[from];
                for (auto* column : {&m.halfWidth, &m.halfHeight, &m.mass}) column->move(from, to);
                m.anchors.move(from, to);
            });
            for (auto* column : {&m.x, &m.y, &m.vx, &m.vy}) column->resize(moving);
            for (auto* column : {&m.halfWidth, &m.halfHeight, &m.mass}) column->shrink(moving);
            m.anchors.shrink(moving);

            auto& f = columns.fixed;
            const auto fixed = compact(f.entity, staticBit, [&](std::size_t from, std::size_t to) {
                for (auto* column : {&f.x, &f.y, &f.halfWidth, &f.halfHeight}) {
                    (*column)[to] = (*column)[from];
                }
            });
            for (auto* column : {&f.x, &f.y, &f.halfWidth, &f.halfHeight}) column->resize(fixed);
        },
        columns_);
    ++revision_;
}

void World::readBody(Entity entity, Transform& out) const {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    std::visit(
        [&](const auto& columns) {
            if ((slot & staticBit) != 0) {
                out.position = Vec2(columns.fixed.x[row], columns.fixed.y[row]);
            } else {
                out.position = Vec2(columns.moving.x[row], columns.moving.y[row]);
            }
        },
        columns_);
}

void World::readBody(Entity entity, BoxCollider& out) const {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    std::visit(
        [&](const auto& columns) {
            if ((slot & staticBit) != 0) {
                out.size = 2 * Vec2(columns.fixed.halfWidth[row], columns.fixed.halfHeight[row]);
            } else {
                out.size = 2 * Vec2(columns.moving.halfWidth[row], columns.moving.halfHeight[row]);
            }
        },
        columns_);
}

void World::readBody(Entity entity, PhysicsBody& out) const {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    out = PhysicsBody{};
    out.isStatic = (slot & staticBit) != 0;
    if (out.isStatic) return;
    std::visit(
        [&](const auto& columns) {
            out.velocity = Vec2(columns.moving.vx[row], columns.moving.vy[row]);
            out.mass = static_cast<double>(columns.moving.mass[row]);
        },
        columns_);
}

void World::writeBody(Entity entity, const Transform& in) {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto x = toReal<Real>(in.position.x(), "position");
            const auto y = toReal<Real>(in.position.y(), "position");
            const bool fixed = (slot & staticBit) != 0;
            (fixed ? columns.fixed.x : columns.moving.x)[row] = x;
            (fixed ? columns.fixed.y : columns.moving.y)[row] = y;
            if (!fixed) columns.moving.anchors.forget(row);
        },
        columns_);
    ++revision_;
}

void World::writeBody(Entity entity, const BoxCollider& in) {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto halfWidth = halfExtent<Real>(in.size.x());
            const auto halfHeight = halfExtent<Real>(in.size.y());
            if ((slot & staticBit) != 0) {
                columns.fixed.halfWidth[row] = halfWidth;
                columns.fixed.halfHeight[row] = halfHeight;
            } else {
                columns.moving.halfWidth.set(row, halfWidth);
                columns.moving.halfHeight.set(row, halfHeight);
            }
        },
        columns_);
    ++revision_;
}

void World::writeBody(Entity entity, const PhysicsBody& in) {
    const std::uint32_t slot = slots_[entity.index];
    const std::uint32_t row = slot & ~staticBit;
    if (in.isStatic != ((slot & staticBit) != 0)) {
        // Static and moving bodies live in different columns: leave the one, join the other.
        dissolveBody(entity);
        pool<PhysicsBody>().put(entity, in);
        formBody(entity);
        return;
    }
    if (in.isStatic) return;
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto vx = toReal<Real>(in.velocity.x(), "velocity");
            const auto vy = toReal<Real>(in.velocity.y(), "velocity");
            const auto mass = toReal<Real>(in.mass, "mass", true);
            columns.moving.vx[row] = vx;
            columns.moving.vy[row] = vy;
            columns.moving.mass.set(row, mass);
            columns.moving.anchors.forget(row);
        },
        columns_);
    ++revision_;
}

std::size_t World::bytes() const {
    auto size = [](const auto& vector) {
        return vector.capacity() * sizeof(typename std::decay_t<decltype(vector)>::value_type);
    };
    const std::size_t entities =
        size(generations_) + size(slots_) + size(free_) + size(condemned_) + dead_.capacity() / 8;
    return entities + std::visit(
                          [&](const auto& columns) {
                              const auto& m = columns.moving;
                              const auto& f = columns.fixed;
                              return size(m.x) + size(m.y) + size(m.vx) + size(m.vy) +
                                     size(m.entity) + m.halfWidth.bytes() + m.halfHeight.bytes() +
                                     m.mass.bytes() + m.anchors.bytes() + size(f.x) + size(f.y) +
                                     size(f.halfWidth) + size(f.halfHeight) + size(f.entity);
                          },
                          columns_);
}

}  // namespace quadrille
