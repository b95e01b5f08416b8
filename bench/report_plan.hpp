#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/simulation.hpp>

namespace quadrille::bench {

/// A scene of the report on speed and error.
struct ReportScene {
    std::string name;  ///< in tables and figures
    std::string file;  ///< as openScene takes it
    std::optional<std::uint64_t> entities;
    int errorFrames = 0;   ///< of 1/60 s, about two collisions a body; 0: has no exact answer
    int speedFrames = 30;  ///< of 1/60 s
};

/// What the report runs.
struct ReportPlan {
    std::vector<ReportScene> scenes;
    std::vector<int> rates{60, 120, 240, 480, 960};  ///< steps per simulated second
    int coarseRate = 16;                             ///< of the law `continuous`, in addition
    std::vector<Precision> precisions{Precision::Double, Precision::Float};
    std::vector<std::string> partitioners{"static-grid:26x26", "quadtree:10/20",
                                          "semi-static-quadtree:10/20/skin"};
    std::vector<int> policies{2, 5, 10, 20, 50};  ///< rebuild every so many steps
    std::size_t repeats = 3;
    std::size_t policyFrames = 200;
    std::size_t featureBodies = 20'000;
    std::size_t featureFrames = 200;
    std::size_t featureRepeats = 7;  ///< differences are small
};

/// Under 25 minutes on two cores.
ReportPlan fullReport();

/// Every part of the report in under two minutes, with numbers that say little.
ReportPlan quickReport();

inline constexpr Law allLaws[] = {Law::Baseline, Law::Impulse, Law::Continuous};

}  // namespace quadrille::bench
