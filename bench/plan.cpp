#include "bench/plan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "bench/partitioner_spec.hpp"
#include "bench/published_figures.hpp"
#include "bench/scene_files.hpp"

namespace quadrille::bench {

namespace {

/// What the report has beside a partitioner on one core. It gives no figure for its semi-static
/// tree without the GPU.
struct ReportProgram {
    std::string_view partitioner;
    std::string_view name;
    ReportScheme scheme;
};
constexpr std::array reportPrograms = {
    ReportProgram{"static-grid", "report, StaticGrid sequential", ReportScheme::GridSequential},
    ReportProgram{"quadtree", "report, Quadtree sequential", ReportScheme::QuadtreeSequential},
    ReportProgram{"semi-static-quadtree", "report, semi-static CUDA", ReportScheme::SemiStaticCuda},
};

/// Parameters near the best of each partitioner at the density of the balanced scenes.
const std::vector<std::string> contenders = {"static-grid:16x16",
                                             "static-grid:26x26",
                                             "quadtree:10/20",
                                             "quadtree:10/32",
                                             "semi-static-quadtree:10/12",
                                             "semi-static-quadtree:10/20",
                                             "semi-static-quadtree:10/32"};

std::vector<std::string> shippedScenesWithMovingBodies(std::size_t least) {
    std::vector<std::string> names;
    for (std::string& name : shippedScenes()) {
        if (openScene(name).world.movingCount() >= least) {
            names.push_back(std::move(name));
        }
    }
    return names;
}

}  // namespace

void parseResolver(std::string_view spec, Variant& variant) {
    const auto colon = spec.find(':');
    const auto resolver = find(resolvers(), spec.substr(0, colon));
    variant.threads = 0;
    if (resolver && colon == std::string_view::npos) {
        variant.resolver = *resolver;
        return;
    }
    if (resolver == ResolverKind::Threads) {
        const auto count = spec.substr(colon + 1);
        const char* const end = count.data() + count.size();
        const auto read = std::from_chars(count.data(), end, variant.threads);
        variant.resolver = *resolver;
        if (read.ec == std::errc() && read.ptr == end && variant.threads > 0) return;
    }
    throw Error("resolver '" + std::string(spec) + "' is none of: " + resolverSpecs());
}

std::string resolverSpecs() {
    std::string text;
    for (const auto& named : resolvers()) {
        text += (text.empty() ? "" : ", ") + std::string(named.name);
        if (named.kind == ResolverKind::Threads) text += "[:N]";
    }
    return text;
}

std::string resolverSpecOf(const Variant& variant) {
    std::string spec(name(variant.resolver));
    if (variant.threads > 0) spec += ':' + std::to_string(variant.threads);
    return spec;
}

std::vector<SceneRuns> expand(const Sweep& sweep) {
    std::vector<Variant> variants;
    for (const Law law : sweep.laws) {
        for (const Precision precision : sweep.precisions) {
            for (const std::string& spec : sweep.partitioners) {
                for (const std::string& resolver : sweep.resolvers) {
                    variants.push_back({.partitioner = parsePartitioner(spec),
                                        .law = law,
                                        .precision = precision,
                                        .label = {},
                                        .change = {}});
                    parseResolver(resolver, variants.back());
                }
            }
        }
    }
    std::vector<std::optional<std::uint64_t>> counts(sweep.entities.begin(), sweep.entities.end());
    if (counts.empty()) counts.emplace_back();
    std::vector<SceneRuns> runs;
    for (const std::string& scene : sweep.scenes) {
        for (const auto& count : counts) runs.push_back({scene, count, variants, sweep.frames});
    }
    return runs;
}

std::vector<Sweep> reportPreset() {
    return {
        {.scenes = {"balanced"},
         .entities = {reportCounts.begin(), reportCounts.end()},
         .partitioners = {"static-grid:26x26", "quadtree:10/20", "semi-static-quadtree:10/20/skin",
                          "semi-static-quadtree:10/20/every=10"},
         .laws = {Law::Baseline, Law::Impulse}}};
}

std::vector<Sweep> targetsPreset() {
    return {{.scenes = {"balanced", "balanced-scaled"},
             .entities = {50'000},
             .partitioners = contenders},
            {.scenes = {"balanced-scaled"},
             .entities = {1'000'000},
             .partitioners = contenders,
             .frames = 60},
            {.scenes = shippedScenesWithMovingBodies(1'000),
             .entities = {},
             .partitioners = {"quadtree:10/20", "semi-static-quadtree:10/20/skin"}}};
}

std::vector<Sweep> threadsPreset() {
    std::vector<std::string> resolvers = {"sequential"};
    for (int threads = 1; threads < Simulation::cores(); threads *= 2) {
        resolvers.push_back("threads:" + std::to_string(threads));
    }
    resolvers.push_back("threads:" + std::to_string(Simulation::cores()));
    return {
        {.scenes = {"balanced", "balanced-scaled"},
         .entities = {50'000},
         .partitioners = {"semi-static-quadtree:10/20/skin"},
         .laws = {Law::Impulse, Law::Continuous},
         .resolvers = resolvers},
        {.scenes = {"balanced-scaled"},
         .entities = {1'000'000},
         .partitioners = {"static-grid:26x26", "quadtree:10/20", "semi-static-quadtree:10/20/skin"},
         .resolvers = resolvers,
         .frames = 60}};
}

std::vector<Sweep> resolversPreset() {
    Sweep sweep{
        .scenes = {"balanced-scaled"},
        .entities = {},
        .partitioners = {"static-grid:26x26", "quadtree:10/20", "semi-static-quadtree:10/20/skin"},
        .resolvers = {"sequential", "threads"}};
    if (findCudaDevice().usable()) sweep.resolvers.push_back("cuda");
    Sweep large = sweep;
    sweep.entities = {1'000, 2'000, 5'000, 10'000, 20'000, 50'000};
    large.entities = {200'000, 1'000'000};
    large.frames = 60;
    return {sweep, large};
}

std::optional<Reference> reportReference(const Measurement& measurement) {
    if (measurement.scene != "balanced") return {};
    const auto program =
        std::find_if(reportPrograms.begin(), reportPrograms.end(), [&](const ReportProgram& p) {
            return p.partitioner == name(measurement.variant.partitioner);
        });
    if (program == reportPrograms.end()) return {};
    for (std::size_t i = 0; i < reportCounts.size(); ++i) {
        if (reportCounts[i] != measurement.bodies) continue;
        return Reference{std::string(program->name), programMilliseconds(program->scheme, i)};
    }
    return {};
}

std::optional<Reference> rebuiltTree(const Measurement& measurement,
                                     const std::vector<Measurement>& sameScene) {
    const auto* kept = std::get_if<SemiStaticQuadtree>(&measurement.variant.partitioner);
    if (kept == nullptr) return {};
    for (const Measurement& other : sameScene) {
        const auto* rebuilt = std::get_if<Quadtree>(&other.variant.partitioner);
        if (rebuilt != nullptr && rebuilt->maxDepth == kept->maxDepth &&
            rebuilt->maxPerCell == kept->maxPerCell &&
            other.variant.law == measurement.variant.law &&
            other.variant.precision == measurement.variant.precision &&
            resolverSpecOf(other.variant) == resolverSpecOf(measurement.variant)) {
            return Reference{specOf(other.variant.partitioner), other.times.mean};
        }
    }
    return {};
}

std::optional<Reference> sequentialResolver(const Measurement& measurement,
                                            const std::vector<Measurement>& sameScene) {
    if (measurement.variant.resolver == ResolverKind::Sequential) return {};
    for (const Measurement& other : sameScene) {
        if (other.variant.resolver == ResolverKind::Sequential &&
            specOf(other.variant.partitioner) == specOf(measurement.variant.partitioner) &&
            other.variant.law == measurement.variant.law &&
            other.variant.precision == measurement.variant.precision) {
            return Reference{"sequential", other.times.mean};
        }
    }
    return {};
}

void requireOneState(const std::vector<Measurement>& sameScene) {
    // `baseline` depends on the cells, and cells that are out of date miss pairs.
    const auto keyOf = [](const Measurement& m) {
        const auto* tree = std::get_if<SemiStaticQuadtree>(&m.variant.partitioner);
        const bool stale = tree != nullptr &&
                           std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
        const bool own = stale || m.variant.law == Law::Baseline;
        return std::tuple(m.variant.law, m.variant.precision,
                          own ? specOf(m.variant.partitioner) : std::string());
    };
    for (const Measurement& m : sameScene) {
        for (const Measurement& other : sameScene) {
            if (keyOf(m) != keyOf(other) || m.stateHash == other.stateHash) continue;
            throw Error(m.scene + ": " + specOf(m.variant.partitioner) + " on " +
                        resolverSpecOf(m.variant) + " and " + specOf(other.variant.partitioner) +
                        " on " + resolverSpecOf(other.variant) + " end in different states");
        }
    }
}

}  // namespace quadrille::bench
