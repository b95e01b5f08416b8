#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <quadrille/config.hpp>

#include "app/window_options.hpp"

namespace quadrille::app {

/// A combination of options that makes no sense; ends the program with exit code 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The command line, checked.
struct Options {
    std::string scene = "balanced";  ///< openingScene in a window
    std::vector<std::string> set;    ///< what SceneOptions::set takes
    std::optional<std::uint64_t> entities;
    std::optional<std::uint64_t> seed;

    PartitionerConfig partitioner;
    ResolverKind resolver = ResolverKind::Auto;
    std::optional<int> threads;
    bool fallback = true;
    CudaOptions cuda;
    std::optional<Law> law;
    std::optional<Precision> precision;
    std::optional<double> dt;
    std::optional<double> restitution;

    bool headless = false;
    bool list = false;
    bool explain = false;
    bool profile = false;
    bool error = false;
    bool forceMemory = false;
    std::optional<std::uint64_t> frames;
    std::optional<double> duration;  ///< wall s
    double reportEvery = 5;          ///< wall s

    std::string json, csv, dumpState, dumpEvents;  ///< file names, "-" for stdout, or empty
    std::string save, load;
    std::optional<std::uint64_t> saveEvery;  ///< frames

    WindowOptions window;

    /// With --compare, the options of the run beside this one, and what it is called: what tells it
    /// from the other.
    std::shared_ptr<const Options> beside;
    std::string label;
};

/// Either options, or the exit code of a program that has already said what there was to say
/// (--help, --version, --generate, a mistake).
struct ParsedOptions {
    std::optional<Options> options;
    int exitCode = 0;
};

ParsedOptions parseOptions(int argc, const char* const* argv);

}  // namespace quadrille::app
