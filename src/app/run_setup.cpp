#include "app/run_setup.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <quadrille/names.hpp>

#include "app/memory_need.hpp"
#include "app/scene_catalog.hpp"

namespace quadrille::app {

namespace {

/// Where a run starts, be it a scene or a snapshot.
struct Start {
    std::string file;  ///< for messages
    std::string scene;
    std::uint64_t seed;
    World world;
    StepSettings step;
    std::optional<Law> law;
    std::optional<std::uint64_t> spawned = {};
    std::uint64_t stepsDone = 0;
};

/// What a run and the one that it is compared with have in common.
struct Common {
    bool mayMissPairs = false;  ///< one of them
    bool floatStart = false;    ///< both start where the less precise one can
    bool warn = true;           ///< of what holds for both
};

/// Of runs that neither the command line nor the scene names one for.
Law unnamedLaw(const Common& common) {
    // The default needs every pair; who asks for the report's policy wants to see it miss some.
    return common.mayMissPairs ? Law::Impulse : SimulationConfig{}.law;
}

Start loadStart(const Options& options, const Common& common) {
    if (!options.load.empty()) {
        Snapshot snapshot = loadSnapshot(options.load);
        requireMemory<SnapshotError>(options, options.load, snapshot.world.movingCount(),
                                     snapshot.law, snapshot.world.precision());
        return {.file = options.load,
                .scene = std::move(snapshot.scene),
                .seed = snapshot.seed,
                .world = std::move(snapshot.world),
                .step = snapshot.step,
                .law = snapshot.law,
                .stepsDone = snapshot.stepsDone};
    }
    const std::filesystem::path file = findScene(options.scene);
    Scene scene =
        loadScene(file, {.set = options.set,
                         .entities = options.entities,
                         .seed = options.seed,
                         .renderers = !options.headless,
                         .announce = [&](std::uint64_t movingBodies, std::optional<Law> law) {
                             requireMemory<SceneError>(options, file.string(), movingBodies,
                                                       law.value_or(unnamedLaw(common)));
                         }});
    return {.file = file.string(),
            .scene = std::move(scene.name),
            .seed = scene.seed,
            .world = std::move(scene.world),
            .step = scene.step,
            .law = scene.law,
            .spawned = scene.spawned};
}

/// The law to run, with a warning if it is not the default only because that cannot be run.
Law chooseLaw(const Options& options, const Common& common, const Start& start) {
    if (options.law) return *options.law;
    if (start.law) return *start.law;
    const Law law = unnamedLaw(common);
    if (law != SimulationConfig{}.law && common.warn) {
        std::cerr << "collisionStress: warning: the law '" << name(SimulationConfig{}.law)
                  << "' needs a partition that misses no pair; running '" << name(law) << "'\n";
    }
    return law;
}

std::string lawsOn(ResolverKind resolver) {
    std::string text;
    for (const auto& law : laws()) {
        if (!runsOn(law.kind, resolver)) continue;
        text += (text.empty() ? "--law " : ", --law ") + std::string(law.name);
    }
    return text;
}

/// The resolver that is asked for, or the sequential one where the law does not run on it.
ResolverKind runnable(ResolverKind wanted, Law law, bool fallback) {
    if (runsOn(law, wanted)) return wanted;
    const std::string reason = "the law '" + std::string(name(law)) +
                               "' does not run on the resolver '" + std::string(name(wanted)) + "'";
    if (!fallback) throw NotAvailable(reason + "; there run: " + lawsOn(wanted));
    std::cerr << "collisionStress: warning: " << reason << "; running '"
              << name(ResolverKind::Sequential) << "'\n";
    return ResolverKind::Sequential;
}

/// Single precision may be too narrow for a scene, and that is not known before it is loaded.
void narrow(Start& start, const Options& options, const SimulationConfig& config) {
    const auto dt = static_cast<float>(config.step.dt);
    if (!(std::isfinite(dt) && dt > 0)) {
        if (options.dt) throw UsageError("--dt: does not fit single precision");
        throw SceneError(start.file + ": step.dt: does not fit single precision");
    }
    if (!config.step.gravity.cast<float>().allFinite()) {
        throw SceneError(start.file + ": step.gravity: does not fit single precision");
    }
    try {
        start.world.setPrecision(Precision::Float);
    } catch (const Error& error) {
        throw SceneError(start.file + ": " + error.what());
    }
}

/// Cells may be too many for a world, and its size is not known before it is loaded.
void requireGrid(const Options& options, const World& world) {
    const auto* grid = std::get_if<StaticGrid>(&options.partitioner);
    if (grid == nullptr) return;
    try {
        const Simulation empty(World(world.config()), {.partitioner = *grid});
    } catch (const Error& error) {
        throw UsageError(std::string("--cell-size: ") + error.what());
    }
}

/// With --error, all pairs of scenes up to this size are compared in every frame, and in one of ten
/// where there are more bodies.
constexpr std::size_t mostAuditedInEveryFrame = 20'000;

Run setUpOne(const Options& options, const Common& common) {
    Start start = loadStart(options, common);
    SimulationConfig config;
    config.partitioner = options.partitioner;
    config.law = chooseLaw(options, common, start);
    config.precision = options.precision.value_or(start.world.precision());
    config.threads = options.threads.value_or(0);
    config.resolver = runnable(options.resolver, config.law, options.fallback);
    config.step = start.step;
    if (options.dt) config.step.dt = *options.dt;
    if (options.restitution) config.step.restitution = *options.restitution;
    config.keepContacts = !options.dumpEvents.empty();
    config.profile = options.profile;
    config.countMissedPairs = options.error || mayMissPairs(options.partitioner);
    if (options.error && start.world.movingCount() > mostAuditedInEveryFrame) {
        config.missedPairsEvery = 10;
    }
    requireGrid(options, start.world);
    if (common.floatStart || config.precision == Precision::Float) narrow(start, options, config);
    config.cuda = options.cuda;
    config.fallback = options.fallback;
    Run run{.scene = std::move(start.scene),
            .seed = start.seed,
            .requestedResolver = options.resolver,
            .simulation = Simulation(std::move(start.world), config),
            .lawNamed = start.law.has_value(),
            .spawned = start.spawned,
            .beside = nullptr};
    run.simulation.resumeAt(start.stepsDone);
    if (!run.simulation.resolverFailure().empty()) warnOfFallback(run);
    return run;
}

}  // namespace

void warnOfFallback(const Run& run) {
    std::cerr << "collisionStress: warning: the resolver '" << name(run.requestedResolver)
              << "' cannot run (" << run.simulation.resolverFailure() << "); running '"
              << name(run.simulation.config().resolver) << "'\n";
}

bool mayMissPairs(const PartitionerConfig& partitioner) {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&partitioner);
    return tree != nullptr &&
           std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
}

Run setUp(const Options& options) {
    if (!options.beside) {
        return setUpOne(options, {.mayMissPairs = mayMissPairs(options.partitioner)});
    }
    const Options& other = *options.beside;
    Common common = {
        .mayMissPairs = mayMissPairs(options.partitioner) || mayMissPairs(other.partitioner),
        .floatStart = options.precision != other.precision};
    Run run = setUpOne(options, common);
    common.warn = false;
    run.beside = std::make_unique<Run>(setUpOne(other, common));
    return run;
}

}  // namespace quadrille::app
