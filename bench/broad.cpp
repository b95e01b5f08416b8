// Broad phases on the same boxes, by the method of Broadmark (Serpa and Rodrigues 2019): the boxes
// of a run are written once, and each algorithm reads them in a process of its own. bench/peers
// starts them.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/simulation.hpp>

#include "bench/broad_phase.hpp"
#include "bench/command_line.hpp"
#include "bench/machine.hpp"
#include "bench/scene_files.hpp"
#include "bench/statistics.hpp"

namespace {

using namespace quadrille;
using namespace quadrille::bench;
using Json = nlohmann::json;

struct Options {
    std::string scene = "demo13k", file, algorithm;
    std::optional<std::uint64_t> entities;
    std::size_t warmup = 60, frames = 20;
};

std::vector<BroadPhaseKind> allKinds() {
    std::vector<BroadPhaseKind> kinds = ownBroadPhases();
    for (auto& kind : plainBroadPhases()) kinds.push_back(std::move(kind));
#if defined(QUADRILLE_HAS_CGAL)
    kinds.push_back(cgalBroadPhase());
#endif
#if defined(QUADRILLE_HAS_BOOST)
    kinds.push_back(boostBroadPhase());
#endif
    return kinds;
}

double rounded(double px) { return std::nearbyint(px * 1024) / 1024; }

/// All bodies, with the boxes at places and of sizes that are whole multiples.
Boxes boxesOf(const World& world) {
    Boxes boxes;
    world.visitBodies([&](const auto& bodies) {
        boxes.moving = bodies.moving.size();
        const auto add = [&](const auto& rows) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                boxes.x.push_back(rounded(rows.x[i]));
                boxes.y.push_back(rounded(rows.y[i]));
                boxes.halfWidth.push_back(rounded(rows.halfWidth[i]));
                boxes.halfHeight.push_back(rounded(rows.halfHeight[i]));
            }
        };
        add(bodies.moving);
        add(bodies.fixed);
        boxes.vx.assign(bodies.moving.vx.begin(), bodies.moving.vx.end());
        boxes.vy.assign(bodies.moving.vy.begin(), bodies.moving.vy.end());
    });
    return boxes;
}

/// Every column of a frame, in the order of the file.
template <class B, class Visit>
void eachColumn(B& boxes, Visit&& visit) {
    for (auto* column :
         {&boxes.x, &boxes.y, &boxes.halfWidth, &boxes.halfHeight, &boxes.vx, &boxes.vy}) {
        visit(*column);
    }
}

/// The boxes of the frames after the warm-up, under `impulse`, and beside them what other engines
/// need to run the scene from its start.
void dump(const Options& options) {
    Scene scene = openScene(options.scene, options.entities);
    std::ofstream out(options.file, std::ios::binary);
    const auto write = [&](const auto& values) {
        out.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(values[0])));
    };
    Json bodies = Json::array();
    scene.world.visitBodies([&](const auto& all) {
        const auto& f = all.fixed;
        for (std::size_t i = 0; i < f.size(); ++i) {
            bodies.push_back({0, f.x[i], f.y[i], f.halfWidth[i], f.halfHeight[i], 0, 0, 0});
        }
        const auto& m = all.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            bodies.push_back(
                {1, m.x[i], m.y[i], m.halfWidth[i], m.halfHeight[i], m.vx[i], m.vy[i], m.mass[i]});
        }
    });
    Json machine = Json::array();
    for (const auto& [name, value] : describeMachine()) machine.push_back(name + ": " + value);
    std::ofstream(options.file + ".json")
        << Json{{"scene", options.scene},
                {"dt", scene.step.dt},
                {"gravity", {scene.step.gravity.x(), scene.step.gravity.y()}},
                {"restitution", scene.step.restitution},
                {"columns", {"moves", "x", "y", "half_width", "half_height", "vx", "vy", "mass"}},
                {"bodies", bodies},
                {"machine", machine}};
    const Vec2 size = scene.world.config().size;
    write(std::array<double, 3>{size.x(), size.y(), scene.step.dt});
    Simulation simulation(std::move(scene.world), {.law = Law::Impulse, .step = scene.step});
    simulation.run(options.warmup);
    for (std::size_t i = 0; i < options.frames; ++i) {
        simulation.step();
        const Boxes boxes = boxesOf(simulation.world());
        write(std::array<std::uint64_t, 2>{boxes.moving, boxes.size()});
        eachColumn(boxes, write);
    }
    if (!out.flush()) throw Error("could not write " + options.file);
}

