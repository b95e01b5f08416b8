#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/run_beside.hpp"

namespace quadrille::app {

/// The key `comparison` of a run's summary, as docs/outputs.md lists it. `frame` is the last at
/// which the runs met, or null; `beside` the summary of the other run, or null.
nlohmann::ordered_json comparisonJson(const std::array<std::string, 2>& labels,
                                      const ComparedFrame* frame, nlohmann::ordered_json beside);

/// The same for a person.
void printComparison(std::ostream& out, const nlohmann::ordered_json& comparison);

/// A comparison over time, printed while it runs: with a number of frames some twenty rows evenly,
/// else one after 1, 2, 5, 10, 20 and so on of them; and one at the end.
class ComparisonTable {
  public:
    ComparisonTable(std::ostream& out, std::array<std::string, 2> labels,
                    std::optional<std::uint64_t> frames);

    /// After each comparison; prints it if it is due.
    void add(const ComparedFrame& frame);
    /// Prints the last one if it has not been.
    void finish();

  private:
    void print();

    std::ostream& out_;
    std::array<std::string, 2> labels_;
    std::uint64_t every_;  // frames; 0 for the other rule
    std::uint64_t next_ = 1;
    std::uint64_t meetings_ = 0;            // since the last row
    std::array<double, 2> milliseconds_{};  // of them
    std::optional<ComparedFrame> last_;     // if it has not been printed
    bool headed_ = false;
};

}  // namespace quadrille::app
