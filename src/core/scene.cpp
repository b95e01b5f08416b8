#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/scene.hpp>

#include "core/instances.hpp"
#include "core/scene_settings.hpp"
#include "core/scene_table.hpp"
#include "core/scene_text.hpp"
#include "core/spawn.hpp"

namespace quadrille {

namespace {

/// A body that the scene spells out.
struct PlacedBody {
    Transform transform;
    BoxCollider collider;
    PhysicsBody body;
    Color color{};
    std::string name;
};

/// A spawn group, and what begins an error about it.
struct PlacedGroup {
    SpawnGroup group;
    std::string place;
};

/// The rows of an instance file.
struct InstanceGroup {
    std::vector<Instance> rows;
    Color color{};
};

/// What a scene file says, before the world is made.
struct SceneDescription {
    std::string name;
    std::uint64_t seed = 1;
    std::optional<Vec2> size;
    std::optional<double> areaPerBody;
    double aspect = 1.5;
    std::string worldPlace;  ///< what begins an error about its size
    std::optional<WallsConfig> walls;
    std::string wallsPlace;
    StepSettings step;
    std::optional<Law> law;
    std::vector<PlacedGroup> spawns;
    std::vector<PlacedBody> bodies;
    std::vector<InstanceGroup> instances;
};

using Announce = std::function<void(std::uint64_t, std::optional<Law>)>;

/// What is refused only when it is made is refused where the file asks for it.
template <class Make>
auto at(const std::string& place, Make&& make) {
    try {
        return make();
    } catch (const Error& error) {
        throw SceneError(place + ": " + error.what());
    }
}

Color colorOf(SceneTable& table) { return table.color("color").value_or(Color{}); }

void readWorld(SceneTable table, SceneDescription& scene) {
    scene.size = table.positiveVector("size");
    scene.areaPerBody = table.positive("area_per_body");
    const auto aspect = table.positive("aspect");
    if (scene.size.has_value() == scene.areaPerBody.has_value()) {
        table.fail(scene.size ? "area_per_body" : "size",
                   "a world has either size or area_per_body");
    }
    if (aspect && scene.size) table.fail("aspect", "goes with area_per_body only");
    scene.aspect = aspect.value_or(scene.aspect);
    scene.worldPlace = table.place(scene.size ? "size" : "area_per_body");
    if (auto walls = table.table("walls")) {
        WallsConfig config;
        config.thickness = walls->positive("thickness").value_or(config.thickness);
        config.inset = walls->number("inset").value_or(config.inset);
        if (config.inset < 0) walls->fail("inset", "must not be negative");
        if (scene.size && 2 * config.inset >= scene.size->minCoeff()) {
            walls->fail("inset", "leaves no room inside the world");
        }
        scene.wallsPlace = walls->place();
        walls->finish();
        scene.walls = config;
    }
    table.finish();
}

void readStep(SceneTable table, SceneDescription& scene) {
    StepSettings& step = scene.step;
    step.dt = table.positive("dt").value_or(step.dt);
    step.gravity = table.vector("gravity").value_or(step.gravity);
    step.restitution = table.number("restitution").value_or(step.restitution);
    if (step.restitution < 0 || step.restitution > 1) {
        table.fail("restitution", "must be from 0 to 1");
    }
    if (const auto law = table.string("law")) {
        scene.law = find(laws(), *law);
        if (!scene.law)
            table.fail("law", "must be " + alternatives(laws()) +
                                  didYouMean(nearestNames(*law, namesOf(laws()))));
    }
    table.finish();
}

void readSpawn(SceneTable table, SceneDescription& scene) {
    SpawnGroup group;
    const auto pattern = table.require("pattern", table.string("pattern"));
    if (pattern != "lattice" && pattern != "uniform") {
        const std::array<std::string, 2> patterns = {"lattice", "uniform"};
        table.fail("pattern", "must be \"lattice\" or \"uniform\"" +
                                  didYouMean(nearestNames(pattern, patterns)));
    }
    group.pattern =
        pattern == "lattice" ? SpawnGroup::Pattern::Lattice : SpawnGroup::Pattern::Uniform;
    group.count = static_cast<std::uint64_t>(
        table.require("count", table.integer("count", 0, std::int64_t(mostBodies))));
    group.region = table.region("region");

    const auto size = table.positiveVector("size");
    group.sides = table.range("side");
    if (size.has_value() == group.sides.has_value()) {
        table.fail(size ? "side" : "size", "a group has either size or side");
    }
    if (group.sides && !(group.sides->x() > 0)) table.fail("side", "must be positive");
    if (group.sides && !(group.sides->x() / 2 > 0)) table.fail("side", "is too small");
    group.size = size.value_or(group.size);

    const auto mass = table.positive("mass");
    group.density = table.positive("density");
    if (mass && group.density) table.fail("density", "a group has either mass or density");
    group.mass = mass.value_or(1);

    group.speed = table.range("speed").value_or(Vec2(0, 0));
    for (const double bound : {group.speed.x(), group.speed.y()}) {
        if (bound < 0 || bound > 1e15 || bound != std::floor(bound)) {
            table.fail("speed", "must be two integers that are not negative");
        }
    }
    const auto jitter = table.number("jitter");
    if (jitter && pattern != "lattice") table.fail("jitter", "goes with the lattice only");
    if (jitter && *jitter < 0) table.fail("jitter", "must not be negative");
    if (jitter && !std::isfinite(2 * *jitter)) table.fail("jitter", "is too large");
    group.jitter = jitter.value_or(0);
    group.color = colorOf(table);
    table.finish();
    scene.spawns.push_back({group, table.place()});
}

void readBody(SceneTable table, SceneDescription& scene) {
    PlacedBody placed;
    placed.transform.position = table.require("position", table.vector("position"));
    placed.collider.size = table.require("size", table.positiveVector("size"));
    placed.body.isStatic = table.boolean("static").value_or(false);
    const auto mass = table.positive("mass");
    const auto velocity = table.vector("velocity");
    if (placed.body.isStatic) {
        if (mass) table.fail("mass", "a static body has no mass");
        if (velocity) table.fail("velocity", "a static body has no velocity");
    }
    placed.body.mass = mass.value_or(1);
    placed.body.velocity = velocity.value_or(Vec2(0, 0));
    placed.name = table.string("name").value_or("");
    placed.color = colorOf(table);
    table.finish();
    scene.bodies.push_back(std::move(placed));
}

void readInstance(SceneTable table, const std::filesystem::path& folder, const Announce& announce,
                  SceneDescription& scene) {
    const auto file = table.require("file", table.string("file"));
    Instance defaults;
    defaults.size = table.positiveVector("size").value_or(defaults.size);
    defaults.mass = table.positive("mass").value_or(defaults.mass);
    const Color color = colorOf(table);
    table.finish();
    std::uint64_t before = 0;
    for (const InstanceGroup& group : scene.instances) before += group.rows.size();
    const auto announceRows = [&](std::uint64_t rows) {
        if (announce) announce(before + rows, scene.law);
    };
    scene.instances.push_back(
        {readInstances(folder / file, defaults, table.place("file"), announceRows), color});
}

SceneDescription readDescription(const std::filesystem::path& path, const SceneOptions& options) {
    const std::string file = path.string();
    toml::table document = parseScene(readSceneText(path), file);
    applySettings(options.set, document);
    SceneTable root(document, file, "");
    SceneDescription scene;
    root.require("format", root.integer("format", 1, 1));
    scene.name = root.string("name").value_or(path.stem().string());
    scene.seed = static_cast<std::uint64_t>(
        root.integer("seed", 0, std::numeric_limits<std::int64_t>::max()).value_or(1));
    readWorld(root.require("world", root.table("world")), scene);
    if (auto step = root.table("step")) readStep(*step, scene);
    for (auto& table : root.tables("spawn")) readSpawn(table, scene);
    for (auto& table : root.tables("body")) readBody(table, scene);
    for (auto& table : root.tables("instance")) {
        readInstance(table, path.parent_path(), options.announce, scene);
    }
    root.finish();
    return scene;
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const SceneOptions& options) {
    SceneDescription description = readDescription(file, options);
    const auto fail = [&](const std::string& reason) {
        throw SceneError(file.string() + ": " + reason);
    };
    if (options.entities) {
        if (description.spawns.empty()) fail("has no spawn group whose count could be set");
        if (*options.entities > mostBodies) {
            fail("a spawn group has at most " + std::to_string(mostBodies) + " bodies");
        }
        description.spawns.front().group.count = *options.entities;
    }
    std::uint64_t moving = 0;
    for (const PlacedGroup& spawned : description.spawns) moving += spawned.group.count;
    for (const PlacedBody& body : description.bodies) moving += !body.body.isStatic;
    for (const InstanceGroup& group : description.instances) moving += group.rows.size();
    if (options.announce) options.announce(moving, description.law);
    if (moving > BodyRef::mostRows) {
        fail("has " + std::to_string(moving) + " bodies, more than a world can have");
    }

    WorldConfig config;
    config.seed = options.seed.value_or(description.seed);
    if (description.size) {
        config.size = *description.size;
    } else {
        const double area = *description.areaPerBody * double(std::max<std::uint64_t>(moving, 1));
        const double height = std::sqrt(area / description.aspect);
        config.size = Vec2(area / height, height);
    }
    try {
        Scene scene{.name = description.name,
                    .seed = config.seed,
                    .world = at(description.worldPlace, [&] { return World(config); }),
                    .step = description.step,
                    .law = description.law};
        if (!description.spawns.empty()) scene.spawned = description.spawns.front().group.count;
        World& world = scene.world;
        Vec2 room = config.size;
        if (description.walls) {
            const auto walls =
                at(description.wallsPlace, [&] { return world.addWalls(*description.walls); });
            for (const Entity wall : walls) {
                if (options.renderers) world.add(wall, RectangleRenderer{{0x26, 0x30, 0x3b}});
            }
            room -= 2 * Vec2(description.walls->inset, description.walls->inset);
        }
        world.reserveBodies(static_cast<std::size_t>(moving));
        const BodyMaker maker{world, options.renderers};
        for (const PlacedGroup& spawned : description.spawns) {
            at(spawned.place, [&] { spawn(spawned.group, room, maker); });
        }
        for (const PlacedBody& placed : description.bodies) {
            const Entity entity =
                maker.make(placed.transform, placed.collider, placed.body, placed.color);
            if (!placed.name.empty()) world.add(entity, Name{placed.name});
        }
        for (const InstanceGroup& group : description.instances) {
            for (const Instance& row : group.rows) {
                maker.make(Transform{row.position}, BoxCollider{row.size},
                           PhysicsBody{.velocity = row.velocity, .mass = row.mass}, group.color);
            }
        }
        return scene;
    } catch (const SceneError&) {
        throw;
    } catch (const Error& error) {
        throw SceneError(file.string() + ": " + error.what());
    }
}

}  // namespace quadrille
