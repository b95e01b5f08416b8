// The cost of a step of `impulse` per body over the number of bodies, for each partitioner, at two
// densities; and what it costs to check, hash, save and load a world.

#include <benchmark/benchmark.h>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>

#include <quadrille/quadrille.hpp>

#include "bench/machine.hpp"

namespace {

using namespace quadrille;

constexpr std::uint64_t warmupSteps = 20;

/// A fixed number, so that each figure stands for the same steps whatever the machine's speed.
std::int64_t stepsFor(std::int64_t bodies) {
    if (bodies >= 1'000'000) return 60;
    return bodies >= 100'000 ? 200 : 1000;
}

void stepScene(benchmark::State& state, const std::string& scene,
               const PartitionerConfig& partitioner, Precision precision) {
    const auto bodies = static_cast<std::uint64_t>(state.range(0));
    SceneOptions options;
    options.entities = bodies;
    Scene loaded = loadScene(QUADRILLE_BENCH_SCENES_DIR "/" + scene + ".toml", options);
    Simulation simulation(std::move(loaded.world), {.partitioner = partitioner,
                                                    .law = Law::Impulse,
                                                    .precision = precision,
                                                    .step = loaded.step});
    simulation.run(warmupSteps);

    std::uint64_t contacts = 0, rebuilds = 0;
    const std::clock_t start = std::clock();
    for (auto _ : state) {
        const StepReport& report = simulation.step();
        contacts += report.contacts;
        rebuilds += report.rebuilt;
    }

    // Processor time: what other programs take of a shared machine is not in it.
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;

    const double steps = double(state.iterations());
    state.counters["ns_per_body_step"] = 1e9 * seconds / steps / double(bodies);
    state.counters["contacts_per_body"] = double(contacts) / steps / double(bodies);
    state.counters["rebuilds_per_100"] = 100 * double(rebuilds) / steps;
}

void registerStep(const std::string& scene, const PartitionerConfig& partitioner,
                  Precision precision, std::int64_t bodies) {
    const std::string label =
        scene + "/" + std::string(name(partitioner)) + "/" + std::string(name(precision));
    benchmark::RegisterBenchmark(
        label.c_str(),
        [=](benchmark::State& state) { stepScene(state, scene, partitioner, precision); })
        ->Arg(bodies)
        ->Iterations(stepsFor(bodies))
        ->Unit(benchmark::kMillisecond);
}

/// `run(simulation, file)` on a world of that many bodies; a snapshot of it lies in the file.
template <class Run>
void registerOnce(const std::string& label, Run run) {
    const auto benchmarkOf = [run](benchmark::State& state) {
        SceneOptions options;
        options.entities = static_cast<std::uint64_t>(state.range(0));
        Scene loaded = loadScene(QUADRILLE_BENCH_SCENES_DIR "/dense.toml", options);
        const Simulation simulation(std::move(loaded.world), {.step = loaded.step});
        const auto file = std::filesystem::temp_directory_path() / "quadrille_micro.snapshot";
        saveSnapshot(file, simulation, "dense", 1);
        const std::clock_t start = std::clock();
        for (auto _ : state) run(simulation, file);
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        state.counters["ns_per_body"] =
            1e9 * seconds / double(state.iterations()) / double(state.range(0));
        std::filesystem::remove(file);
    };
    benchmark::RegisterBenchmark(label.c_str(), benchmarkOf)
        ->Arg(10'000)
        ->Arg(100'000)
        ->Iterations(20)
        ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string scene : {"dense", "sparse"}) {
        for (const PartitionerConfig& partitioner :
             {PartitionerConfig(StaticGrid{}), PartitionerConfig(Quadtree{}),
              PartitionerConfig(SemiStaticQuadtree{})}) {
            for (const std::int64_t bodies : {1'000, 10'000, 100'000, 1'000'000}) {
                registerStep(scene, partitioner, Precision::Double, bodies);
            }
            registerStep(scene, partitioner, Precision::Float, 100'000);
        }
    }
    using std::filesystem::path;
    registerOnce("validate", [](const Simulation& simulation, const path&) {
        benchmark::DoNotOptimize(simulation.world().validate());
    });
    registerOnce("state-hash", [](const Simulation& simulation, const path&) {
        benchmark::DoNotOptimize(stateHash(simulation.world()));
    });
    registerOnce("save", [](const Simulation& simulation, const path& file) {
        saveSnapshot(file, simulation, "dense", 1);
    });
    registerOnce("load", [](const Simulation&, const path& file) {
        benchmark::DoNotOptimize(loadSnapshot(file));
    });
    for (const auto& [key, value] : bench::describeMachine()) {
        benchmark::AddCustomContext(key, value);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
