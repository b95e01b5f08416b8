// Whole scenes under every partitioner, law and precision asked for, as a table.

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "bench/command_line.hpp"
#include "bench/partitioner_spec.hpp"
#include "bench/plan.hpp"
#include "bench/scene_runs.hpp"
#include "bench/table.hpp"

namespace {

using namespace quadrille;
using namespace quadrille::bench;

struct Options {
    std::string preset;
    Sweep sweep{.scenes = {"balanced"},
                .entities = {},
                .partitioners = {"static-grid", "quadtree", "semi-static-quadtree"}};
    std::vector<std::string> laws, precisions, resolvers;
    std::size_t frames = 0;
    Protocol protocol;
    TableFiles files;
};

/// What the names stand for.
template <class Kind>
std::vector<Kind> kindsOf(const std::vector<std::string>& names, std::span<const Named<Kind>> all) {
    std::vector<Kind> kinds;
    kinds.reserve(names.size());
    for (const std::string& wanted : names) kinds.push_back(find(all, wanted).value());
    return kinds;
}

void addOptions(CLI::App& app, Options& options) {
    auto* scenes = app.add_option("--scenes", options.sweep.scenes, "names or files (balanced)");
    auto* entities = app.add_option("--entities", options.sweep.entities,
                                    "counts of the first spawn group (the scene's)");
    auto* partitionerList = app.add_option("--partitioners", options.sweep.partitioners,
                                           partitionerSpecs() + " (all but the first)");
    auto* lawNames =
        app.add_option("--laws", options.laws, "(impulse)")->check(CLI::IsMember(namesOf(laws())));
    auto* precisionNames = app.add_option("--precisions", options.precisions, "(double)")
                               ->check(CLI::IsMember(namesOf(precisions())));
    auto* resolverList =
        app.add_option("--resolvers", options.resolvers, resolverSpecs() + " (sequential)");
    for (auto* list : {scenes, entities, partitionerList, lawNames, precisionNames, resolverList}) {
        list->delimiter(',');
    }
    app.add_option("--frames", options.frames, "timed frames per repeat (200)")
        ->check(CLI::PositiveNumber);
    app.add_option("--warmup", options.protocol.warmup, "frames before them")
        ->capture_default_str();
    app.add_option("--repeat", options.protocol.repeats, "runs of each row")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.files.csv, "write the table as CSV");
    app.add_option("--markdown", options.files.markdown, "write the table as Markdown");
    app.add_option("--preset", options.preset,
                   "report: the report's scaling experiment; targets: the project's own targets; "
                   "threads: what threads are worth; resolvers: which one pays from which size on")
        ->check(CLI::IsMember({"report", "targets", "threads", "resolvers"}))
        ->excludes(scenes)
        ->excludes(entities)
        ->excludes(partitionerList);
}

/// The sweeps of the preset, or the one asked for, with the options that go with both.
std::vector<Sweep> sweepsOf(const Options& options) {
    std::vector<Sweep> sweeps = options.preset == "report"      ? reportPreset()
                                : options.preset == "targets"   ? targetsPreset()
                                : options.preset == "threads"   ? threadsPreset()
                                : options.preset == "resolvers" ? resolversPreset()
                                                                : std::vector{options.sweep};
    for (Sweep& sweep : sweeps) {
        if (!options.laws.empty()) {
            sweep.laws = kindsOf(options.laws, laws());
        }
        if (!options.precisions.empty()) {
            sweep.precisions = kindsOf(options.precisions, precisions());
        }
        if (!options.resolvers.empty()) sweep.resolvers = options.resolvers;
        if (options.frames > 0) sweep.frames = options.frames;
    }
    return sweeps;
}

/// The lowest mean among the runs of a scene with the same law and precision.
bool isFastest(const Measurement& measurement, const std::vector<Measurement>& sameScene) {
    return std::none_of(sameScene.begin(), sameScene.end(), [&](const Measurement& other) {
        return other.variant.law == measurement.variant.law &&
               other.variant.precision == measurement.variant.precision &&
               other.times.mean < measurement.times.mean;
    });
}

Table makeTable() {
    return Table({"scene",
                  "bodies",
                  "partitioner",
                  "law",
                  "precision",
                  "resolver",
                  "mean_ms",
                  "median_ms",
                  "p99_ms",
                  "ns_per_body_step",
                  "ns_per_body_step_median",
                  "pairs_per_body",
                  "contacts_per_frame",
                  "rebuilds_per_100",
                  "energy_drift",
                  "bytes_per_body",
                  "state_hash",
                  "fastest",
                  "reference",
                  "reference_ms",
                  "speedup"});
}

void addRow(Table& table, const Measurement& m, bool fastest,
            const std::optional<Reference>& reference) {
    const std::string none(noValue);
    table.add({m.scene,
               std::to_string(m.bodies),
               specOf(m.variant.partitioner),
               std::string(name(m.variant.law)),
               std::string(name(m.variant.precision)),
               resolverSpecOf(m.variant),
               number(m.times.mean),
               number(m.times.median),
               number(m.times.p99),
               number(m.nsPerBody(m.times.mean)),
               number(m.nsPerBody(m.times.median)),
               number(m.pairsPerBody),
               number(m.contactsPerFrame),
               number(m.rebuildsPer100),
               m.energyDrift ? number(*m.energyDrift) : none,
               number(m.bytesPerBody),
               hexadecimal(m.stateHash),
               fastest ? "*" : "",
               reference ? reference->name : none,
               reference ? number(reference->milliseconds) : none,
               reference ? number(reference->milliseconds / m.times.mean) : none});
}

void run(const Options& options) {
    checkWritable(options.files);
    std::vector<SceneRuns> plan;
    for (const Sweep& sweep : sweepsOf(options)) {
        for (SceneRuns& runs : expand(sweep)) plan.push_back(std::move(runs));
    }
    Table table = makeTable();
    for (const SceneRuns& runs : plan) {
        std::cerr << "running " << runs.scene
                  << (runs.entities ? " " + std::to_string(*runs.entities) : "") << ": "
                  << runs.variants.size() << " rows\n";
        const std::vector<Measurement> measurements = measure(runs, options.protocol);
        for (const Measurement& m : measurements) {
            auto reference = sequentialResolver(m, measurements);
            if (!reference) {
                reference =
                    options.preset == "report" ? reportReference(m) : rebuiltTree(m, measurements);
            }
            addRow(table, m, isFastest(m, measurements), reference);
        }
        requireOneState(measurements);
    }
    publish(table, options.files,
            {std::to_string(options.protocol.repeats) + " repeats, " +
             std::to_string(options.protocol.warmup) + " frames of warm-up each"});
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Times whole scenes.");
    addOptions(app, options);
    return quadrille::bench::runCommandLine(app, argc, argv, [&] { run(options); });
}
