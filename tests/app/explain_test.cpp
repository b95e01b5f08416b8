#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

/// "yes" or "no", as the line about a feature says.
std::string modelled(const std::string& explanation, const std::string& feature) {
    std::istringstream in(explanation);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string answer;
        words >> answer >> std::ws;
        std::string rest;
        std::getline(words, rest);
        if (rest.starts_with(feature)) return answer;
    }
    return "no line about " + feature;
}

std::string explanationOf(const Arguments& arguments) {
    const ProcessResult result = runProgram(Arguments{"--explain"} + arguments);
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    return result.out;
}

TEST(Explain, PileFallsAndIsInelastic) {
    const std::string text = explanationOf({"--scene", "pile"});
    EXPECT_EQ(modelled(text, "position and velocity"), "yes");
    EXPECT_EQ(modelled(text, "gravity"), "yes");
    EXPECT_EQ(modelled(text, "restitution below 1"), "yes");
    EXPECT_EQ(modelled(text, "static bodies"), "yes");
    EXPECT_EQ(modelled(text, "sizes"), "no");
    EXPECT_EQ(modelled(text, "masses"), "no");
}

TEST(Explain, MixedSizesHaveTheirOwnSizes) {
    const std::string text = explanationOf({"--scene", "mixed-sizes"});
    EXPECT_EQ(modelled(text, "sizes"), "yes");
    EXPECT_EQ(modelled(text, "masses"), "no");
    EXPECT_EQ(modelled(text, "gravity"), "no");
    EXPECT_EQ(modelled(text, "restitution below 1"), "no");
}

TEST(Explain, BalancedNeedsLeast) {
    const std::string text = explanationOf({"--scene", "balanced", "--headless"});
    EXPECT_EQ(modelled(text, "position and velocity"), "yes");
    EXPECT_EQ(modelled(text, "static bodies"), "yes");
    for (const char* absent : {"sizes", "masses", "gravity", "restitution below 1",
                               "contact listeners", "profile", "renderer"}) {
        EXPECT_EQ(modelled(text, absent), "no") << absent;
    }
    EXPECT_TRUE(contains(text, "50000 moving and 4 static"));
}

TEST(Explain, AWindowNeedsColoursAndShowsThePhases) {
    const std::string text = explanationOf({"--scene", "balanced"});
    EXPECT_EQ(modelled(text, "renderer"), "yes");
    EXPECT_EQ(modelled(text, "profile"), "yes");
    EXPECT_EQ(modelled(text, "gravity"), "no");
}

TEST(Explain, PiHasMassesOfItsOwn) {
    EXPECT_EQ(modelled(explanationOf({"--scene", "pi"}), "masses"), "yes");
}

TEST(Explain, CradleHasNoStaticBodies) {
    EXPECT_EQ(modelled(explanationOf({"--scene", "cradle"}), "static bodies"), "no");
}

TEST(Explain, FollowsTheOptions) {
    const std::string text = explanationOf({"--scene", "balanced", "--profile", "--precision",
                                            "float", "--restitution", "0.5", "--entities", "100"});
    EXPECT_EQ(modelled(text, "profile"), "yes");
    EXPECT_EQ(modelled(text, "restitution below 1"), "yes");
    EXPECT_TRUE(contains(text, "100 moving"));
    EXPECT_TRUE(contains(text, "16 bytes a body"));
}

/// What a body needs depends on what runs; the numbers are held against a run below.
TEST(Explain, SaysHowMuchMemoryARunTakes) {
    const auto bytesOf = [](const Arguments& arguments) {
        const std::string text =
            explanationOf(Arguments{"--scene", "balanced", "--headless"} + arguments);
        const std::size_t at = text.find("  about ");
        EXPECT_NE(at, std::string::npos) << text;
        EXPECT_TRUE(contains(text, "bytes a body once it runs")) << text;
        return at == std::string::npos ? 0 : std::stod(text.substr(at + 8));
    };
    const double discrete = bytesOf({"--law", "impulse", "--resolver", "sequential"});
    const double continuous = bytesOf({"--law", "continuous", "--resolver", "sequential"});
    const double single =
        bytesOf({"--law", "impulse", "--resolver", "sequential", "--precision", "float"});
    EXPECT_LT(single, discrete);
    EXPECT_LT(discrete, continuous);
    EXPECT_LT(
        bytesOf({"--law", "impulse", "--resolver", "sequential", "--partitioner", "static-grid"}),
        discrete);
    EXPECT_LT(discrete, bytesOf({"--law", "impulse", "--resolver", "threads", "--threads", "2"}));
}

class Memory : public testing::TestWithParam<std::vector<std::string>> {};

/// Of the process, by what more bodies add.
TEST_P(Memory, IsWhatARunTakes) {
    if (sanitized) GTEST_SKIP() << "the sanitizer takes memory of its own";
    const auto with = [](int bodies) {
        return Arguments{"--headless",           "--scene",    "balanced-scaled", "--entities",
                         std::to_string(bodies), "--resolver", "sequential"} +
               GetParam();
    };
    const auto peak = [&](int bodies) {
        return runProgram(with(bodies) + Arguments{"--frames", "3"}).peakBytes;
    };
    const std::string text = explanationOf(with(100'000));
    const double said = std::stod(text.substr(text.find("  about ") + 8));
    const double taken = (peak(300'000) - peak(100'000)) / 200'000;
    EXPECT_GT(said, 0.85 * taken);
    EXPECT_LT(said, 1.25 * taken);
}

INSTANTIATE_TEST_SUITE_P(
    Explain, Memory,
    testing::Values(Arguments{"--law", "impulse"}, Arguments{"--law", "continuous"},
                    Arguments{"--law", "impulse", "--precision", "float"},
                    Arguments{"--law", "impulse", "--partitioner", "static-grid"},
                    Arguments{"--law", "impulse", "--partitioner", "quadtree"},
                    Arguments{"--law", "continuous", "--partitioner", "static-grid"}),
    [](const auto& test) {
        std::string words;
        for (const std::string& word : test.param) words += word;
        return identifier(words);
    });

/// Events are written from a listener, so asking for them makes the engine model it.
TEST(Explain, EventsNeedAListener) {
    EXPECT_EQ(modelled(explanationOf({"--dump-events", "-"}), "contact listeners"), "yes");
}

}  // namespace
}  // namespace quadrille
