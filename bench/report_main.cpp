// Speed against error, rebuild policies, and what features cost, as tables in a folder; the figures
// are drawn from them by report_figures.py.

#include <filesystem>
#include <string>

#include <quadrille/error.hpp>

#include "bench/command_line.hpp"
#include "bench/report_parts.hpp"

namespace {

using namespace quadrille;
using namespace quadrille::bench;

struct Options {
    std::string output;
    bool quick = false;
};

void run(const Options& options) {
    const ReportPlan plan = options.quick ? quickReport() : fullReport();
    const std::filesystem::path folder = options.output;
    std::filesystem::create_directories(folder);
    const auto files = [&](const char* part) {
        return TableFiles{.csv = (folder / (std::string(part) + ".csv")).string(),
                          .markdown = (folder / (std::string(part) + ".md")).string()};
    };
    for (const char* part : {"errors", "speeds", "policies", "features"}) {
        checkWritable(files(part));
    }
    const std::string repeats = std::to_string(plan.repeats) + " repeats in turn";
    publish(measureErrors(plan), files("errors"),
            {"answers of the quadtree; all complete partitioners have the same, bit for bit"});
    publish(measureSpeeds(plan), files("speeds"),
            {repeats + ", after a fifth as many steps of warm-up, at least two"});
    publish(measurePolicies(plan), files("policies"),
            {repeats + ", law impulse, double; pairs counted in a run of their own"});
    publish(measureFeatures(plan), files("features"),
            {std::to_string(plan.featureRepeats) + " repeats in turn, 20 steps of warm-up"});
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures speed against error.");
    app.add_option("--output", options.output, "folder for the tables")->required();
    app.add_flag("--quick", options.quick, "small scenes, few steps");
    return quadrille::bench::runCommandLine(app, argc, argv, [&] { run(options); });
}
