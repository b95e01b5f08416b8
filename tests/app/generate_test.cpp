// What --generate prints is made from the options themselves; here it meets the tools that read it.

#include <algorithm>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

/// The options that --help lists.
std::vector<std::string> optionNames() {
    std::istringstream help(runProgram({"--help"}).out);
    std::vector<std::string> names;
    for (std::string line; std::getline(help, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        std::istringstream parts(first);
        for (std::string part; std::getline(parts, part, ',');) {
            // A flag that turns something off is followed by {false}.
            if (part.starts_with("--")) names.push_back(part.substr(0, part.find('{')));
        }
    }
    return names;
}

/// What bash offers after these words; the last one is what has been typed of a word.
std::vector<std::string> completions(const Arguments& words, const std::string& folder = "/") {
    std::string typed = "COMP_WORDS=(\"$1\"";
    for (const std::string& word : words) typed += " '" + word + "'";
    const std::string script = "cd " + folder +
                               " && source <(\"$1\" --generate complete-bash) && " + typed +
                               ") COMP_CWORD=" + std::to_string(words.size()) +
                               "; _collisionStress \"$1\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
    Process bash("/bin/bash", {"--norc", "-c", script, "bash", QUADRILLE_PROGRAM});
    const ProcessResult result = bash.finish();
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::istringstream lines(result.out);
    std::vector<std::string> offered;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) offered.push_back(line);
    }
    return offered;
}

using Words = std::vector<std::string>;

TEST(BashCompletion, OffersEveryOption) {
    const Words offered = completions({"--"});
    ASSERT_GT(optionNames().size(), 40u);
    for (const std::string& name : optionNames()) {
        EXPECT_NE(std::find(offered.begin(), offered.end(), name), offered.end()) << name;
    }
    EXPECT_EQ(completions({"--dump-"}), (Words{"--dump-state", "--dump-events"}));
}

TEST(BashCompletion, OffersTheValuesOfAnOption) {
    EXPECT_EQ(completions({"--law", ""}), (Words{"baseline", "impulse", "continuous"}));
    EXPECT_EQ(completions({"--law", "=", "c"}), Words{"continuous"});
    EXPECT_EQ(completions({"--law", "="}), (Words{"baseline", "impulse", "continuous"}));
    EXPECT_EQ(completions({"--show", "gridlines,h"}), Words{"gridlines,heat-map"});
    EXPECT_EQ(completions({"--frames", ""}), Words{});
}

TEST(BashCompletion, OffersScenesAndFiles) {
    EXPECT_EQ(completions({"cra"}), Words{"cradle"});
    EXPECT_EQ(completions({"--scene", "demo"}), Words{"demo13k"});
    EXPECT_EQ(completions({"--json", "cradle.t"}, QUADRILLE_SCENES_DIR), Words{"cradle.toml"});
    EXPECT_EQ(completions({"cradle"}, QUADRILLE_SCENES_DIR), (Words{"cradle", "cradle.toml"}));
}

TEST(Manual, HasEveryOptionAndNoLineThatRoffMistakes) {
    const ProcessResult result = runProgram({"--generate", "man"});
    EXPECT_EQ(result.exitCode, 0);
    std::istringstream lines(result.out);
    std::string text;
    for (std::string line; std::getline(lines, line); text += line + '\n') {
        if (!line.starts_with('.')) continue;
        const std::string request = line.substr(0, line.find(' '));
        const Words known{".TH", ".SH", ".SS", ".TP", ".br", ".B"};
        EXPECT_NE(std::find(known.begin(), known.end(), request), known.end()) << line;
    }
    for (std::string name : optionNames()) {
        for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) {
            name.insert(at, "\\");
        }
        EXPECT_TRUE(contains(text, name)) << name;
    }
}

}  // namespace
}  // namespace quadrille
