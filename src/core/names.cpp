#include <array>

#include <quadrille/names.hpp>

namespace quadrille {

namespace {

constexpr std::array<Named<Law>, 3> lawTable = {{
    {Law::Baseline, "baseline", "the report's law, to measure against"},
    {Law::Impulse, "impulse",
     "discrete: pairs that overlap at the end of a step; for speed, with errors"},
    {Law::Continuous, "continuous",
     "exact, the default: all events of a step in the order of time"},
}};

constexpr std::array<Named<ResolverKind>, 5> resolverTable = {{
    {ResolverKind::Auto, "auto",
     "cuda or threads for many bodies, where there is a device or more than one core"},
    {ResolverKind::Sequential, "sequential", "one core"},
    {ResolverKind::Threads, "threads", "all cores"},
    {ResolverKind::Cuda, "cuda", "contacts on a CUDA device, cells on the host"},
    {ResolverKind::CudaResident, "cuda-resident",
     "bodies, cells and contacts on a CUDA device, of which the host has what is read"},
}};

constexpr std::array<Named<Precision>, 2> precisionTable = {{
    {Precision::Double, "double", "64 bits"},
    {Precision::Float, "float", "32 bits"},
}};

/// In the order of the alternatives of PartitionerConfig.
const std::array<Named<PartitionerConfig>, 4> partitionerTable = {{
    {BruteForce{}, "brute-force", "one cell: the oracle"},
    {StaticGrid{}, "static-grid", "equal cells"},
    {Quadtree{}, "quadtree", "a tree that is built anew each step"},
    {SemiStaticQuadtree{}, "semi-static-quadtree", "a tree that is kept for several steps"},
}};

constexpr std::array<std::string_view, phaseCount> phaseTable = {
    "integrate", "partition", "flatten", "copy_to_device", "resolve", "copy_to_host", "observe"};

template <class Kind, std::size_t N>
std::string_view nameIn(const std::array<Named<Kind>, N>& table, Kind kind) {
    for (const Named<Kind>& named : table) {
        if (named.kind == kind) return named.name;
    }
    return "";
}

}  // namespace

std::span<const Named<Law>> laws() { return lawTable; }
std::span<const Named<ResolverKind>> resolvers() { return resolverTable; }
std::span<const Named<Precision>> precisions() { return precisionTable; }
std::span<const Named<PartitionerConfig>> partitioners() { return partitionerTable; }

std::string_view name(Law law) { return nameIn(lawTable, law); }
std::string_view name(ResolverKind resolver) { return nameIn(resolverTable, resolver); }
std::string_view name(Precision precision) { return nameIn(precisionTable, precision); }
std::string_view name(const PartitionerConfig& config) {
    return partitionerTable[config.index()].name;
}
std::string_view name(Phase phase) { return phaseTable[static_cast<std::size_t>(phase)]; }

}  // namespace quadrille
