// Whether runs end in the states, and go on to the snapshots, that tests/data has: for machines and
// compilers that have no test framework, by scripts/test-architectures.
//
//   quadrille_same_bits SOURCE_FOLDER [RESOLVER...]
//
// What differs is said, and the exit code is 1 then.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "pinned_hashes.hpp"

namespace {

using namespace quadrille;
namespace fs = std::filesystem;

/// Throws if something differs.
struct Case {
    std::string name;
    std::function<void()> check;
};

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string hashOf(const World& world) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(stateHash(world)));
    return text;
}

SimulationConfig configOf(Law law, Precision precision, ResolverKind resolver,
                          const StepSettings& step) {
    return {.partitioner = SemiStaticQuadtree{},
            .law = law,
            .precision = precision,
            .resolver = resolver,
            .threads = 2,
            .step = step};
}

std::vector<Case> runs(const fs::path& source, const std::vector<ResolverKind>& chosen) {
    std::vector<Case> cases;
    for (const PinnedHash& p : pinnedHashes(source / "tests/data/pinned_hashes.csv")) {
        for (const ResolverKind resolver : chosen) {
            if (p.law == Law::Baseline && resolver != ResolverKind::Sequential) continue;
            std::ostringstream what;
            what << p << ", " << name(resolver);
            cases.push_back({what.str(), [=] {
                                 Scene start = loadScene(source / "scenes" / (p.scene + ".toml"));
                                 Simulation sim(std::move(start.world),
                                                configOf(p.law, p.precision, resolver, start.step));
                                 sim.run(p.frames);
                                 const std::string hash = hashOf(sim.world());
                                 if (hash != p.hash) throw std::runtime_error("ends in " + hash);
                             }});
        }
    }
    return cases;
}

void goOn(const fs::path& before, const fs::path& after) {
    Snapshot snapshot = loadSnapshot(before);
    const std::string scene = snapshot.scene;
    const std::uint64_t seed = snapshot.seed;
    const Precision precision = snapshot.world.precision();
    Simulation sim(std::move(snapshot.world),
                   configOf(snapshot.law, precision, ResolverKind::Sequential, snapshot.step));
    sim.resumeAt(snapshot.stepsDone);
    sim.run(30);
    const fs::path written = fs::temp_directory_path() / ("quadrille-" + std::to_string(getpid()) +
                                                          "-" + after.filename().string());
    saveSnapshot(written, sim, scene, seed);
    const std::string bytes = contentOf(written);
    fs::remove(written);
    if (bytes != contentOf(after)) {
        throw std::runtime_error("does not go on to " + after.filename().string());
    }
}

/// A run of 30 steps, and the same after 60.
std::vector<Case> storedSnapshots(const fs::path& source) {
    static const std::string end = "-30.snapshot";
    std::vector<Case> cases;
    for (const auto& entry : fs::directory_iterator(source / "tests/data/snapshots")) {
        const fs::path before = entry.path();
        const std::string name = before.filename().string();
        if (!name.ends_with(end)) continue;
        const fs::path after =
            before.parent_path() / (name.substr(0, name.size() - end.size()) + "-60.snapshot");
        cases.push_back({name, [=] { goOn(before, after); }});
    }
    return cases;
}

/// As many at once as there are cores. Returns how many differ.
int check(const std::vector<Case>& cases) {
    std::atomic<std::size_t> next{0};
    std::atomic<int> different{0};
    std::mutex speaking;
    const auto work = [&] {
        for (std::size_t i = next++; i < cases.size(); i = next++) {
            try {
                cases[i].check();
            } catch (const std::exception& error) {
                ++different;
                const std::lock_guard lock(speaking);
                std::cerr << cases[i].name << ": " << error.what() << '\n';
            }
        }
    };
    std::vector<std::jthread> workers;
    for (int i = 0; i < Simulation::cores(); ++i) workers.emplace_back(work);
    workers.clear();
    return different;
}

int run(int argc, char** argv) {
    if (argc < 2) throw std::invalid_argument("usage: see tests/architectures/same_bits.cpp");
    std::vector<ResolverKind> chosen;
    for (int i = 2; i < argc; ++i) {
        const auto kind = find(resolvers(), argv[i]);
        if (!kind) throw std::invalid_argument("unknown resolver " + std::string(argv[i]));
        chosen.push_back(*kind);
    }
    if (chosen.empty()) chosen = {ResolverKind::Sequential, ResolverKind::Threads};
    const auto hashes = runs(argv[1], chosen);
    const auto snapshots = storedSnapshots(argv[1]);
    if (hashes.empty() || snapshots.empty()) throw std::invalid_argument("nothing to compare with");
    const int different = check(hashes) + check(snapshots);
    std::cout << hashes.size() << " runs, " << snapshots.size() << " snapshots: " << different
              << " differ\n";
    return different == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}
