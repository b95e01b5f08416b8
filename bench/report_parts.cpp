#include "bench/report_parts.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "accuracy/error_meter.hpp"
#include "bench/partitioner_spec.hpp"
#include "bench/scene_files.hpp"
#include "bench/scene_runs.hpp"

namespace quadrille::bench {

namespace {

std::string fraction(int rate) { return "1/" + std::to_string(rate); }

std::string orNone(const std::optional<double>& value) {
    return value ? number(*value) : std::string(noValue);
}

bool runs(Law law, int rate, const ReportPlan& plan) {
    return rate != plan.coarseRate || law == Law::Continuous;
}

std::vector<int> ratesOf(const ReportPlan& plan) {
    std::vector<int> rates{plan.coarseRate};
    rates.insert(rates.end(), plan.rates.begin(), plan.rates.end());
    return rates;
}

/// Steps that cover so many frames of 1/60 s, and at least one.
int stepsFor(int frames, int rate) {
    return std::max(1, static_cast<int>(std::lround(double(frames) * rate / 60)));
}

accuracy::ErrorMetrics errorOf(const ReportScene& entry, Law law, Precision precision, int rate) {
    Scene scene = openScene(entry.file, entry.entities);
    scene.step.dt = 1.0 / rate;
    const bool large = scene.world.movingCount() > 20'000;
    Simulation simulation(std::move(scene.world), {.partitioner = Quadtree{},
                                                   .law = law,
                                                   .precision = precision,
                                                   .step = scene.step,
                                                   .countMissedPairs = true,
                                                   .missedPairsEvery = large ? 10u : 1u});
    accuracy::ErrorMeter meter(simulation);
    const int steps = stepsFor(entry.errorFrames, rate);
    for (int i = 0; i < steps; ++i) {
        simulation.step();
        meter.follow();
    }
    return meter.metrics();
}

}  // namespace

Table measureErrors(const ReportPlan& plan) {
    Table table({"scene",
                 "bodies",
                 "law",
                 "precision",
                 "dt",
                 "horizon_s",
                 "collisions_per_body",
                 "exact_collisions",
                 "collisions",
                 "matched_collisions",
                 "recall",
                 "event_precision",
                 "f1",
                 "wrong_body_fraction",
                 "position_median",
                 "position_p99",
                 "position_max",
                 "rate_bias",
                 "overlap_max",
                 "overlap_mean",
                 "escaped",
                 "energy_drift",
                 "speed_drift",
                 "wall_identity_x",
                 "wall_identity_y",
                 "broad_phase_recall"});
    for (const ReportScene& scene : plan.scenes) {
        if (scene.errorFrames == 0) continue;
        std::cerr << "error: " << scene.name << '\n';
        for (const Law law : allLaws) {
            for (const Precision precision : plan.precisions) {
                for (const int rate : ratesOf(plan)) {
                    if (!runs(law, rate, plan)) continue;
                    const auto m = errorOf(scene, law, precision, rate);
                    table.add({scene.name,
                               std::to_string(m.bodies),
                               std::string(name(law)),
                               std::string(name(precision)),
                               fraction(rate),
                               number(m.horizon),
                               number(2 * double(m.events.exact) / double(m.bodies)),
                               std::to_string(m.events.exact),
                               std::to_string(m.events.measured),
                               std::to_string(m.events.matched),
                               number(m.events.recall()),
                               number(m.events.precision()),
                               number(m.events.f1()),
                               number(m.wrongBodyFraction()),
                               number(m.positionError.median),
                               number(m.positionError.p99),
                               number(m.positionError.max),
                               orNone(m.events.rateBias()),
                               number(m.overlapMax),
                               number(m.overlapMean),
                               std::to_string(m.escaped),
                               number(m.energyDrift),
                               orNone(m.speedDrift),
                               m.wallIdentity ? number(m.wallIdentity->x()) : std::string(noValue),
                               m.wallIdentity ? number(m.wallIdentity->y()) : std::string(noValue),
                               orNone(m.broadPhaseRecall())});
                }
            }
        }
    }
    return table;
}

Table measureSpeeds(const ReportPlan& plan) {
    Table table({"scene", "bodies", "law", "precision", "dt", "partitioner", "mean_ms",
                 "ns_per_body_step", "ns_per_body_second", "contacts_per_body_step",
                 "rebuilds_per_100", "bytes_per_body", "state_hash"});
    for (const ReportScene& scene : plan.scenes) {
        for (const int rate : ratesOf(plan)) {
            std::cerr << "speed: " << scene.name << ", dt " << fraction(rate) << '\n';
            SceneRuns sceneRuns{.scene = scene.file,
                                .entities = scene.entities,
                                .variants = {},
                                .frames = std::size_t(stepsFor(scene.speedFrames, rate)),
                                .dt = 1.0 / rate};
            for (const Law law : allLaws) {
                if (!runs(law, rate, plan)) continue;
                for (const Precision precision : plan.precisions) {
                    for (const std::string& spec : plan.partitioners) {
                        sceneRuns.variants.push_back({.partitioner = parsePartitioner(spec),
                                                      .law = law,
                                                      .precision = precision,
                                                      .label = {},
                                                      .change = {}});
                    }
                }
            }
            // The first steps allocate, and build what later ones keep.
            const auto warmup = std::size_t(std::max(2, stepsFor(scene.speedFrames / 5, rate)));
            std::map<std::pair<Law, Precision>, std::uint64_t> answers;
            for (const Measurement& m :
                 measure(sceneRuns, {.warmup = warmup, .repeats = plan.repeats})) {
                const Variant& v = m.variant;
                const auto [first, isNew] =
                    answers.emplace(std::pair(v.law, v.precision), m.stateHash);
                if (v.law != Law::Baseline && first->second != m.stateHash) {
                    throw Error(scene.name + ", dt " + fraction(rate) + ", " +
                                specOf(v.partitioner) + ": another answer than on " +
                                plan.partitioners.front());
                }
                const double ns = m.nsPerBody(m.times.mean);
                table.add({scene.name, std::to_string(m.bodies), std::string(name(v.law)),
                           std::string(name(v.precision)), fraction(rate), specOf(v.partitioner),
                           number(m.times.mean), number(ns), number(ns * rate),
                           number(m.contactsPerFrame / double(m.bodies)), number(m.rebuildsPer100),
                           number(m.bytesPerBody), hexadecimal(m.stateHash)});
            }
        }
    }
    return table;
}

Table measurePolicies(const ReportPlan& plan) {
    Table table({"scene", "bodies", "rebuild", "steps", "mean_ms", "ns_per_body_step",
                 "rebuilds_per_100", "overlapping_pairs", "missed_pairs", "missed_fraction"});
    for (const ReportScene& scene : plan.scenes) {
        std::cerr << "policies: " << scene.name << '\n';
        SceneRuns sceneRuns{.scene = scene.file,
                            .entities = scene.entities,
                            .variants = {},
                            .frames = plan.policyFrames,
                            .dt = {}};
        std::vector<std::string> specs{"semi-static-quadtree:10/20/skin"};
        for (const int k : plan.policies) {
            specs.push_back("semi-static-quadtree:10/20/every=" + std::to_string(k));
        }
        for (const std::string& spec : specs) {
            sceneRuns.variants.push_back(
                {.partitioner = parsePartitioner(spec), .label = {}, .change = {}});
        }
        for (const Measurement& m : measure(sceneRuns, {.warmup = 0, .repeats = plan.repeats})) {
            Scene fresh = openScene(scene.file, scene.entities);
            Simulation simulation(std::move(fresh.world), {.partitioner = m.variant.partitioner,
                                                           .law = m.variant.law,
                                                           .step = fresh.step,
                                                           .countMissedPairs = true});
            std::uint64_t overlapping = 0, missed = 0;
            for (std::size_t i = 0; i < plan.policyFrames; ++i) {
                const StepReport& report = simulation.step();
                overlapping += report.overlappingPairs;
                missed += report.missedPairs;
            }
            const std::string spec = specOf(m.variant.partitioner);
            table.add({scene.name, std::to_string(m.bodies), spec.substr(spec.rfind('/') + 1),
                       std::to_string(plan.policyFrames), number(m.times.mean),
                       number(m.nsPerBody(m.times.mean)), number(m.rebuildsPer100),
                       std::to_string(overlapping), std::to_string(missed),
                       number(overlapping == 0 ? 0 : double(missed) / double(overlapping))});
        }
    }
    return table;
}

namespace {

/// Gives every moving body of the scene what `edit` makes of it.
template <class Component, class Edit>
void forEachMoving(Scene& scene, Edit&& edit) {
    World& world = scene.world;
    Random random(1);
    std::vector<Entity> entities;
    world.visitBodies([&](const auto& bodies) {
        for (const std::uint32_t index : bodies.moving.entity) {
            entities.push_back(world.entityAt(index));
        }
    });
    for (const Entity entity : entities) {
        auto component = world.get<Component>(entity);
        edit(component, random);
        world.set(entity, component);
    }
}

void unequalMasses(Scene& scene) {
    forEachMoving<PhysicsBody>(
        scene, [](PhysicsBody& body, Random& random) { body.mass = random.uniform(0.9, 1.1); });
}

void unequalSizes(Scene& scene) {
    forEachMoving<BoxCollider>(scene, [](BoxCollider& box, Random& random) {
        const double side = random.uniform(2.9, 3.1);
        box.size = {side, side};
    });
}

}  // namespace

Table measureFeatures(const ReportPlan& plan) {
    std::cerr << "features\n";
    Table table({"scene", "law", "bodies", "bytes_per_body", "ns_per_body_step", "over_base",
                 "contacts_per_body_step"});
    const std::string base = "equal squares";
    std::vector<Variant> features{
        {.partitioner = {}, .label = base, .change = {}},
        {.partitioner = {},
         .label = "+ gravity",
         .change =
             [](Scene& scene) {
                 scene.step.gravity = {0, -1};
             }},
        {.partitioner = {}, .label = "+ unequal masses", .change = unequalMasses},
        {.partitioner = {}, .label = "+ unequal sizes", .change = unequalSizes},
        {.partitioner = {}, .label = "+ listener", .change = {}, .listener = true}};
    SceneRuns sceneRuns{.scene = QUADRILLE_BENCH_SCENES_DIR "/dense.toml",
                        .entities = plan.featureBodies,
                        .variants = {},
                        .frames = plan.featureFrames,
                        .dt = {}};
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        for (Variant feature : features) {
            feature.law = law;
            feature.partitioner = SemiStaticQuadtree{};
            sceneRuns.variants.push_back(std::move(feature));
        }
    }
    std::map<Law, double> baseCost;
    for (const Measurement& m :
         measure(sceneRuns, {.warmup = 20, .repeats = plan.featureRepeats})) {
        const double ns = m.nsPerBody(m.times.mean);
        if (m.variant.label == base) baseCost[m.variant.law] = ns;
        table.add({m.variant.label, std::string(name(m.variant.law)), std::to_string(m.bodies),
                   number(m.bytesPerBody), number(ns), number(ns / baseCost[m.variant.law]),
                   number(m.contactsPerFrame / double(m.bodies))});
    }
    // What is decided at run time is decided once a step or once a cell: all of it is in the time
    // of a step that has nothing else to do.
    SceneRuns empty = sceneRuns;
    empty.entities = 1;
    empty.frames = 20 * plan.featureFrames;
    empty.variants = {sceneRuns.variants.front(), sceneRuns.variants[features.size()]};
    for (const Measurement& m : measure(empty, {.warmup = 20, .repeats = plan.featureRepeats})) {
        table.add({"one square alone", std::string(name(m.variant.law)), std::to_string(m.bodies),
                   number(m.bytesPerBody), number(m.nsPerBody(m.times.mean)), std::string(noValue),
                   number(m.contactsPerFrame)});
    }
    return table;
}

}  // namespace quadrille::bench
