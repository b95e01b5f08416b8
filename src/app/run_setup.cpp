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
    Scene scene = loadScene(
        findScene(options.scene),
        {.entities = options.entities, .seed = options.seed, .renderers = !options.headless});
    return {.scene = std::move(scene.name),
            .seed = scene.seed,
            .world = std::move(scene.world),
            .step = scene.step};
}

/// From how many moving bodies on a device is faster than any number of threads, as measured on an
/// H100 beside 16 cores (docs/performance.md).
constexpr std::size_t cudaPaysFrom = 10'000;

/// From how many moving bodies on so many threads are worth it, measured there and on 2 cores.
std::size_t threadsPayFrom(int threads) { return threads >= 4 ? 5'000 : 10'000; }

ResolverKind chooseAutomatically(const SimulationConfig& config, std::size_t movingCount) {
    if (config.law == Law::Baseline) return ResolverKind::Sequential;
    // The device is looked for last: that takes longer than many a small run.
    if (config.law == Law::Impulse && movingCount >= cudaPaysFrom && findCudaDevice().usable()) {
        return ResolverKind::Cuda;
    }
    const int threads = config.threads > 0 ? config.threads : Simulation::cores();
    return threads > 1 && movingCount >= threadsPayFrom(threads) ? ResolverKind::Threads
                                                                 : ResolverKind::Sequential;
}

ResolverKind chooseResolver(const Options& options, const SimulationConfig& config,
                            std::size_t movingCount) {
    if (options.resolver == "auto") return chooseAutomatically(config, movingCount);
    if (options.resolver == "sequential") return ResolverKind::Sequential;
    if (options.resolver == "threads" && config.law != Law::Baseline) return ResolverKind::Threads;
    if (options.resolver == "cuda" && config.law != Law::Continuous) return ResolverKind::Cuda;
    const std::string reason = options.resolver == "cuda-resident"
                                   ? "the resolver 'cuda-resident' is not available yet"
                                   : "the law '" + std::string(name(config.law)) +
                                         "' does not run on the resolver '" + options.resolver +
                                         "'";
    if (!options.fallback) {
        if (options.resolver != "cuda-resident") throw NotAvailable(reason);
        throw NoDevice(reason);
    }
    std::cerr << "collisionStress: warning: " << reason << "; running 'sequential'\n";
    return ResolverKind::Sequential;
}

/// With --error, all pairs of scenes up to this size are compared in every frame, and in one of ten
/// where there are more bodies.
constexpr std::size_t mostAuditedInEveryFrame = 20'000;

}  // namespace

void warnOfFallback(const Simulation& simulation) {
    std::cerr << "collisionStress: warning: the resolver 'cuda' cannot run ("
              << simulation.resolverFailure() << "); running 'sequential'\n";
}

bool mayMissPairs(const PartitionerConfig& partitioner) {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&partitioner);
    return tree != nullptr &&
           std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
}

Run setUp(const Options& options) {
    Start start = loadStart(options);
    SimulationConfig config;
    config.partitioner = options.partitioner;
    config.law = options.law.value_or(start.law);
    config.precision = options.precision.value_or(start.world.precision());
    config.threads = options.threads.value_or(0);
    config.resolver = chooseResolver(options, config, start.world.movingCount());
    config.dt = options.dt.value_or(start.step.dt);
    config.gravity = start.step.gravity;
    config.restitution = options.restitution.value_or(start.step.restitution);
    config.profile = options.profile;
    config.countMissedPairs = options.error || mayMissPairs(options.partitioner);
    if (options.error && start.world.movingCount() > mostAuditedInEveryFrame) {
        config.missedPairsEvery = 10;
    }
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
