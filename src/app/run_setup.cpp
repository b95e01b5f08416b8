#include "app/run_setup.hpp"

#include <iostream>
#include <utility>

#include "app/scene_catalog.hpp"

namespace quadrille::app {

namespace {

/// Where a run starts, be it a scene or a snapshot.
struct Start {
    std::string scene;
    std::uint64_t seed;
    World world;
    StepSettings step;
    Law law = Law::Impulse;
    std::uint64_t stepsDone = 0;
};

Start loadStart(const Options& options) {
    if (!options.load.empty()) {
        Snapshot snapshot = loadSnapshot(options.load);
        return {.scene = std::move(snapshot.scene),
                .seed = snapshot.seed,
                .world = std::move(snapshot.world),
                .step = snapshot.step,
                .law = snapshot.law,
                .stepsDone = snapshot.stepsDone};
    }
    Scene scene =
        loadScene(findScene(options.scene), {.entities = options.entities, .seed = options.seed});
    return {.scene = std::move(scene.name),
            .seed = scene.seed,
            .world = std::move(scene.world),
            .step = scene.step};
}

/// Moving bodies from which a device is faster than one core under the law `impulse`, measured on
/// an H200 beside a Xeon (docs/cuda.md). A tree with a skin leaves little to do in most steps.
std::size_t cudaBreakEven(const PartitionerConfig& partitioner) {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&partitioner);
    const bool skin =
        tree != nullptr && std::holds_alternative<SemiStaticQuadtree::Skin>(tree->rebuild);
    return skin ? 20'000 : 5'000;
}

ResolverKind chooseResolver(const Options& options, Law law, std::size_t movingCount) {
    if (options.resolver == "auto") {
        // The device is looked for last: that takes longer than many a small run.
        const bool pays = law == Law::Impulse && movingCount >= cudaBreakEven(options.partitioner);
        return pays && findCudaDevice().usable() ? ResolverKind::Cuda : ResolverKind::Sequential;
    }
    if (options.resolver == "sequential") return ResolverKind::Sequential;
    if (options.resolver == "cuda" && law != Law::Continuous) return ResolverKind::Cuda;
    const std::string reason = "the resolver '" + options.resolver +
                               (options.resolver == "cuda" ? "' does not know the law 'continuous'"
                                                           : "' is not available yet");
    if (!options.fallback) {
        if (options.resolver != "cuda-resident") throw NotAvailable(reason);
        throw NoDevice(reason);
    }
    std::cerr << "collisionStress: warning: " << reason << "; running 'sequential'\n";
    return ResolverKind::Sequential;
}

/// The report's policy misses pairs; how many is part of its result.
bool missesPairs(const PartitionerConfig& partitioner) {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&partitioner);
    return tree != nullptr &&
           std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
}

}  // namespace

void warnOfFallback(const Simulation& simulation) {
    std::cerr << "collisionStress: warning: the resolver 'cuda' cannot run ("
              << simulation.resolverFailure() << "); running 'sequential'\n";
}

Run setUp(const Options& options) {
    Start start = loadStart(options);
    SimulationConfig config;
    config.partitioner = options.partitioner;
    config.law = options.law.value_or(start.law);
    config.precision = options.precision.value_or(start.world.precision());
    config.resolver = chooseResolver(options, config.law, start.world.movingCount());
    config.dt = options.dt.value_or(start.step.dt);
    config.gravity = start.step.gravity;
    config.restitution = options.restitution.value_or(start.step.restitution);
    config.profile = options.profile;
    config.countMissedPairs = missesPairs(options.partitioner);
    config.cuda = options.cuda;
    config.fallback = options.fallback;
    Run run{.scene = std::move(start.scene),
            .seed = start.seed,
            .requestedResolver = options.resolver,
            .simulation = Simulation(std::move(start.world), config)};
    run.simulation.resumeAt(start.stepsDone);
    if (!run.simulation.resolverFailure().empty()) warnOfFallback(run.simulation);
    return run;
}

}  // namespace quadrille::app
