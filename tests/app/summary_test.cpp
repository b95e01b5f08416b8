#include <array>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "program.hpp"

namespace quadrille {
namespace {

class Summary : public ProgramTest {};

std::string hexadecimal(std::uint64_t value) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
    return text.data();
}

std::vector<std::string> linesWith(const std::string& text, const std::string& part) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (contains(line, part)) lines.push_back(line);
    }
    return lines;
}

TEST_F(Summary, GoesToStdoutAndNothingToStderr) {
    const ProcessResult result =
        runProgram({"--headless", "--scene", "imbalanced", "--frames", "20", "--entities", "100"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    for (const char* text :
         {"summary", "imbalanced", "1600 moving", "8 static", "20 frames", "continuous", "double",
          "semi-static-quadtree", "sequential", "mean", "median", "p99", "contacts", "collisions",
          "kinetic energy", "drift", "state hash"}) {
        EXPECT_TRUE(contains(result.out, text)) << text;
    }
}

TEST_F(Summary, JsonHasTheKeysOfTheContract) {
    const Json s = summaryOf({"--scene", "imbalanced", "--frames", "20", "--entities", "100"});
    for (const char* key : {"scene", "law", "precision", "partitioner", "resolver",
                            "requested_resolver", "state_hash", "version", "commit"}) {
        EXPECT_TRUE(s.contains(key) && s[key].is_string()) << key;
    }
    for (const char* key :
         {"seed", "entities", "frames", "threads", "cells", "active_cells", "max_bodies_per_cell",
          "pairs_tested", "contacts", "collisions", "rebuilds", "escaped"}) {
        EXPECT_TRUE(s.contains(key) && s[key].is_number_unsigned()) << key;
    }
    for (const char* key : {"dt", "max_overlap"}) {
        EXPECT_TRUE(s.contains(key) && s[key].is_number()) << key;
    }
    for (const char* key : {"device", "phases_ms", "missed_pairs"}) {
        EXPECT_TRUE(s.contains(key)) << key;
    }
    for (const char* key : {"mean", "median", "p99"}) {
        EXPECT_TRUE(s["ms_per_frame"][key].is_number()) << key;
    }
    for (const char* key : {"start", "end", "relative_drift"}) {
        EXPECT_TRUE(s["kinetic_energy"][key].is_number()) << key;
    }
    for (const char* key : {"start", "end"}) {
        ASSERT_EQ(s["momentum"][key].size(), 2u) << key;
        EXPECT_TRUE(s["momentum"][key][0].is_number() && s["momentum"][key][1].is_number());
    }
}

TEST_F(Summary, JsonSaysWhatWasAskedFor) {
    const Json s = summaryOf({"--scene", "imbalanced", "--frames", "20", "--entities", "100",
                              "--seed", "7", "--dt", "0.005", "--restitution", "0.5", "--precision",
                              "float", "--partitioner", "quadtree"});
    EXPECT_EQ(s["scene"], "imbalanced");
    EXPECT_EQ(s["seed"], 7);
    EXPECT_EQ(s["entities"], 1600);
    EXPECT_EQ(s["frames"], 20);
    EXPECT_EQ(s["dt"], 0.005);
    EXPECT_EQ(s["law"], "continuous");
    EXPECT_EQ(s["precision"], "float");
    EXPECT_EQ(s["partitioner"], "quadtree");
    EXPECT_EQ(s["resolver"], "sequential");
    EXPECT_EQ(s["requested_resolver"], "auto");
    EXPECT_EQ(s["threads"], 1);
    EXPECT_TRUE(s["device"].is_null());
    EXPECT_GT(s["rebuilds"], 0);
    EXPECT_EQ(s["version"], version);
    EXPECT_EQ(s["commit"], commit());
    EXPECT_LT(s["kinetic_energy"]["end"], s["kinetic_energy"]["start"]);
}

TEST_F(Summary, JsonAgreesWithTheLibrary) {
    const Json s = summaryOf({"--scene", "imbalanced", "--frames", "20", "--entities", "100"});
    Scene scene = loadScene(shippedScene("imbalanced"), {.entities = 100});
    Simulation sim(std::move(scene.world), {.step = scene.step});
    EXPECT_EQ(s["dt"], scene.step.dt);
    EXPECT_EQ(s["seed"], scene.seed);
    EXPECT_EQ(s["kinetic_energy"]["start"], kineticEnergy(sim.world()));
    EXPECT_EQ(s["momentum"]["start"], (Json{momentum(sim.world()).x(), momentum(sim.world()).y()}));
    std::uint64_t contacts = 0, collisions = 0, pairs = 0, rebuilds = 0;
    for (int i = 0; i < 20; ++i) {
        const StepReport& report = sim.step();
        contacts += report.contacts;
        collisions += report.collisions;
        pairs += report.pairsTested;
        rebuilds += report.rebuilt;
    }
    ASSERT_GT(collisions, 0u);
    EXPECT_EQ(s["contacts"], contacts);
    EXPECT_EQ(s["collisions"], collisions);
    EXPECT_EQ(s["pairs_tested"], pairs);
    EXPECT_EQ(s["rebuilds"], rebuilds);
    EXPECT_EQ(s["kinetic_energy"]["end"], kineticEnergy(sim.world()));
    EXPECT_EQ(s["momentum"]["end"], (Json{momentum(sim.world()).x(), momentum(sim.world()).y()}));
    EXPECT_EQ(s["max_overlap"], overlap(sim.world()).max);
    EXPECT_EQ(s["escaped"], escaped(sim.world()));
    const CellLoad cells = loadOf(sim.cells());
    EXPECT_EQ(s["cells"], cells.cells);
    EXPECT_EQ(s["active_cells"], cells.activeCells);
    EXPECT_EQ(s["max_bodies_per_cell"], cells.maxBodies);
    EXPECT_EQ(s["state_hash"], hexadecimal(stateHash(sim.world())));
}

TEST_F(Summary, JsonInAFileLeavesTheWordsOnStdout) {
    const ProcessResult result = runProgram(
        {"--headless", "--scene", "cradle", "--frames", "30", "--json", file("run.json")});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "summary"));
    EXPECT_EQ(files(), std::vector<std::string>{"run.json"});
    const Json s = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(s["scene"], "cradle");
    EXPECT_TRUE(contains(result.out, s["state_hash"].get<std::string>()));
}

