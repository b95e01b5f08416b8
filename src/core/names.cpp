#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

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
     "for many bodies a device, or threads where there is more than one core"},
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

char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The Damerau-Levenshtein distance (of optimal string alignment), case aside.
std::size_t editDistance(std::string_view a, std::string_view b) {
    const auto same = [&](std::size_t i, std::size_t j) {
        return lowerCase(a[i]) == lowerCase(b[j]);
    };
    // Of the beginnings of `a` of the lengths i - 2, i - 1 and i, to each beginning of `b`.
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (same(i - 1, j - 1) ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
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

std::vector<std::string> nearestNames(std::string_view typed, std::span<const std::string> names) {
    std::vector<std::string> nearest;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const std::string& name : names) {
        const std::size_t longer = std::max(typed.size(), name.size());
        const std::size_t most = longer / 3;
        // Which they differ by at least, and what is typed may be very long.
        if (longer - std::min(typed.size(), name.size()) > most) continue;
        const std::size_t errors = editDistance(typed, name);
        if (errors > most || errors > fewest) continue;
        if (errors < fewest) nearest.clear();
        fewest = errors;
        nearest.push_back(name);
    }
    return nearest;
}

std::string didYouMean(std::span<const std::string> nearest) {
    std::string text;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        text += i == 0 ? "; did you mean '" : i + 1 < nearest.size() ? ", '" : " or '";
        text += nearest[i] + "'";
    }
    return text.empty() ? text : text + "?";
}

}  // namespace quadrille