std::pair<Setting, std::vector<Boxes>> readFrames(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<double, 3> head{};
    in.read(reinterpret_cast<char*>(head.data()), sizeof head);
    std::vector<Boxes> frames;
    for (std::array<std::uint64_t, 2> counts{};
         in.read(reinterpret_cast<char*>(counts.data()), sizeof counts);) {
        Boxes boxes;
        boxes.moving = counts[0];
        eachColumn(boxes, [&](std::vector<double>& column) {
            const bool velocity = &column == &boxes.vx || &column == &boxes.vy;
            column.resize(velocity ? counts[0] : counts[1]);
            in.read(reinterpret_cast<char*>(column.data()),
                    static_cast<std::streamsize>(column.size() * sizeof(double)));
        });
        if (!in) throw Error(file + " ends within a frame");
        frames.push_back(std::move(boxes));
    }
    if (frames.empty()) throw Error("no boxes in " + file);
    return {Setting{{head[0], head[1]}, head[2]}, std::move(frames)};
}

/// The same for any order of the pairs and within them.
std::uint64_t checksum(const Pairs& pairs) {
    std::uint64_t sum = 0;
    for (const auto& [a, b] : pairs) {
        std::uint64_t hash = (std::uint64_t(std::min(a, b)) << 32) + std::max(a, b);
        hash = (hash ^ (hash >> 31)) * 0x9e3779b97f4a7c15u;
        sum += hash ^ (hash >> 29);
    }
    return sum;
}

void run(const Options& options) {
    const auto kinds = allKinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](const auto& k) { return k.name == options.algorithm; });
    if (kind == kinds.end()) throw Error("no algorithm '" + options.algorithm + "'; see `list`");
    const auto [setting, frames] = readFrames(options.file);
    const auto algorithm = kind->make(setting, frames.front());
    Pairs pairs;
    std::uint64_t count = 0, sum = 0;
    std::vector<double> milliseconds;
    for (const Boxes& boxes : frames) {
        algorithm->prepare(boxes);
        pairs.clear();
        timeSteps<ProcessorClock>(1, milliseconds, [&] { algorithm->find(boxes, pairs); });
        count += pairs.size();
        sum += checksum(pairs);
    }
    std::cout << Json{{"pairs", count}, {"checksum", sum}, {"milliseconds", milliseconds}} << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Runs broad phases on boxes that were written once.");
    app.require_subcommand(1);
    auto* list = app.add_subcommand("list", "The algorithms, a line for each");
    auto* dumping = app.add_subcommand("dump", "Writes the boxes of a run to FILE");
    auto* running = app.add_subcommand("run", "Runs one algorithm on the boxes of FILE");
    for (auto* command : {dumping, running}) {
        command->add_option("file", options.file, "the boxes")->required()->type_name("FILE");
    }
    dumping->add_option("--scene", options.scene, "name or file")->capture_default_str();
    dumping->add_option("--entities", options.entities, "count of the first spawn group");
    dumping->add_option("--warmup", options.warmup, "steps before")->capture_default_str();
    dumping->add_option("--frames", options.frames, "steps whose boxes are written")
        ->capture_default_str();
    running->add_option("--algorithm", options.algorithm, "as `list` has it")->required();
    return runCommandLine(app, argc, argv, [&] {
        if (*list) {
            for (const auto& kind : allKinds()) std::cout << kind.name << '\n';
        }
        if (*dumping) dump(options);
        if (*running) run(options);
    });
}
