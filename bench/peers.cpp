// The same scenes through Quadrille and through other 2D engines, in one process.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/measure.hpp>

#include "bench/command_line.hpp"
#include "bench/memory.hpp"
#include "bench/partitioner_spec.hpp"
#include "bench/peer.hpp"
#include "bench/scene_files.hpp"
#include "bench/statistics.hpp"
#include "bench/table.hpp"

namespace {

using namespace quadrille;
using namespace quadrille::bench;

struct Options {
    std::vector<std::string> scenes{"balanced", "demo13k", "balanced-scaled"};
    std::optional<std::uint64_t> entities;
    std::string partitioner = "semi-static-quadtree";
    std::size_t frames = 200;
    std::size_t warmup = 20;
    std::size_t repeats = 3;
    std::size_t block = 20;
    TableFiles files;
};

void addOptions(CLI::App& app, Options& options) {
    app.add_option("--scenes", options.scenes, "names or files")
        ->capture_default_str()
        ->delimiter(',');
    app.add_option("--entities", options.entities, "count of the first spawn group (the scene's)");
    app.add_option("--partitioner", options.partitioner, "Quadrille's, with parameters")
        ->capture_default_str();
    app.add_option("--frames", options.frames, "timed steps")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--warmup", options.warmup, "steps before them")->capture_default_str();
    app.add_option("--repeat", options.repeats, "runs of each engine")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--block", options.block, "steps before it is the next engine's turn")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.files.csv, "write the table as CSV");
    app.add_option("--markdown", options.files.markdown, "write the table as Markdown");
}

/// The first one is what the others are compared with.
std::vector<PeerKind> peerKinds(const std::string& partitioner) {
    const PartitionerConfig config = parsePartitioner(partitioner);
    std::vector<PeerKind> kinds = {quadrillePeer(config, Law::Impulse, Precision::Double),
                                   quadrillePeer(config, Law::Impulse, Precision::Float),
                                   quadrillePeer(config, Law::Continuous, Precision::Double)};
#if defined(QUADRILLE_HAS_BOX2D)
    kinds.push_back(box2dPeer());
#endif
#if defined(QUADRILLE_HAS_CHIPMUNK)
    for (PeerKind& kind : chipmunkPeers()) kinds.push_back(std::move(kind));
#endif
    return kinds;
}

std::vector<std::string> leftOut() {
    std::vector<std::string> notes;
#if !defined(QUADRILLE_HAS_BOX2D)
    notes.push_back("Box2D is left out: built without it");
#endif
#if !defined(QUADRILLE_HAS_CHIPMUNK)
    notes.push_back("Chipmunk is left out: built without it");
#endif
    return notes;
}

struct PeerResult {
    std::vector<std::vector<double>> milliseconds;  ///< of each step, once a repeat
    std::optional<double> energyDrift;              ///< relative; none where it is not conserved
    double maxOverlap = 0;                          ///< px, over the ends of all turns
    std::optional<double> bytes;
};

/// An engine on its way through a scene.
class Contestant {
  public:
    /// `probe` takes the engine's state whenever it is measured; all engines share it.
    Contestant(const PeerKind& kind, const Scene& scene, World& probe, const Options& options)
        : probe_(probe), step_(scene.step) {
        releaseFreedMemory();
        const auto before = residentBytes();
        peer_ = kind.make(scene);
        readState();
        energyAtStart_ = totalEnergy(probe_, step_.gravity);
        for (std::size_t i = 0; i < options.warmup; ++i) peer_->step();
        const auto after = residentBytes();
        if (before && after) bytes_ = double(*after) - double(*before);
        milliseconds_.reserve(options.frames);
    }

    void run(std::size_t steps) {
        timeSteps<ProcessorClock>(steps, milliseconds_, [&] { peer_->step(); });
        readState();
        maxOverlap_ = std::max(maxOverlap_, overlap(probe_).max);
    }

    /// Adds this run to those of the same engine; how fast it was varies, the rest does not.
    void addTo(PeerResult& result) {
        readState();
        result.milliseconds.push_back(milliseconds_);
        result.maxOverlap = std::max(result.maxOverlap, maxOverlap_);
        if (!result.bytes) result.bytes = bytes_;
        if (step_.restitution == 1 && energyAtStart_ != 0) {
            const double gain = totalEnergy(probe_, step_.gravity) - energyAtStart_;
            result.energyDrift = gain / std::abs(energyAtStart_);
        }
    }

  private:
    void readState() {
        probe_.editBodies([&]<class Real>(const MutableBodyView<Real>& bodies) {
            if constexpr (std::is_same_v<Real, double>) peer_->read(bodies.moving);
        });
    }

    World& probe_;
    StepSettings step_;
    std::unique_ptr<Peer> peer_;
    double energyAtStart_ = 0;
    double maxOverlap_ = 0;
    std::optional<double> bytes_;
    std::vector<double> milliseconds_;
};

void addRow(Table& table, const Scene& scene, const PeerKind& kind, const PeerResult& result,
            const FrameTimes& ours) {
    const FrameTimes times = summarize(result.milliseconds);
    const double bodies = double(scene.world.movingCount());
    const std::string none(noValue);
    table.add({scene.name, std::to_string(scene.world.movingCount()), kind.name, number(times.mean),
               number(times.median), number(times.p99), number(1e6 * times.mean / bodies),
               number(1e6 * times.median / bodies), number(times.mean / ours.mean),
               number(times.median / ours.median),
               result.energyDrift ? number(*result.energyDrift) : none, number(result.maxOverlap),
               result.bytes ? number(*result.bytes / bodies) : none, kind.settings});
}

void compare(const std::string& sceneName, const Options& options, Table& table) {
    const Scene scene = openScene(sceneName, options.entities);
    World probe = openScene(sceneName, options.entities).world;

    const std::vector<PeerKind> kinds = peerKinds(options.partitioner);
    std::vector<PeerResult> results(kinds.size());
    for (std::size_t repeat = 0; repeat < options.repeats; ++repeat) {
        std::vector<Contestant> contestants;
        contestants.reserve(kinds.size());
        for (const PeerKind& kind : kinds) contestants.emplace_back(kind, scene, probe, options);
        for (std::size_t done = 0; done < options.frames; done += options.block) {
            const std::size_t steps = std::min(options.block, options.frames - done);
            for (Contestant& contestant : contestants) contestant.run(steps);
        }
        for (std::size_t i = 0; i < kinds.size(); ++i) contestants[i].addTo(results[i]);
    }
    const FrameTimes ours = summarize(results.front().milliseconds);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        addRow(table, scene, kinds[i], results[i], ours);
    }
}

void run(const Options& options) {
    checkWritable(options.files);
    Table table({"scene", "bodies", "engine", "mean_ms", "median_ms", "p99_ms", "ns_per_body_step",
                 "ns_per_body_step_median", "ratio", "ratio_median", "energy_drift", "max_overlap",
                 "bytes_per_body", "settings"});
    for (const std::string& scene : options.scenes) {
        std::cerr << "running " << scene << '\n';
        compare(scene, options, table);
    }
    std::vector<std::string> notes = leftOut();
    notes.push_back(std::to_string(options.repeats) + " repeats of " +
                    std::to_string(options.frames) + " steps after " +
                    std::to_string(options.warmup) + ", in turns of " +
                    std::to_string(options.block));
    publish(table, options.files, notes);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Runs the same scenes through Quadrille and other 2D engines.");
    addOptions(app, options);
    return quadrille::bench::runCommandLine(app, argc, argv, [&] { run(options); });
}
