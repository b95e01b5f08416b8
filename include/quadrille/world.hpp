#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/components.hpp>
#include <quadrille/config.hpp>
#include <quadrille/detail/pool.hpp>
#include <quadrille/entity.hpp>
#include <quadrille/error.hpp>
#include <quadrille/random.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

struct WorldConfig {
    Vec2 size{1280, 720};    ///< px, centred on the origin; a hint to partitioners, not a border
    std::uint64_t seed = 1;  ///< of World::random
};

struct WallsConfig {
    double thickness = 100;  ///< px
    double inset = 0;        ///< how far the walls reach into the world, px
};

/// The components whose values live in the body columns once an entity has all three of them.
template <class C>
concept BodyComponent =
    std::same_as<C, Transform> || std::same_as<C, BoxCollider> || std::same_as<C, PhysicsBody>;

/// Entities and their components. An entity with a Transform, a BoxCollider and a PhysicsBody is a
/// body; bodies lie in columns, in order of creation. Components of any other movable type live in
/// pools.
///
/// Body components are read and written by value (`get`, `set`), others by reference.
class World {
  public:
    explicit World(WorldConfig config = {});

    const WorldConfig& config() const { return config_; }
    Random& random() { return random_; }
    const Random& random() const { return random_; }

    // ---- entities

    Entity create(std::string_view name = {});

    /// The entity is dead at once: look-ups refuse it and iterations pass it over. Its storage is
    /// taken back by `flush`, so that nothing moves under an iteration or inside a step.
    /// Throws Error if it is not alive.
    void destroy(Entity entity);

    /// Takes back the storage of destroyed entities. Simulation does it at both ends of a step.
    void flush();

    bool alive(Entity entity) const {
        return entity.index < generations_.size() &&
               generations_[entity.index] == entity.generation && !dead_[entity.index];
    }
    std::size_t entityCount() const { return alive_; }

    /// The first living entity of that name, or a null entity.
    Entity find(std::string_view name) const;
    std::string_view name(Entity entity) const;

    /// The living entity with that index, or a null entity.
    Entity at(std::uint32_t index) const;

    /// The entity with that index, be it alive or destroyed since the last flush.
    Entity entityAt(std::uint32_t index) const { return {index, generations_[index]}; }

    // ---- components

    /// Adds components, or replaces those that are there. Throws Error if the entity is dead or a
    /// value is impossible (not finite; a size or mass that is not positive); then nothing changes.
    template <class... Cs>
    void add(Entity entity, Cs... components) {
        requireAlive(entity);
        (validate(entity, components), ...);
        if constexpr ((std::same_as<Cs, Transform> || ...) &&
                      (std::same_as<Cs, BoxCollider> || ...) &&
                      (std::same_as<Cs, PhysicsBody> || ...)) {
            // The common way to make a body: straight into the columns, past the pools.
            if (!isBody(entity)) {
                const auto all = std::tie(components...);
                (erasePooled<Cs>(entity), ...);
                appendBody(entity, std::get<Transform&>(all), std::get<BoxCollider&>(all),
                           std::get<PhysicsBody&>(all));
                (putUnlessBody(entity, std::move(components)), ...);
                return;
            }
        }
        (put(entity, std::move(components)), ...);
    }

    template <class C>
    void set(Entity entity, C component) {
        add(entity, std::move(component));
    }

    /// Removes the component if the entity has it.
    template <class C>
    void remove(Entity entity) {
        requireAlive(entity);
        if constexpr (BodyComponent<C>) {
            if (isBody(entity)) dissolveBody(entity);
        }
        if (auto* pool = findPool<C>()) pool->erase(entity.index);
    }

    template <class C>
    bool has(Entity entity) const {
        if (!alive(entity)) return false;
        if constexpr (BodyComponent<C>) {
            if (isBody(entity)) return true;
        }
        const auto* pool = findPool<C>();
        return pool != nullptr && pool->contains(entity.index);
    }

    /// The component: by value for body components, else by reference, which is valid until a
    /// component of that type is added or removed. Throws Error if the entity has none.
    template <class C>
    decltype(auto) get(Entity entity) {
        return getFrom<C>(*this, entity);
    }
    template <class C>
    decltype(auto) get(Entity entity) const {
        return getFrom<C>(*this, entity);
    }

    /// Calls `function(entity, component...)` for every living entity that has them all, newest
    /// first. `function` may destroy any entity and may remove components of the one it is given.
    template <class... Cs, class Function>
    void each(Function&& function) {
        const PoolBase* driver = nullptr;
        bool pools = true;
        auto consider = [&]<class C>() {
            if constexpr (!BodyComponent<C>) {
                const PoolBase* pool = findPool<C>();
                if (pool == nullptr) {
                    pools = false;
                } else if (driver == nullptr || pool->size() < driver->size()) {
                    driver = pool;
                }
            }
        };
        (consider.template operator()<Cs>(), ...);
        if (!pools) return;
        const std::size_t count = driver != nullptr ? driver->size() : generations_.size();
        for (std::size_t i = count; i-- > 0;) {
            if (driver != nullptr && i >= driver->size()) continue;
            const Entity entity =
                driver != nullptr ? driver->entities()[i] : at(static_cast<std::uint32_t>(i));
            if ((has<Cs>(entity) && ...)) function(entity, get<Cs>(entity)...);
        }
    }

