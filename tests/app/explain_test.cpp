#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include "program.hpp"

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

/// Events are written from a listener, so asking for them makes the engine model it.
TEST(Explain, EventsNeedAListener) {
    EXPECT_EQ(modelled(explanationOf({"--dump-events", "-"}), "contact listeners"), "yes");
}

}  // namespace
}  // namespace quadrille
