// A snapshot. Its checksum is made to fit, so that what is in it is what is looked at.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "core/snapshot_stream.hpp"
#include "core/support.hpp"
#include "fuzz/input.hpp"
#include "fuzz/short_run.hpp"

namespace quadrille::fuzz {

namespace {

std::string sealed(std::string_view input) {
    std::string bytes(
        input.substr(0, input.size() - std::min(input.size(), sizeof(std::uint64_t))));
    Checksum checksum;
    checksum.add(bytes.data(), bytes.size());
    std::uint64_t sum = checksum.value();
    toFileOrder(sum);
    return bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

std::optional<Snapshot> load(const std::filesystem::path& file) {
    try {
        return loadSnapshot(file);
    } catch (const SnapshotError&) {
        return std::nullopt;
    }
}

void expectSame(const Simulation& sim, const std::filesystem::path& file) {
    saveSnapshot(file, sim, "", 1);
    try {
        if (stateHash(loadSnapshot(file).world) != stateHash(sim.world())) {
            throw Finding("other bodies come back");
        }
    } catch (const SnapshotError& error) {
        throw Finding(std::string("what was saved is refused: ") + error.what());
    }
}

}  // namespace

bool tryInput(std::string_view input) {
    static const TemporaryFolder folder;
    std::optional<Snapshot> snapshot = load(folder.write("input", sealed(input)));
    if (!snapshot) return false;
    const Precision precision = snapshot->world.precision();
    Simulation sim(std::move(snapshot->world), {.law = snapshot->law,
                                                .precision = precision,
                                                .resolver = ResolverKind::Sequential,
                                                .step = snapshot->step});
    sim.resumeAt(snapshot->stepsDone);
    expectSame(sim, folder.path() / "before");
    if (isShort(sim) && runs(sim) && sim.world().validate().empty())
        expectSame(sim, folder.path() / "after");
    return true;
}

}  // namespace quadrille::fuzz
