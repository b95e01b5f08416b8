#include <sstream>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/components.hpp>
#include <quadrille/error.hpp>
#include <quadrille/snapshot.hpp>

#include "core/snapshot_stream.hpp"

namespace quadrille {

namespace {

constexpr std::string_view magic = "QUADRILLE SNAPSHOT\n";
constexpr std::uint32_t formatVersion = 2;
constexpr std::uint32_t byteOrderMark = 0x01020304;

void write(SnapshotWriter& out, const Vec2& v) {
    out.number(v.x());
    out.number(v.y());
}
Vec2 readVec2(SnapshotReader& in) {
    const auto x = in.number<double>();
    const auto y = in.number<double>();
    return {x, y};
}

void write(SnapshotWriter& out, const Transform& c) { write(out, c.position); }
void write(SnapshotWriter& out, const BoxCollider& c) { write(out, c.size); }
void write(SnapshotWriter& out, const PhysicsBody& c) {
    write(out, c.velocity);
    out.number(c.mass);
    out.number<std::uint8_t>(c.isStatic);
}
void write(SnapshotWriter& out, const RectangleRenderer& c) {
    for (const std::uint8_t channel : {c.color.r, c.color.g, c.color.b, c.color.a}) {
        out.number(channel);
    }
}
void write(SnapshotWriter& out, const Name& c) { out.text(c.value); }

void read(SnapshotReader& in, Transform& c) { c.position = readVec2(in); }
void read(SnapshotReader& in, BoxCollider& c) { c.size = readVec2(in); }
void read(SnapshotReader& in, PhysicsBody& c) {
    c.velocity = readVec2(in);
    c.mass = in.number<double>();
    c.isStatic = in.number<std::uint8_t>() != 0;
}
void read(SnapshotReader& in, RectangleRenderer& c) {
    for (std::uint8_t* channel : {&c.color.r, &c.color.g, &c.color.b, &c.color.a}) {
        *channel = in.number<std::uint8_t>();
    }
}
void read(SnapshotReader& in, Name& c) { c.value = in.text(); }

template <class Real>
void writeColumn(SnapshotWriter& out, const Column<Real>& column) {
    const ColumnView<Real> view = column.view();
    out.number<std::uint64_t>(column.size());
    out.number<std::uint8_t>(view.uniform());
    if (view.uniform()) {
        out.number(view.common);
    } else {
        out.write(view.values.data(), view.values.size_bytes());
    }
}

template <class Real>
void readColumn(SnapshotReader& in, Column<Real>& column, std::size_t rows) {
    const auto size = in.number<std::uint64_t>();
    const bool uniform = in.number<std::uint8_t>() != 0;
    if (size != rows) in.fail("has columns of different lengths");
    Real value{};
    if (uniform) value = in.number<Real>();
    for (std::size_t i = 0; i < size; ++i) {
        if (!uniform) value = in.number<Real>();
        column.push_back(value);
    }
}

}  // namespace

/// Reads and writes the parts of a World that its interface hides.
class SnapshotAccess {
  public:
    static void write(SnapshotWriter& out, const World& world) {
        quadrille::write(out, world.config_.size);
        out.number(world.config_.seed);
        std::ostringstream random;
        random << world.random_.engine();
        out.text(random.str());
        out.numbers(world.generations_);
        out.numbers(std::vector<std::uint8_t>(world.dead_.begin(), world.dead_.end()));
        out.numbers(world.slots_);
        out.numbers(world.free_);
        std::vector<std::uint32_t> condemned;
        for (const Entity entity : world.condemned_) condemned.push_back(entity.index);
        out.numbers(condemned);
        out.number(static_cast<std::uint8_t>(world.precision()));
        std::visit(
            [&](const auto& columns) {
                const auto& m = columns.moving;
                const auto& f = columns.fixed;
                for (const auto* column : {&m.x, &m.y, &m.vx, &m.vy}) out.numbers(*column);
                out.numbers(m.entity);
                out.number<std::uint8_t>(m.anchors.enabled);
                if (m.anchors.enabled) {
                    out.numbers(m.anchors.rows);
                    writeColumn(out, m.anchors.rests);
                }
                for (const auto* c : {&m.halfWidth, &m.halfHeight, &m.mass}) writeColumn(out, *c);
                for (const auto* c : {&f.x, &f.y, &f.halfWidth, &f.halfHeight}) out.numbers(*c);
                out.numbers(f.entity);
            },
            world.columns_);
        writePools<Transform, BoxCollider, PhysicsBody, RectangleRenderer, Name>(out, world);
    }