TEST_F(Summary, PhasesAreFilledByProfile) {
    const Arguments run = {"--scene", "imbalanced", "--frames", "30"};
    const Json s = summaryOf(run + Arguments{"--profile"});
    double sum = 0;
    for (const char* phase : {"integrate", "partition", "flatten", "copy_to_device", "resolve",
                              "copy_to_host", "observe"}) {
        ASSERT_TRUE(s["phases_ms"].contains(phase)) << phase;
        ASSERT_TRUE(s["phases_ms"][phase].is_number()) << phase;
        EXPECT_GE(s["phases_ms"][phase], 0) << phase;
        sum += s["phases_ms"][phase].get<double>();
    }
    EXPECT_GT(s["phases_ms"]["integrate"], 0);
    EXPECT_GT(s["phases_ms"]["partition"], 0);
    EXPECT_GT(s["phases_ms"]["resolve"], 0);
    // The phases are parts of the frame, but for the rounding of the clock.
    EXPECT_LE(sum, 1.01 * s["ms_per_frame"]["mean"].get<double>());

    EXPECT_EQ(summaryOf(run)["state_hash"], s["state_hash"]);
    const ProcessResult words = runProgram(Arguments{"--headless", "--profile"} + run);
    EXPECT_TRUE(contains(words.out, "phases, ms")) << words.out;
}

TEST_F(Summary, MissedPairsAreCountedForThePolicyThatMissesThem) {
    const Arguments run = {"--scene", "imbalanced", "--law", "impulse", "--frames", "40"};
    const Json every = summaryOf(run + Arguments{"--rebuild", "every:10"});
    ASSERT_TRUE(every["missed_pairs"].is_number_unsigned());
    EXPECT_GT(every["missed_pairs"], 0);
    EXPECT_EQ(every["rebuilds"], 4);
    const Json each = summaryOf(run + Arguments{"--rebuild", "every:1"});
    EXPECT_EQ(each["missed_pairs"], 0);
    for (const char* name : {"brute-force", "static-grid", "quadtree", "semi-static-quadtree"}) {
        EXPECT_TRUE(summaryOf(run + Arguments{"--partitioner", name})["missed_pairs"].is_null())
            << name;
    }
}

TEST_F(Summary, PeriodicLinesShowHowTheRunGoes) {
    const ProcessResult result = runProgram(
        {"--headless", "--scene", "imbalanced", "--report-every", "0.2", "--duration", "1"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    const auto lines = linesWith(result.out, "ms/frame");
    EXPECT_GE(lines.size(), 2u);
    for (const std::string& line : lines) {
        for (const char* word : {"entities 1700", "frames ", "ms/frame", "frames/s", "cells",
                                 "bodies/cell", "contacts", "energy drift"}) {
            EXPECT_TRUE(contains(line, word)) << "no " << word << " in: " << line;
        }
    }
    EXPECT_EQ(linesWith(result.out, "summary").size(), 1u);
}

TEST_F(Summary, DurationEndsTheRunBeforeItsFrames) {
    const Json s = summaryOf({"--scene", "cradle", "--duration", "0.05", "--frames", "1000000000"});
    EXPECT_GT(s["frames"], 0);
    EXPECT_LT(s["frames"], 1000000000);
}

TEST_F(Summary, NoFramesIsNoError) {
    const Json s = summaryOf({"--scene", "cradle", "--frames", "0"});
    EXPECT_EQ(s["frames"], 0);
    EXPECT_EQ(s["contacts"], 0);
    EXPECT_EQ(s["kinetic_energy"]["relative_drift"], 0);
}

}  // namespace
}  // namespace quadrille