    // ---- bodies

    /// Four static boxes that reach `inset` into the world, in the order left, right, bottom, top.
    std::array<Entity, 4> addWalls(WallsConfig walls = {});

    bool isBody(Entity entity) const {
        return entity.index < slots_.size() && slots_[entity.index] != Entity::none &&
               generations_[entity.index] == entity.generation;
    }
    std::size_t movingCount() const;
    std::size_t staticCount() const;

    Precision precision() const { return static_cast<Precision>(columns_.index()); }

    /// Converts all body columns; narrowing rounds to nearest. Throws Error if a value does not
    /// fit.
    void setPrecision(Precision precision);

    /// Throws Error if the world has the other precision.
    template <class Real>
    BodyView<Real> bodies();

    /// To be called after writing through a view of the bodies.
    void bodiesEdited() { ++revision_; }

    /// Calls `function(BodyView<Real>)` with the world's precision.
    template <class Function>
    decltype(auto) visitBodies(Function&& function) {
        return precision() == Precision::Double ? function(bodies<double>())
                                                : function(bodies<float>());
    }
    template <class Function>
    decltype(auto) visitBodies(Function&& function) const {
        return const_cast<World*>(this)->visitBodies(std::forward<Function>(function));
    }

    void reserveBodies(std::size_t moving);

    /// Bytes allocated for entities and bodies (pools of other components not counted).
    std::size_t bytes() const;

  private:
    friend class SnapshotAccess;

    template <class Real>
    struct Columns {
        MovingBodies<Real> moving;
        StaticBodies<Real> fixed;
    };

    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    template <class C>
    Pool<C>* findPool() const {
        for (const auto& [key, pool] : pools_) {
            if (key == typeid(C)) return static_cast<Pool<C>*>(pool.get());
        }
        return nullptr;
    }
    template <class C>
    Pool<C>& pool() {
        if (auto* found = findPool<C>()) return *found;
        pools_.emplace_back(typeid(C), std::make_unique<Pool<C>>());
        return static_cast<Pool<C>&>(*pools_.back().second);
    }

    template <class C>
    void validate(Entity, const C&) const {}
    void validate(Entity entity, const Transform& transform) const;
    void validate(Entity entity, const BoxCollider& collider) const;
    void validate(Entity entity, const PhysicsBody& body) const;

    template <class C>
    void put(Entity entity, C component) {
        if constexpr (BodyComponent<C>) {
            if (isBody(entity)) {
                writeBody(entity, component);
                return;
            }
            pool<C>().put(entity, std::move(component));
            formBody(entity);
        } else {
            pool<C>().put(entity, std::move(component));
        }
    }

    template <class C>
    void putUnlessBody(Entity entity, C component) {
        if constexpr (!BodyComponent<C>) put(entity, std::move(component));
    }
    template <class C>
    void erasePooled(Entity entity) {
        if constexpr (BodyComponent<C>) {
            if (auto* pool = findPool<C>()) pool->erase(entity.index);
        }
    }

    template <class C, class Self>
    static auto getFrom(Self& self, Entity entity)
        -> std::conditional_t<BodyComponent<C>, C,
                              std::conditional_t<std::is_const_v<Self>, const C&, C&>> {
        self.requireAlive(entity);
        if constexpr (BodyComponent<C>) {
            if (self.isBody(entity)) {
                C component;
                self.readBody(entity, component);
                return component;
            }
        }
        auto* pool = self.template findPool<C>();
        if (pool == nullptr || !pool->contains(entity.index)) self.throwMissing(entity);
        return (*pool)[entity.index];
    }

    void requireAlive(Entity entity) const;
    [[noreturn]] void throwMissing(Entity entity) const;

    /// Moves the three components from their pools to a row of the columns, if all are there.
    void formBody(Entity entity);
    /// Moves the row's values back to the pools and takes the row out.
    void dissolveBody(Entity entity);
    void appendBody(Entity entity, const Transform&, const BoxCollider&, const PhysicsBody&);
    /// Takes out the rows whose entity satisfies `gone`, keeping the order of the rest.
    void eraseBodies(const std::function<bool(std::uint32_t entity)>& gone);

    void readBody(Entity entity, Transform& out) const;
    void readBody(Entity entity, BoxCollider& out) const;
    void readBody(Entity entity, PhysicsBody& out) const;
    void writeBody(Entity entity, const Transform& in);
    void writeBody(Entity entity, const BoxCollider& in);
    void writeBody(Entity entity, const PhysicsBody& in);

    WorldConfig config_;
    Random random_;

    std::vector<std::uint32_t> generations_;  // by entity index
    std::vector<bool> dead_;                  // destroyed or free
    std::vector<std::uint32_t> slots_;        // row in the columns, with staticBit, or none
    std::vector<std::uint32_t> free_;
    std::vector<Entity> condemned_;  // destroyed since the last flush
    std::size_t alive_ = 0;

    std::variant<Columns<double>, Columns<float>> columns_;
    std::uint64_t revision_ = 0;
    std::vector<std::pair<std::type_index, std::unique_ptr<PoolBase>>> pools_;
};

/// The components of a name, for snapshots and inspection.
struct Name {
    std::string value;
};

}  // namespace quadrille