    static World read(SnapshotReader& in) {
        WorldConfig config;
        config.size = readVec2(in);
        config.seed = in.number<std::uint64_t>();
        World world(config);
        std::istringstream random(in.text());
        random >> world.random_.engine();
        if (!random) in.fail("has no random generator");
        world.generations_ = in.numbers<std::uint32_t>();
        const auto dead = in.numbers<std::uint8_t>();
        world.dead_.assign(dead.begin(), dead.end());
        world.slots_ = in.numbers<std::uint32_t>();
        world.free_ = in.numbers<std::uint32_t>();
        const auto condemned = in.numbers<std::uint32_t>();
        const std::size_t entities = world.generations_.size();
        if (world.dead_.size() != entities || world.slots_.size() != entities ||
            world.free_.size() + condemned.size() > entities) {
            in.fail("has entity tables of different lengths");
        }
        for (const std::uint32_t index : condemned) {
            if (index >= entities) in.fail("has an entity that does not exist");
            world.condemned_.push_back(world.entityAt(index));
        }
        world.alive_ = entities - world.free_.size() - condemned.size();
        if (in.number<std::uint8_t>() == static_cast<std::uint8_t>(Precision::Float)) {
            world.columns_.emplace<World::Columns<float>>();
        }
        std::visit([&](auto& columns) { readColumns(in, columns); }, world.columns_);
        ++world.revision_;
        readPools<Transform, BoxCollider, PhysicsBody, RectangleRenderer, Name>(in, world);
        return world;
    }

  private:
    template <class Columns>
    static void readColumns(SnapshotReader& in, Columns& columns) {
        using Real = typename decltype(columns.moving.x)::value_type;
        auto& m = columns.moving;
        auto& f = columns.fixed;
        for (auto* column : {&m.x, &m.y, &m.vx, &m.vy}) {
            *column = in.numbers<Real>();
            if (column->size() != m.x.size()) in.fail("has columns of different lengths");
        }
        m.entity = in.numbers<std::uint32_t>();
        m.anchors.enabled = in.number<std::uint8_t>() != 0;
        if (m.anchors.enabled) {
            m.anchors.rows = in.numbers<Anchor<Real>>();
            if (m.anchors.rows.size() != m.x.size()) in.fail("has columns of different lengths");
            readColumn(in, m.anchors.rests, m.x.size());
            // Which rows were waiting for an anchor is not recorded: look at all.
            m.anchors.incomplete = true;
        }
        for (auto* c : {&m.halfWidth, &m.halfHeight, &m.mass}) readColumn(in, *c, m.x.size());
        for (auto* column : {&f.x, &f.y, &f.halfWidth, &f.halfHeight}) {
            *column = in.numbers<Real>();
            if (column->size() != f.x.size()) in.fail("has columns of different lengths");
        }
        f.entity = in.numbers<std::uint32_t>();
        if (m.entity.size() != m.x.size() || f.entity.size() != f.x.size()) {
            in.fail("has columns of different lengths");
        }
    }

    template <class... Cs>
    static void writePools(SnapshotWriter& out, const World& world) {
        const auto one = [&]<class C>() {
            const auto* pool = world.findPool<C>();
            out.number<std::uint64_t>(pool != nullptr ? pool->size() : 0);
            if (pool == nullptr) return;
            for (const Entity entity : pool->entities()) {
                out.number(entity.index);
                out.number(entity.generation);
                quadrille::write(out, (*pool)[entity.index]);
            }
        };
        (one.template operator()<Cs>(), ...);
    }

    template <class... Cs>
    static void readPools(SnapshotReader& in, World& world) {
        const auto one = [&]<class C>() {
            const auto count = in.number<std::uint64_t>();
            for (std::uint64_t i = 0; i < count; ++i) {
                Entity entity;
                entity.index = in.number<std::uint32_t>();
                entity.generation = in.number<std::uint32_t>();
                if (entity.index >= world.generations_.size() ||
                    world.entityAt(entity.index) != entity) {
                    in.fail("has components of an entity that does not exist");
                }
                C component;
                quadrille::read(in, component);
                world.pool<C>().put(entity, std::move(component));
            }
        };
        (one.template operator()<Cs>(), ...);
    }
};

void saveSnapshot(const std::filesystem::path& file, const Simulation& simulation,
                  const std::string& scene, std::uint64_t seed) {
    SnapshotWriter out(file);
    out.write(magic.data(), magic.size());
    out.number(formatVersion);
    out.number(byteOrderMark);
    out.text(scene);
    out.number(seed);
    out.number(simulation.stepsDone());
    out.number(simulation.config().law);
    out.number(simulation.config().dt);
    write(out, simulation.config().gravity);
    out.number(simulation.config().restitution);
    SnapshotAccess::write(out, simulation.world());
    out.commit();
}

Snapshot loadSnapshot(const std::filesystem::path& file) {
    SnapshotReader in(file);
    std::string start(magic.size(), '\0');
    in.read(start.data(), start.size());
    if (start != magic) in.fail("is not a snapshot of Quadrille");
    if (in.number<std::uint32_t>() != formatVersion) in.fail("has another format version");
    if (in.number<std::uint32_t>() != byteOrderMark) in.fail("has another byte order");
    std::string scene = in.text();
    const auto seed = in.number<std::uint64_t>();
    const auto stepsDone = in.number<std::uint64_t>();
    const auto law = in.number<Law>();
    StepSettings step;
    step.dt = in.number<double>();
    step.gravity = readVec2(in);
    step.restitution = in.number<double>();
    World world = SnapshotAccess::read(in);
    if (in.left() != 0) in.fail("has data after its end");
    return {.scene = std::move(scene),
            .seed = seed,
            .stepsDone = stepsDone,
            .law = law,
            .step = step,
            .world = std::move(world)};
}

}  // namespace quadrille
