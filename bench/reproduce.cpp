// The report's experiments, with this engine's figures beside the report's.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>

#include "accuracy/error_meter.hpp"
#include "bench/command_line.hpp"
#include "bench/partitioner_spec.hpp"
#include "bench/published_figures.hpp"
#include "bench/scene_files.hpp"
#include "bench/scene_runs.hpp"
#include "bench/table.hpp"

namespace {

using namespace quadrille;
using namespace quadrille::bench;

struct Options {
    std::filesystem::path folder = "reproduce";
    std::size_t frames = 200;
    Protocol protocol;
};

/// A line of a figure: who runs it, and its counterpart in the report if there is one.
struct Scheme {
    std::string name;
    std::string partitioner;
    ResolverKind resolver;
    std::optional<ReportScheme> report;
};

const std::vector<Scheme> schemes = {
    {"grid, sequential", "static-grid:26x26", ResolverKind::Sequential,
     ReportScheme::GridSequential},
    {"grid, cuda", "static-grid:26x26", ResolverKind::Cuda, ReportScheme::GridCuda},
    {"quadtree, sequential", "quadtree:10/20", ResolverKind::Sequential,
     ReportScheme::QuadtreeSequential},
    {"quadtree, cuda", "quadtree:10/20", ResolverKind::Cuda, ReportScheme::QuadtreeCuda},
    {"every 10, sequential", "semi-static-quadtree:10/20/every=10", ResolverKind::Sequential, {}},
    {"every 10, cuda", "semi-static-quadtree:10/20/every=10", ResolverKind::Cuda,
     ReportScheme::SemiStaticCuda},
    {"skin, sequential", "semi-static-quadtree:10/20/skin", ResolverKind::Sequential, {}},
    {"skin, cuda", "semi-static-quadtree:10/20/skin", ResolverKind::Cuda, {}},
};

std::string orNone(std::optional<double> value) {
    return value ? number(*value) : std::string(noValue);
}

Variant variantOf(const Scheme& scheme, Law law) {
    return {.partitioner = parsePartitioner(scheme.partitioner),
            .law = law,
            .resolver = scheme.resolver};
}

/// The schemes in a scene, law by law; schemes that cannot run here are missing.
struct SchemeTimes {
    const Scheme* scheme;
    Law law;
    Measurement measurement;
};

std::vector<SchemeTimes> timeSchemes(const std::string& scene, std::optional<std::uint64_t> count,
                                     const Options& options) {
    SceneRuns runs{scene, count, {}, options.frames};
    for (const Law law : {Law::Baseline, Law::Impulse}) {
        for (const Scheme& scheme : schemes) runs.variants.push_back(variantOf(scheme, law));
    }
    std::vector<SchemeTimes> times;
    for (Measurement& m : measure(runs, options.protocol)) {
        const auto same = [&](const Scheme& scheme) {
            return scheme.resolver == m.variant.resolver &&
                   scheme.partitioner == specOf(m.variant.partitioner);
        };
        const auto scheme = std::find_if(schemes.begin(), schemes.end(), same);
        times.push_back({&*scheme, m.variant.law, std::move(m)});
    }
    return times;
}

/// Milliseconds of the sequential grid under the same law.
std::optional<double> gridTime(const std::vector<SchemeTimes>& times, Law law) {
    for (const SchemeTimes& t : times) {
        if (t.law == law && t.scheme->report == ReportScheme::GridSequential) {
            return t.measurement.times.mean;
        }
    }
    return {};
}

/// What a law makes of the cells of a partitioner, against the event-driven reference; nothing
/// where the reference cannot go on, since bodies are wedged. The same on every resolver.
std::optional<accuracy::ErrorMetrics> errorOf(const std::string& scene,
                                              std::optional<std::uint64_t> count,
                                              const Variant& variant, const Options& options) {
    Scene opened = openScene(scene, count);
    const bool large = opened.world.movingCount() > 20'000;
    Simulation simulation(std::move(opened.world), {.partitioner = variant.partitioner,
                                                    .law = variant.law,
                                                    .step = opened.step,
                                                    .countMissedPairs = true,
                                                    .missedPairsEvery = large ? 10u : 1u});
    try {
        accuracy::ErrorMeter meter(simulation);
        for (std::size_t i = 0; i < options.protocol.warmup + options.frames; ++i) {
            simulation.step();
            meter.follow();
        }
        return meter.metrics();
    } catch (const Error& error) {
        std::cerr << "no reference for " << scene << ": " << error.what() << '\n';
        return {};
    }
}

/// Cells of a complete partition make no difference to the law `impulse`.
std::string errorKey(const Variant& variant) {
    const std::string spec = specOf(variant.partitioner);
    const bool complete = spec.find("every=") == std::string::npos;
    return std::string(name(variant.law)) +
           (variant.law == Law::Impulse && complete ? std::string() : spec);
}

/// Figure 5, and the imbalanced scene under the same schemes.
void speedups(const Options& options) {
    Table table({"scene", "bodies", "scheme", "law", "mean_ms", "median_ms", "speedup_over_grid",
                 "report_speedup", "report_program_ms", "times_faster_than_program", "recall",
                 "event_precision", "wrong_body_fraction", "overlap_max", "broad_phase_recall",
                 "energy_drift"});
    const auto addRows = [&](const std::string& scene, std::optional<std::size_t> index) {
        const auto count = index ? std::optional<std::uint64_t>(reportCounts[*index])
                                 : std::optional<std::uint64_t>();
        std::cerr << "speed-up: " << scene << ' ' << (count ? std::to_string(*count) : "") << '\n';
        const std::vector<SchemeTimes> times = timeSchemes(scene, count, options);
        std::map<std::string, std::optional<accuracy::ErrorMetrics>> errors;
        bool hasReference = true;
        const auto published = [&](const Scheme& scheme, double milliseconds) {
            std::optional<double> reported, program;
            if (const auto report = scheme.report) {
                if (index) reported = reportSpeedup(*report, *index);
                program = index ? programMilliseconds(*report, *index) : programImbalanced(*report);
            }
            const bool both = program && milliseconds > 0;
            return std::array{orNone(reported), orNone(program),
                              both ? number(*program / milliseconds) : std::string(noValue)};
        };
        for (const SchemeTimes& t : times) {
            const Measurement& m = t.measurement;
            const auto [found, isNew] = errors.try_emplace(errorKey(m.variant));
            if (isNew && hasReference) {
                found->second = errorOf(scene, count, m.variant, options);
                hasReference = found->second.has_value();
            }
            const std::optional<accuracy::ErrorMetrics>& error = found->second;
            const auto ofError = [&](auto&& value) {
                return error ? orNone(value(*error)) : std::string(noValue);
            };
            using Value = std::optional<double>;
            // Where nothing collides, nothing is right or wrong.
            const auto ofCollisions = [&](auto&& value) {
                return ofError(
                    [&](const auto& e) { return e.events.exact > 0 ? Value(value(e)) : Value(); });
            };
            const std::optional<double> grid = gridTime(times, t.law);
            const auto [reported, program, faster] = published(*t.scheme, m.times.mean);
            table.add({scene, std::to_string(m.bodies), t.scheme->name, std::string(name(t.law)),
                       number(m.times.mean), number(m.times.median),
                       grid ? number(*grid / m.times.mean) : std::string(noValue), reported,
                       program, faster,
                       ofCollisions([](const auto& e) { return e.events.recall(); }),
                       ofCollisions([](const auto& e) { return e.events.precision(); }),
                       ofCollisions([](const auto& e) { return e.wrongBodyFraction(); }),
                       ofError([](const auto& e) { return Value(e.overlapMax); }),
                       ofError([](const auto& e) { return e.broadPhaseRecall(); }),
                       orNone(m.energyDrift)});
        }
        for (const Law law : {Law::Baseline, Law::Impulse}) {
            for (const Scheme& scheme : schemes) {
                const bool measured = std::any_of(times.begin(), times.end(), [&](const auto& t) {
                    return t.scheme == &scheme && t.law == law;
                });
                if (measured || times.empty()) continue;
                const std::string none(noValue);
                const auto [reported, program, faster] = published(scheme, 0);
                table.add({scene, std::to_string(times.front().measurement.bodies), scheme.name,
                           std::string(name(law)), none, none, none, reported, program, faster,
                           none, none, none, none, none, none});
            }
        }
    };
    for (std::size_t i = 0; i < reportCounts.size(); ++i) addRows("balanced", i);
    addRows("imbalanced", {});
    publish(
        table,
        {(options.folder / "speedup.csv").string(), (options.folder / "speedup.md").string()},
        {"balanced, 50,000 and fewer bodies: figure 5 of the report",
         "errors are against the event-driven reference over the same frames (docs/accuracy.md "
         "says what each means, overlaps are in sides), and the same on every resolver; bodies "
         "of the imbalanced scene are wedged between walls, so that rounding decides its motion; "
         "- stands where nothing was measured, or nothing collided"});
}

/// The report's value at the nearest number of cells, on a logarithmic scale, within a factor of
/// 1.5.
std::optional<double> nearest(const std::vector<CellPoint>& curve, double cells) {
    const CellPoint* best = nullptr;
    const auto apart = [&](const CellPoint& p) { return std::abs(std::log(p.cells / cells)); };
    for (const CellPoint& p : curve) {
        if (best == nullptr || apart(p) < apart(*best)) best = &p;
    }
    if (best == nullptr || apart(*best) > std::log(1.5)) return {};
    return best->milliseconds;
}

/// Figures 6 and 7: the number of cells is varied by their size, or by the bodies that a leaf may
/// hold.
void cells(const Options& options) {
    Table table({"scene", "scheme", "thread_per", "cells", "active_cells", "mean_ms", "report_ms"});
    const std::array<double, 8> sides = {320, 150, 100, 60, 45, 36, 26, 20};
    const std::array<int, 8> perLeaf = {400, 100, 50, 30, 20, 12, 7, 4};
    const auto addRows = [&](const std::string& scene, bool imbalanced) {
        std::vector<Measurement> measurements;
        for (const CudaThread thread : {CudaThread::Cell, CudaThread::Body}) {
            // A single thread for a crowded cell takes up to a second a frame.
            const bool slow = thread == CudaThread::Cell;
            SceneRuns runs{
                scene, {}, {}, std::max<std::size_t>(1, options.frames / (slow ? 20 : 2))};
            if (!imbalanced) runs.entities = 1'700;
            const auto add = [&](const PartitionerConfig& partitioner) {
                runs.variants.push_back({.partitioner = partitioner,
                                         .resolver = ResolverKind::Cuda,
                                         .cuda = {.threadPer = thread}});
            };
            for (const double side : sides) add(StaticGrid{{side, side}});
            for (const int most : perLeaf) add(Quadtree{10, most});
            for (const int most : perLeaf) {
                add(SemiStaticQuadtree{10, most, SemiStaticQuadtree::EveryFrames{10}});
            }
            std::cerr << "cells: " << scene << ", a thread a " << (slow ? "cell" : "body") << '\n';
            Protocol protocol = options.protocol;
            if (slow)
                protocol = {.warmup = std::min<std::size_t>(protocol.warmup, 2), .repeats = 1};
            for (Measurement& m : measure(runs, protocol)) measurements.push_back(std::move(m));
        }
        for (const Measurement& m : measurements) {
            const std::size_t kind = m.variant.partitioner.index();
            const auto report = std::holds_alternative<StaticGrid>(m.variant.partitioner)
                                    ? ReportScheme::GridCuda
                                : std::holds_alternative<Quadtree>(m.variant.partitioner)
                                    ? ReportScheme::QuadtreeCuda
                                    : ReportScheme::SemiStaticCuda;
            const bool perCell = m.variant.cuda.threadPer == CudaThread::Cell;
            table.add(
                {scene,
                 kind == 1   ? "grid"
                 : kind == 2 ? "quadtree"
                             : "every 10",
                 perCell ? "cell" : "body", std::to_string(m.cells.cells),
                 std::to_string(m.cells.activeCells), number(m.times.mean),
                 orNone(nearest(reportCellCurve(report, imbalanced), double(m.cells.cells)))});
        }
    };
    addRows("imbalanced", true);
    addRows("balanced", false);
    publish(table,
            {(options.folder / "cells.csv").string(), (options.folder / "cells.md").string()},
            {"1,700 bodies, law impulse: figures 6 (imbalanced) and 7 (balanced) of the report; "
             "report_ms is the report's at the nearest number of cells"});
}

/// The report's points as they are, for the plot.
void reportCurves(const Options& options) {
    Table table({"scene", "scheme", "cells", "report_ms"});
    for (const bool imbalanced : {true, false}) {
        for (const auto& [scheme, text] : {std::pair{ReportScheme::GridCuda, "grid"},
                                           {ReportScheme::QuadtreeCuda, "quadtree"},
                                           {ReportScheme::SemiStaticCuda, "every 10"}}) {
            for (const CellPoint& p : reportCellCurve(scheme, imbalanced)) {
                table.add({imbalanced ? "imbalanced" : "balanced", text, number(p.cells),
                           number(p.milliseconds)});
            }
        }
    }
    publish(table, {(options.folder / "report_cells.csv").string(), {}}, {});
}

/// Table 2: 20,000 bodies, tree rebuilt every ten frames; and where 50,000 spend their time.
void profile(const Options& options) {
    const auto runsOf = [&](std::uint64_t bodies, std::initializer_list<const char*> partitioners) {
        SceneRuns runs{"balanced", bodies, {}, options.frames};
        for (const char* spec : partitioners) {
            runs.variants.push_back({.partitioner = parsePartitioner(spec),
                                     .resolver = ResolverKind::Cuda,
                                     .profile = true});
        }
        return runs;
    };
    const char* const everyTen = "semi-static-quadtree:10/20/every=10";
    const char* const skin = "semi-static-quadtree:10/20/skin";
    Table table({"bodies", "partitioner", "phase", "ms", "percent", "report_percent",
                 "report_program_ms", "report_program_percent"});
    for (const SceneRuns& runs :
         {runsOf(reportProfileBodies, {everyTen, skin}),
          runsOf(50'000, {"static-grid:26x26", "quadtree:10/20", everyTen, skin})}) {
        std::cerr << "profile: " << *runs.entities << '\n';
        for (const Measurement& m : measure(runs, options.protocol)) {
            double total = 0;
            for (const double ms : m.phaseMilliseconds) total += ms;
            for (std::size_t i = 0; i < phaseCount; ++i) {
                ProfileRow row = reportProfile()[i];
                if (m.bodies != reportProfileBodies) {
                    row.reportPercent = row.programMilliseconds = {};
                }
                const auto program = row.programMilliseconds;
                table.add({std::to_string(m.bodies), specOf(m.variant.partitioner),
                           std::string(row.phase), number(m.phaseMilliseconds[i]),
                           number(100 * m.phaseMilliseconds[i] / total), orNone(row.reportPercent),
                           orNone(program),
                           program ? number(100 * *program / programProfileTotal)
                                   : std::string(noValue)});
            }
        }
    }
    publish(table,
            {(options.folder / "profile.csv").string(), (options.folder / "profile.md").string()},
            {"law impulse; 20,000 bodies: table 2 of the report. What the device does within "
             "copy_to_device and copy_to_host is timed there; resolve is the rest of the wait"});
}

/// Why the resolver `cuda` does not run here; nothing if it does.
std::optional<std::string> whyNoDevice() {
    try {
        Simulation(World({.size = {10, 10}}),
                   {.law = Law::Impulse, .resolver = ResolverKind::Cuda, .fallback = false});
    } catch (const NotAvailable& error) {
        return error.what();
    } catch (const DeviceError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Makes the report's experiments and sets its figures beside ours.");
    app.add_option("--folder", options.folder, "where the tables go")->capture_default_str();
    app.add_option("--frames", options.frames, "timed frames per repeat")
        ->capture_default_str()
        ->check(CLI::Range(2, 1'000'000));
    app.add_option("--warmup", options.protocol.warmup, "frames before them")
        ->capture_default_str();
    app.add_option("--repeat", options.protocol.repeats, "runs of each row")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    return quadrille::bench::runCommandLine(app, argc, argv, [&] {
        std::filesystem::create_directories(options.folder);
        const auto missing = whyNoDevice();
        if (missing) {
            std::cerr << "reproduce: " << *missing
                      << "; figures 6 and 7 and table 2 need a device and are left out, figure 5 "
                         "has - for the resolver cuda\n";
        }
        reportCurves(options);
        speedups(options);
        if (missing) return;
        cells(options);
        profile(options);
    });
}
