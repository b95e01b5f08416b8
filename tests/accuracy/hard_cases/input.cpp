// Input that no law can run.

#include <limits>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

/// The error's text, "" if there is none.
template <class Function>
std::string errorOf(Function&& function) {
    try {
        function();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// Impossible bodies are refused by entity and value, impossible settings by name, with every law.
Outcome impossibleInput(const Setup& setup) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Bad {
        Body body;
        std::string word;
    };
    std::vector<Bad> bad;
    for (const double value : {nan, infinity, -infinity}) {
        bad.push_back({{{value, 0}}, "position"});
        bad.push_back({{{0, value}}, "position"});
        bad.push_back({{{0, 0}, {value, 0}}, "velocity"});
        bad.push_back({{{0, 0}, {0, value}}, "velocity"});
        bad.push_back({{{0, 0}, {0, 0}, {value, 1}}, "size"});
    }
    for (const double value : {nan, infinity, 0.0, -1.0}) {
        bad.push_back({{{0, 0}, {0, 0}, {1, value}}, "size"});
        bad.push_back({{{0, 0}, {0, 0}, {1, 1}, value}, "mass"});
    }
    if (!setup.isDouble()) {
        // What a float cannot hold.
        bad.push_back({{{1e39, 0}}, "position"});
        bad.push_back({{{0, 0}, {0, 1e39}}, "velocity"});
        bad.push_back({{{0, 0}, {0, 0}, {1e39, 1}}, "size"});
        bad.push_back({{{0, 0}, {0, 0}, {1, 1}, 1e39}, "mass"});
    }
    for (const Bad& b : bad) {
        const std::string error = errorOf([&] { simulate(setup, {{{9, 9}}, b.body}); });
        if (error.find("entity 1: " + b.word) == std::string::npos) {
            return {error.empty() ? "takes it" : "does not name it", b.word + ": " + error};
        }
    }
    for (const double value : {nan, infinity, 0.0, -1.0}) {
        const std::string error = errorOf([&] { simulate(setup, {}, {.step = {.dt = value}}); });
        if (error.find("dt") == std::string::npos) return {"takes it", "dt: " + error};
    }
    for (const double value : {nan, infinity}) {
        const std::string error = errorOf([&] {
            simulate(setup, {}, {.step = {.gravity = {0, value}}});
        });
        if (error.find("gravity") == std::string::npos) return {"takes it", "gravity: " + error};
    }
    for (const double value : {nan, -0.1, 1.1}) {
        const std::string error =
            errorOf([&] { simulate(setup, {}, {.step = {.restitution = value}}); });
        if (error.find("restitution") == std::string::npos) {
            return {"takes it", "restitution: " + error};
        }
    }
    return {"exact", {}};
}

/// A body that outruns the numbers ends the run with its name.
Outcome overflow(const Setup& setup) {
    const double far = setup.rounding(1e308, 1e38);
    Simulation sim = simulate(setup, {{{0, 0}}, {{far, 0}, {far, 0}}}, {.step = {.dt = 1}});
    const std::string error = errorOf([&] { sim.run(10); });
    return exactIf(error.find("entity 1") != std::string::npos,
                   error.empty() ? "goes on" : "does not name it", error);
}

}  // namespace

std::vector<HardCase> inputCases() {
    return {{"ImpossibleInput", "NaN, infinity, zero or negative size or mass: named error",
             impossibleInput, "exact", "exact", "exact"},
            {"Overflow", "position beyond the largest number: named error", overflow, "exact",
             "exact", "exact"}};
}

}  // namespace quadrille::accuracy
