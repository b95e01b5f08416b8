#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/body_ref.hpp>
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

class BodyStore;

/// The components whose values live in the body columns once an entity has all three of them.
template <class C>
concept BodyComponent =
    std::same_as<C, Transform> || std::same_as<C, BoxCollider> || std::same_as<C, PhysicsBody>;

/// Entities and their components. An entity with a Transform, a BoxCollider and a PhysicsBody is a
/// body; bodies lie in columns. Components of any other movable type live in pools.
///
/// Body components are read and written by value (`get`, `set`), others by reference. A const World
/// hands out nothing that can be written.
///
/// The first look at bodies after a step may be what puts them into place, or brings them from a
/// device, also on a const World; so one thread looks first, and then any number may at a time.
class World {
  public:
    explicit World(const WorldConfig& config = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    World(const World&) = delete;  ///< a copy is dear and has a name: `clone`
    World& operator=(const World&) = delete;

    /// A world that goes on from here on its own: entities, components, bodies, random numbers.
    /// Throws Error if a component of the user's own type cannot be copied.
    World clone() const;

    /// What is wrong with the world, one sentence each; empty if it is sound. A world that was made
    /// through this interface is; what was read from a file, or written through `editBodies`, may
    /// not be: values that are not finite, sizes and masses that are not positive, rows and
    /// entities that do not belong together.
    std::vector<std::string> validate() const;

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

    /// The component: a const value for body components, which are written by `set`, else a
    /// reference, which is valid until a component of that type is added or removed. Throws Error
    /// if the entity has none.
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
        eachOf<Cs...>(*this, function);
    }
    template <class... Cs, class Function>
    void each(Function&& function) const {
        eachOf<Cs...>(*this, function);
    }

    // ---- bodies

    /// Four static boxes that reach `inset` into the world, in the order left, right, bottom, top.
    std::array<Entity, 4> addWalls(WallsConfig walls = {});

    bool isBody(Entity entity) const {
        return entity.index < slots_.size() && slots_[entity.index] != BodyRef{} &&
               generations_[entity.index] == entity.generation;
    }
    std::size_t movingCount() const;
    std::size_t staticCount() const;

    Precision precision() const;

    /// Converts all body columns; narrowing rounds to nearest. Throws Error if a value does not
    /// fit.
    void setPrecision(Precision precision);

    /// The bodies' columns, to be read. Throws Error if the world has the other precision.
    template <class Real>
    BodyView<Real> bodies() const;

    /// Calls `function(BodyView<Real>)` with the world's precision.
    template <class Function>
    decltype(auto) visitBodies(Function&& function) const {
        return precision() == Precision::Double ? function(bodies<double>())
                                                : function(bodies<float>());
    }

    /// Calls `function(MutableBodyView<Real>)` with the world's precision: positions and velocities
    /// of many bodies are written at once this way.
    template <class Function>
    decltype(auto) editBodies(Function&& function) {
        const Precision stored = precision();
        struct Counted {
            World& world;
            ~Counted() { world.countEdit(); }
        } const counted{*this};
        return stored == Precision::Double ? function(mutableBodies<double>())
                                           : function(mutableBodies<float>());
    }

    void reserveBodies(std::size_t moving);

    /// Bytes allocated for entities and bodies (pools of other components not counted).
    std::size_t bytes() const;

  private:
    friend class WorldAccess;

    template <class C>
    Pool<C>* findPool() {
        for (const auto& [key, pool] : pools_) {
            if (key == typeid(C)) return static_cast<Pool<C>*>(pool.get());
        }
        return nullptr;
    }
    template <class C>
    const Pool<C>* findPool() const {
        return const_cast<World*>(this)->findPool<C>();
    }
    template <class C>
    Pool<C>& pool() {
        if (auto* found = findPool<C>()) return *found;
        pools_.emplace_back(typeid(C), std::make_unique<Pool<C>>());
        return static_cast<Pool<C>&>(*pools_.back().second);
    }

    template <class... Cs, class Self, class Function>
    static void eachOf(Self& self, Function& function) {
        const PoolBase* driver = nullptr;
        bool pools = true;
        auto consider = [&]<class C>() {
            if constexpr (!BodyComponent<C>) {
                const PoolBase* pool = self.template findPool<C>();
                if (pool == nullptr) {
                    pools = false;
                } else if (driver == nullptr || pool->size() < driver->size()) {
                    driver = pool;
                }
            }
        };
        (consider.template operator()<Cs>(), ...);
        if (!pools) return;
        const std::size_t count = driver != nullptr ? driver->size() : self.generations_.size();
        for (std::size_t i = count; i-- > 0;) {
            if (driver != nullptr && i >= driver->size()) continue;
            const Entity entity =
                driver != nullptr ? driver->entities()[i] : self.at(static_cast<std::uint32_t>(i));
            if ((self.template has<Cs>(entity) && ...)) {
                function(entity, getFrom<Cs>(self, entity)...);
            }
        }
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
        -> std::conditional_t<BodyComponent<C>, const C,
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
    /// Takes out the rows of one entity, or of all that are dead.
    void eraseBody(Entity entity);
    void eraseDeadBodies();

    void readBody(Entity entity, Transform& out) const;
    void readBody(Entity entity, BoxCollider& out) const;
    void readBody(Entity entity, PhysicsBody& out) const;
    void writeBody(Entity entity, const Transform& in);
    void writeBody(Entity entity, const BoxCollider& in);
    void writeBody(Entity entity, const PhysicsBody& in);

    template <class Real>
    MutableBodyView<Real> mutableBodies();
    void countEdit();
    /// Throws Error if the world was moved from.
    BodyStore& store();
    const BodyStore& store() const;

    WorldConfig config_;
    Random random_;

    std::vector<std::uint32_t> generations_;  // by entity index
    std::vector<bool> dead_;                  // destroyed or free
    std::vector<BodyRef> slots_;              // place in the columns, or none
    std::vector<std::uint32_t> free_;
    std::vector<Entity> condemned_;  // destroyed since the last flush
    std::size_t alive_ = 0;

    std::unique_ptr<BodyStore> store_;
    std::vector<std::pair<std::type_index, std::unique_ptr<PoolBase>>> pools_;
};

/// The components of a name, for snapshots and inspection.
struct Name {
    std::string value;
};

}  // namespace quadrille
