#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace quadrille::bench {

/// What the report says (K. Han, J. Zhang, "Parallelizing 2D Collision Detection and Resolution",
/// Carnegie Mellon University, December 2024; figures read off its plots), and what its published
/// program takes on the machine with one H200 and 16 Xeon cores (dt 16 ms, mean of 200 frames after
/// 20), from the project's notes on the report.

inline constexpr std::array<std::size_t, 5> reportCounts = {10, 100, 1'000, 10'000, 50'000};

/// The schemes that the report compares.
enum class ReportScheme : std::size_t {
    GridSequential,
    GridCuda,
    QuadtreeSequential,
    QuadtreeCuda,
    SemiStaticCuda,
};

/// Speed-up over the sequential static grid in the balanced scene; figure 5.
double reportSpeedup(ReportScheme scheme, std::size_t index);

/// Milliseconds a frame of the report's program in the balanced scene, on the machine named above.
double programMilliseconds(ReportScheme scheme, std::size_t index);

/// The same in the imbalanced scene.
double programImbalanced(ReportScheme scheme);

/// Milliseconds a frame over the number of cells, 1,700 bodies; figures 6 (imbalanced) and 7.
struct CellPoint {
    double cells, milliseconds;
};
/// Empty for the schemes without a GPU.
std::vector<CellPoint> reportCellCurve(ReportScheme scheme, bool imbalanced);

/// Where the time goes with 20,000 bodies, semi-static tree, CUDA: percent of the frame in the
/// report's table 2, and milliseconds of its program on the machine named above.
struct ProfileRow {
    std::string_view phase;
    std::optional<double> reportPercent;
    std::optional<double> programMilliseconds;
};
const std::vector<ProfileRow>& reportProfile();
inline constexpr std::uint64_t reportProfileBodies = 20'000;
inline constexpr double programProfileTotal = 3.73;  ///< ms a frame

}  // namespace quadrille::bench
