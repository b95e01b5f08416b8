#include "bench/scene_runs.hpp"

#include <cmath>
#include <iostream>
#include <utility>

#include <quadrille/error.hpp>
#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "bench/partitioner_spec.hpp"
#include "bench/scene_files.hpp"

namespace quadrille::bench {

namespace {

/// What one repeat of a variant gives; the times of the frames are not yet in `measurement`.
struct Repeat {
    Measurement measurement;
    std::vector<double> milliseconds;
};

Repeat runOnce(const SceneRuns& runs, const Variant& variant, std::size_t warmup) {
    Scene scene = openScene(runs.scene, runs.entities);
    if (runs.dt) scene.step.dt = *runs.dt;
    if (variant.change) variant.change(scene);
    const StepSettings step = scene.step;
    Measurement result{.variant = variant,
                       .scene = scene.name,
                       .times = {},
                       .phaseMilliseconds = {},
                       .energyDrift = {},
                       .cells = {}};

    Simulation simulation(std::move(scene.world), {.partitioner = variant.partitioner,
                                                   .law = variant.law,
                                                   .precision = variant.precision,
                                                   .resolver = variant.resolver,
                                                   .threads = variant.threads,
                                                   .step = step,
                                                   .profile = variant.profile,
                                                   .cuda = variant.cuda});
    if (variant.listener) simulation.onContact([](const Contact&) {});
    const World& world = simulation.world();
    const double energyAtStart = totalEnergy(world, step.gravity);
    simulation.run(warmup);

    std::uint64_t pairs = 0, contacts = 0, rebuilds = 0;
    std::vector<double> milliseconds;  // reserved: growing would be timed
    milliseconds.reserve(runs.frames);
    timeSteps(runs.frames, milliseconds, [&] {
        const StepReport& report = simulation.step();
        pairs += report.pairsTested;
        contacts += report.contacts;
        rebuilds += report.rebuilt;
        for (std::size_t i = 0; i < phaseCount; ++i) {
            result.phaseMilliseconds[i] += 1e3 * report.phaseSeconds[i] / double(runs.frames);
        }
    });

    const double frames = double(runs.frames);
    result.bodies = world.movingCount();
    const double bodies = double(result.bodies);
    result.pairsPerBody = double(pairs) / frames / bodies;
    result.contactsPerFrame = double(contacts) / frames;
    result.rebuildsPer100 = 100 * double(rebuilds) / frames;
    if (step.restitution == 1 && energyAtStart != 0) {
        const double gain = totalEnergy(world, step.gravity) - energyAtStart;
        result.energyDrift = gain / std::abs(energyAtStart);
    }
    result.bytesPerBody = double(world.bytes() + simulation.workspaceBytes()) / bodies;
    result.cells = loadOf(simulation.cells());
    result.stateHash = stateHash(world);
    return {std::move(result), std::move(milliseconds)};
}

/// One measurement out of the repeats of a variant.
Measurement combine(std::vector<Repeat> repeats) {
    Measurement result = std::move(repeats.front().measurement);
    std::vector<std::vector<double>> milliseconds;
    for (Repeat& repeat : repeats) {
        if (repeat.measurement.stateHash != result.stateHash) {
            throw Error(result.scene + ", " + specOf(result.variant.partitioner) +
                        ": two repeats end in different states");
        }
        milliseconds.push_back(std::move(repeat.milliseconds));
    }
    result.times = summarize(milliseconds);
    return result;
}

}  // namespace

std::vector<Measurement> measure(const SceneRuns& runs, const Protocol& protocol) {
    std::vector<std::vector<Repeat>> repeats(runs.variants.size());
    for (std::size_t repeat = 0; repeat < protocol.repeats; ++repeat) {
        for (std::size_t i = 0; i < runs.variants.size(); ++i) {
            if (repeats[i].size() < repeat) continue;  // left out in the first turn
            try {
                repeats[i].push_back(runOnce(runs, runs.variants[i], protocol.warmup));
            } catch (const Error& reason) {
                const bool missing = dynamic_cast<const NotAvailable*>(&reason) != nullptr ||
                                     dynamic_cast<const DeviceError*>(&reason) != nullptr;
                if (!missing) throw;
                std::cerr << runs.scene << ", " << specOf(runs.variants[i].partitioner)
                          << ": left out: " << reason.what() << '\n';
            }
        }
    }
    std::vector<Measurement> results;
    for (auto& ofVariant : repeats) {
        if (!ofVariant.empty()) results.push_back(combine(std::move(ofVariant)));
    }
    return results;
}

}  // namespace quadrille::bench
