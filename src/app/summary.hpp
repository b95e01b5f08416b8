#pragma once

#include <cstdint>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include <quadrille/quadrille.hpp>

#include "app/run_setup.hpp"
#include "app/run_statistics.hpp"

namespace quadrille::app {

/// Energy and momentum of a state.
struct Conserved {
    double kinetic = 0;
    double total = 0;  ///< kinetic and potential
    Vec2 momentum{0, 0};

    static Conserved of(const Simulation& simulation);
};

/// Names as the summary has them, with the phases of a step first and those of showing it after.
std::string_view phaseName(std::size_t phase);

/// end / start - 1, or 0 if both are 0.
double relativeDrift(double start, double end);

/// The summary of a run, as docs/outputs.md lists it.
nlohmann::ordered_json summaryJson(const Run& run, const RunStatistics& statistics,
                                   const Conserved& start);

/// The same for a person.
void printSummary(std::ostream& out, const nlohmann::ordered_json& summary);

}  // namespace quadrille::app
