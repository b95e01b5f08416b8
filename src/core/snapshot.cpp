#include <sstream>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/components.hpp>
#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>

#include "core/snapshot_stream.hpp"
#include "core/step_fault.hpp"
#include "core/step_times.hpp"
#include "core/world_access.hpp"

namespace quadrille {

namespace {

constexpr std::string_view magic = "QUADRILLE SNAPSHOT\n";
constexpr std::uint32_t formatVersion = 4;
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

// ---- columns, by kind

template <class T>
void write(SnapshotWriter& out, const PlainColumn<T>& column) {
    out.numbers(column.stored());
}
template <class T>
void read(SnapshotReader& in, PlainColumn<T>& column, std::size_t) {
    column.store(in.numbers<T>());
}

template <class T>
void write(SnapshotWriter& out, const Column<T>& column) {
    const ColumnView<T> view = column.view();
    out.number<std::uint8_t>(view.uniform());
    if (view.uniform()) {
        out.number(view.common);
    } else {
        out.numbers(std::vector<T>(view.values.begin(), view.values.end()));
    }
}
template <class T>
void read(SnapshotReader& in, Column<T>& column, std::size_t rows) {
    const bool uniform = in.number<std::uint8_t>() != 0;
    const T common = uniform ? in.number<T>() : T{};
    const std::vector<T> values = uniform ? std::vector<T>{} : in.numbers<T>();
    if (!uniform && values.size() != rows) in.fail("has columns of different lengths");
    for (std::size_t i = 0; i < rows; ++i) {
        column.grow();
        column.set(i, uniform ? common : values[i]);
    }
}

template <class T>
void write(SnapshotWriter& out, const OptionalColumn<T>& column) {
    out.number<std::uint8_t>(column.kept());
    if (column.kept()) out.numbers(column.stored());
}
template <class T>
void read(SnapshotReader& in, OptionalColumn<T>& column, std::size_t) {
    if (in.number<std::uint8_t>() != 0) column.store(in.numbers<T>());
}

void write(SnapshotWriter& out, const CreationColumn& column) {
    out.number(column.next());
    out.numbers(column.stored());
}
void read(SnapshotReader& in, CreationColumn& column, std::size_t rows) {
    const auto next = in.number<std::uint32_t>();
    if (next > CreationColumn::mostNumbers) in.fail("has a creation number that is too large");
    column.store(in.numbers<std::uint32_t>(), rows, next);
}

template <class Set>
void writeSet(SnapshotWriter& out, const Set& set) {
    out.number<std::uint64_t>(set.size());
    set.forEachColumn([&](ColumnInfo, const auto& column) { write(out, column); }, set);
}
template <class Set>
void readSet(SnapshotReader& in, Set& set) {
    const auto rows = in.number<std::uint64_t>();
    if (rows > BodyRef::mostRows || rows > in.left()) in.fail("ends too early");
    set.forEachColumn(
        [&](ColumnInfo, auto& column) { read(in, column, static_cast<std::size_t>(rows)); }, set);
    if (set.size() != rows) in.fail("has columns of different lengths");
}

// ---- components

template <class... Cs>
void writePools(SnapshotWriter& out, const World& world) {
    const auto one = [&]<class C>() {
        const auto* pool = WorldAccess::findPool<C>(world);
        out.number<std::uint64_t>(pool != nullptr ? pool->size() : 0);
        if (pool == nullptr) return;
        for (const Entity entity : pool->entities()) {
            out.number(entity.index);
            out.number(entity.generation);
            write(out, (*pool)[entity.index]);
        }
    };
    (one.template operator()<Cs>(), ...);
}

template <class... Cs>
void readPools(SnapshotReader& in, World& world) {
    const auto one = [&]<class C>() {
        const auto count = in.number<std::uint64_t>();
        for (std::uint64_t i = 0; i < count; ++i) {
            Entity entity;
            entity.index = in.number<std::uint32_t>();
            entity.generation = in.number<std::uint32_t>();
            if (entity.index >= WorldAccess::tables(world).generations.size() ||
                world.entityAt(entity.index) != entity) {
                in.fail("has components of an entity that does not exist");
            }
            C component;
            read(in, component);
            WorldAccess::pool<C>(world).put(entity, std::move(component));
        }
    };
    (one.template operator()<Cs>(), ...);
}

// ---- the world

void write(SnapshotWriter& out, const World& world) {
    const auto tables = WorldAccess::tables(world);
    write(out, tables.config.size);
    out.number(tables.config.seed);
    std::ostringstream random;
    random << tables.random.engine();
    out.text(random.str());
    out.numbers(tables.generations);
    out.numbers(std::vector<std::uint8_t>(tables.dead.begin(), tables.dead.end()));
    out.numbers(tables.slots);
    out.numbers(tables.free);
    std::vector<std::uint32_t> condemned;
    for (const Entity entity : tables.condemned) condemned.push_back(entity.index);
    out.numbers(condemned);
    out.number(static_cast<std::uint8_t>(world.precision()));
    const BodyStore& store = WorldAccess::store(world);
    std::visit(
        [&](const auto& columns) {
            writeSet(out, columns.moving);
            writeSet(out, columns.fixed);
        },
        store.columns());
    out.number(static_cast<std::uint8_t>(store.edits()));
    writePools<Transform, BoxCollider, PhysicsBody, RectangleRenderer, Name>(out, world);
}

World readWorld(SnapshotReader& in, const Physics& physics) {
    WorldConfig config;
    config.size = readVec2(in);
    config.seed = in.number<std::uint64_t>();
    if (!config.size.allFinite() || !(config.size.minCoeff() > 0)) {
        in.fail("has a world whose size is not finite and positive");
    }
    World world(config);
    const auto tables = WorldAccess::tables(world);
    std::istringstream random(in.text());
    random >> tables.random.engine();
    if (!random) in.fail("has no random generator");
    tables.generations = in.numbers<std::uint32_t>();
    const auto dead = in.numbers<std::uint8_t>();
    tables.dead.assign(dead.begin(), dead.end());
    tables.slots = in.numbers<BodyRef>();
    tables.free = in.numbers<std::uint32_t>();
    const auto condemned = in.numbers<std::uint32_t>();
    const std::size_t entities = tables.generations.size();
    if (tables.dead.size() != entities || tables.slots.size() != entities ||
        tables.free.size() + condemned.size() > entities) {
        in.fail("has entity tables of different lengths");
    }
    for (const std::uint32_t index : condemned) {
        if (index >= entities) in.fail("has an entity that does not exist");
        tables.condemned.push_back(world.entityAt(index));
    }
    tables.alive = entities - tables.free.size() - condemned.size();
    BodyStore::AnyColumns columns;
    const auto precision = in.number<std::uint8_t>();
    if (precision == static_cast<std::uint8_t>(Precision::Float)) {
        columns.emplace<BodyStore::Columns<float>>();
    } else if (precision != static_cast<std::uint8_t>(Precision::Double)) {
        in.fail("has a precision that is not known");
    }
    std::visit(
        [&](auto& sets) {
            readSet(in, sets.moving);
            readSet(in, sets.fixed);
        },
        columns);
    const auto edits = in.number<std::uint8_t>();
    if (edits > static_cast<std::uint8_t>(Edits::Values)) in.fail("has edits of an unknown kind");
    WorldAccess::store(world).replace(std::move(columns), static_cast<Edits>(edits), physics);
    readPools<Transform, BoxCollider, PhysicsBody, RectangleRenderer, Name>(in, world);
    if (const auto findings = world.validate(); !findings.empty())
        in.fail("is unsound: " + findings[0]);
    return world;
}

StepSettings readStep(SnapshotReader& in) {
    StepSettings step;
    step.dt = in.number<double>();
    step.gravity = readVec2(in);
    step.restitution = in.number<double>();
    return step;
}

Law readLaw(SnapshotReader& in) {
    const auto number = in.number<std::uint8_t>();
    for (const Named<Law>& law : laws()) {
        if (static_cast<std::uint8_t>(law.kind) == number) return law.kind;
    }
    in.fail("has a law that is not known");
}

}  // namespace

void saveSnapshot(const std::filesystem::path& file, const Simulation& simulation,
                  const std::string& scene, std::uint64_t seed) {
    // Before a file that can be read is replaced by one that cannot.
    if (const auto findings = simulation.world().validate(); !findings.empty()) {
        throw Error(file.string() + ": not written, the world is unsound: " + findings[0]);
    }
    SnapshotWriter out(file);
    out.write(magic.data(), magic.size());
    out.number(formatVersion);
    out.number(byteOrderMark);
    out.text(scene);
    out.number(seed);
    out.number(simulation.stepsDone());
    out.number(simulation.config().law);
    out.number(simulation.config().step.dt);
    write(out, simulation.config().step.gravity);
    out.number(simulation.config().step.restitution);
    write(out, simulation.world());
    out.commit();
}

/// Refused are a file that is not whole (snapshot_stream.cpp), settings that no run can have
/// (step_fault.hpp), what cannot be read (here), and an unsound world (validate.cpp).
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
    if (stepsDone > StepTimes::mostSteps) in.fail("has a number of steps that is too large");
    const Law law = readLaw(in);
    const StepSettings step = readStep(in);
    // Before the world, which is made for these settings; its precision is known after that.
    if (const char* fault = stepFault(step, Precision::Double)) in.fail(fault);
    World world = readWorld(in, physicsOf(law, step));
    if (const char* fault = stepFault(step, world.precision())) in.fail(fault);
    if (in.left() != 0) in.fail("has data after its end");
    return {.scene = std::move(scene),
            .seed = seed,
            .stepsDone = stepsDone,
            .law = law,
            .step = step,
            .world = std::move(world)};
}

}  // namespace quadrille
