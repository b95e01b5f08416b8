#include "bench/published_figures.hpp"

namespace quadrille::bench {

namespace {

constexpr std::size_t schemes = 5;
using Row = std::array<double, reportCounts.size()>;

constexpr std::array<Row, schemes> speedups = {{
    {1, 1, 1, 1, 1},
    {0.69, 0.71, 0.75, 1.32, 3.55},
    {46.90, 6.39, 0.73, 0.55, 1.37},
    {1.83, 1.86, 0.84, 0.99, 2.45},
    {1.57, 1.24, 1.11, 1.90, 4.18},
}};

constexpr std::array<Row, schemes> balancedMilliseconds = {{
    {0.047, 0.059, 0.164, 1.91, 23.9},
    {0.120, 0.229, 0.365, 2.06, 9.70},
    {0.005, 0.062, 0.444, 4.00, 28.4},
    {0.111, 0.154, 0.329, 2.82, 13.5},
    {0.156, 0.158, 0.352, 2.42, 10.4},
}};

constexpr std::array<double, schemes> imbalancedMilliseconds = {2.29, 1.41, 1.10, 0.72, 0.50};

}  // namespace

double reportSpeedup(ReportScheme scheme, std::size_t index) {
    return speedups[static_cast<std::size_t>(scheme)][index];
}

double programMilliseconds(ReportScheme scheme, std::size_t index) {
    return balancedMilliseconds[static_cast<std::size_t>(scheme)][index];
}

double programImbalanced(ReportScheme scheme) {
    return imbalancedMilliseconds[static_cast<std::size_t>(scheme)];
}

std::vector<CellPoint> reportCellCurve(ReportScheme scheme, bool imbalanced) {
    switch (scheme) {
        case ReportScheme::GridCuda:
            if (imbalanced) {
                return {{16, 384.62}, {60, 79.37},  {260, 24.51}, {390, 32.89},
                        {920, 3.87},  {1400, 3.03}, {2300, 2.07}};
            }
            return {{60, 1.34}, {265, 1.00}, {390, 1.06}, {920, 1.07}, {1400, 1.16}};
        case ReportScheme::QuadtreeCuda:
            if (imbalanced) {
                return {{150, 2.04}, {180, 1.51},  {480, 1.43},  {640, 1.57},
                        {800, 1.52}, {1260, 1.72}, {1770, 1.87}, {2300, 2.35}};
            }
            return {{130, 1.14}, {270, 1.10}, {340, 1.04}, {750, 0.88}, {1180, 0.88}};
        case ReportScheme::SemiStaticCuda:
            if (imbalanced) {
                return {{110, 2.91},  {410, 1.03},  {610, 0.97}, {730, 0.95},
                        {1190, 1.00}, {1750, 1.05}, {2300, 1.06}};
            }
            return {{85, 1.12}, {265, 0.94}, {405, 0.87}, {810, 0.86}, {1110, 0.86}};
        default:
            return {};
    }
}

const std::vector<ProfileRow>& reportProfile() {
    static const std::vector<ProfileRow> rows = {
        {"integrate", {}, {}},    {"partition", {}, 0.28},
        {"flatten", 29.75, 0.85}, {"copy_to_device", 8.19, 0.33},
        {"resolve", 14.35, 0.06}, {"copy_to_host", {}, 0.69},
        {"observe", {}, {}},
    };
    return rows;
}

}  // namespace quadrille::bench
