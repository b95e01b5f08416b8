#include "app/memory_need.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <variant>

#include <quadrille/error.hpp>

#include "system/memory.hpp"

namespace quadrille::app {

namespace {

/// Bytes a moving body, as measured with `balanced-scaled` between 40,000 and 800,000 bodies in
/// double precision.
struct BytesPerBody {
    double discrete, continuous, threads;  ///< by law, and what threads add to either
};

BytesPerBody measured(const PartitionerConfig& partitioner) {
    if (std::holds_alternative<BruteForce>(partitioner)) return {185, 255, 10};
    if (std::holds_alternative<StaticGrid>(partitioner)) return {105, 170, 10};
    if (std::holds_alternative<Quadtree>(partitioner)) return {120, 190, 25};
    return {170, 195, 50};
}

/// What a run keeps to end soon after a signal (RunSession): a copy of the bodies, with their
/// anchors under `continuous`.
constexpr double ofCheckpoint = 45, ofAnchors = 70;

constexpr double ofFloat = 0.87;  ///< as a part of what doubles take
constexpr double ofColors = 20;
constexpr double ofReference = 920;  ///< what --error keeps
constexpr std::uint64_t ofProgram = 16'000'000;

}  // namespace

std::uint64_t memoryNeed(const SimulationConfig& config, std::uint64_t movingBodies, bool colors) {
    const BytesPerBody table = measured(config.partitioner);
    const bool exact = config.law == Law::Continuous;
    double bytes = (exact ? table.continuous + ofAnchors : table.discrete) + ofCheckpoint;
    if (config.resolver != ResolverKind::Sequential) bytes += table.threads;
    if (config.precision == Precision::Float) bytes *= ofFloat;
    if (colors) bytes += ofColors;
    // A count that no machine holds must not wrap.
    return static_cast<std::uint64_t>(std::min(bytes * double(movingBodies), 1e19));
}

namespace {

/// Of a run and of the one beside it, without the program itself.
double needOf(const Options& options, std::uint64_t movingBodies, Law law, Precision precision) {
    SimulationConfig config;
    config.partitioner = options.partitioner;
    config.law = options.law.value_or(law);
    config.precision = options.precision.value_or(precision);
    config.resolver = options.resolver;
    double need = double(memoryNeed(config, movingBodies, !options.headless));
    if (options.error) need += ofReference * double(movingBodies);
    if (options.beside) need += needOf(*options.beside, movingBodies, law, precision);
    return need;
}

}  // namespace

template <class Wrong>
void requireMemory(const Options& options, const std::string& file, std::uint64_t movingBodies,
                   Law law, Precision precision) {
    if (options.forceMemory) return;
    const double need = needOf(options, movingBodies, law, precision) + double(ofProgram);
    const std::uint64_t there = memoryOfMachine();
    if (need <= double(there)) return;
    const auto wanted = static_cast<std::uint64_t>(std::min(need, 1e19));
    throw Wrong(file + ": " + std::to_string(movingBodies) + " bodies need about " +
                std::to_string(wanted) + " bytes of memory (" + inUnits(wanted) +
                "), and there are " + std::to_string(there) + " (" + inUnits(there) +
                "); --force-memory tries it nevertheless");
}

template void requireMemory<SceneError>(const Options&, const std::string&, std::uint64_t, Law,
                                        Precision);
template void requireMemory<SnapshotError>(const Options&, const std::string&, std::uint64_t, Law,
                                           Precision);

std::string inUnits(std::uint64_t bytes) {
    constexpr std::array<const char*, 6> units = {"kB", "MB", "GB", "TB", "PB", "EB"};
    double value = double(bytes) / 1e3;
    std::size_t unit = 0;
    for (; value >= 1e3 && unit + 1 < units.size(); ++unit) value /= 1e3;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g %s", value, units[unit]);
    return text.data();
}

}  // namespace quadrille::app
