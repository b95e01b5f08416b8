// Mutated scene and instance files must be taken or refused, with file, line and column; never end
// the program, which the sanitizers and the assertions of the TOML parser watch. The inputs are the
// same on every machine; QUADRILLE_FUZZ_SEED and QUADRILLE_FUZZ_INPUTS ask for others, or more.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <quadrille/random.hpp>
#include <quadrille/scene.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

std::uint64_t setting(const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// What has a meaning to a parser, and what has none.
constexpr std::array<std::string_view, 58> pieces = {"[",
                                                     "]",
                                                     "[[",
                                                     "]]",
                                                     "{",
                                                     "}",
                                                     "\"",
                                                     "'",
                                                     "\"\"\"",
                                                     "'''",
                                                     "\\",
                                                     "\\u",
                                                     "\\U0010ffff",
                                                     "\\ud800",
                                                     "\\\n",
                                                     "\n",
                                                     "\r\n",
                                                     "\r",
                                                     "\t",
                                                     " ",
                                                     ".",
                                                     "=",
                                                     ",",
                                                     "#",
                                                     "_",
                                                     "-",
                                                     "+",
                                                     ":",
                                                     "\xff",
                                                     "\xc3",
                                                     "\xe2\x80\xa8",
                                                     "\xc2\x85",
                                                     "\xc2\xa0",
                                                     "\xef\xbb\xbf",
                                                     "\xf4\x90\x80\x80",
                                                     "\xed\xa0\x80",
                                                     "a.b.c",
                                                     "a = [",
                                                     "a = {",
                                                     "a = 2020-01-01 1",
                                                     "07:32:00",
                                                     "0x",
                                                     "0b2",
                                                     "0o8",
                                                     "1e999",
                                                     "-1e-999",
                                                     "inf",
                                                     "-nan",
                                                     "true",
                                                     "TRUE",
                                                     "[[spawn]]",
                                                     "[[body]]\n",
                                                     "[world]\n",
                                                     "1_0",
                                                     "00",
                                                     "9223372036854775808",
                                                     "0x1p-3",
                                                     "\x7f"};

class Mutator {
  public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    std::string mutate(std::string text, const std::string& other) {
        const auto rounds = pick(1, 4);
        for (std::size_t i = 0; i < rounds; ++i) change(text, other);
        return text;
    }

    std::size_t pick(std::size_t low, std::size_t high) {
        return static_cast<std::size_t>(random_.integer(std::int64_t(low), std::int64_t(high)));
    }

  private:
    void change(std::string& text, const std::string& other) {
        const std::size_t at = pick(0, text.size());
        const std::size_t length = std::min(pick(0, 30), text.size() - at);
        switch (pick(0, 7)) {
            case 0:
                text.insert(at, pieces[pick(0, pieces.size() - 1)]);
                break;
            case 1:
                text.replace(at, length, pieces[pick(0, pieces.size() - 1)]);
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(pick(0, text.size()), text.substr(at, length));
                break;
            case 4:
                if (at < text.size()) text[at] = static_cast<char>(pick(0, 255));
                break;
            case 5:
                text.resize(at);
                break;
            case 6:
                text.insert(at, other.substr(pick(0, other.size()), pick(0, 200)));
                break;
            case 7: {
                const std::string_view piece = pieces[pick(0, pieces.size() - 1)];
                std::string many;
                for (std::size_t i = pick(0, 400); i > 0; --i) many += piece;
                text.insert(at, many);
                break;
            }
        }
    }

    Random random_;
};

class SceneFuzz : public testing::Test {
  protected:
    /// What is refused is so with a place in one of the files, or at least with its name.
    void expectTakenOrRefused(const std::filesystem::path& scene, const std::string& input) {
        // More bodies than that say nothing about parsing.
        const auto announce = [](std::uint64_t bodies, std::optional<Law>) {
            if (bodies > 500) throw TooMany();
        };
        try {
            loadScene(scene, {.announce = announce});
            ++taken_;
        } catch (const TooMany&) {
            ++taken_;
        } catch (const SceneError& error) {
            const std::string what = error.what();
            located_ += std::regex_search(what, place_);
            EXPECT_EQ(what.rfind(folder_.path().string(), 0), 0u) << what << "\nfor\n" << input;
        }
    }

    struct TooMany {};
    TemporaryFolder folder_;
    std::uint64_t seed_ = setting("QUADRILLE_FUZZ_SEED", 1);
    std::uint64_t inputs_ = setting("QUADRILLE_FUZZ_INPUTS", 4000);
    std::uint64_t taken_ = 0, located_ = 0;
    std::regex place_{"^[^:]*:[0-9]+:[0-9]+: "};
};

TEST_F(SceneFuzz, MutatedScenes) {
    std::cout << "seed " << seed_ << ", " << inputs_ << " inputs\n";
    std::vector<std::string> scenes;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_SCENES_DIR)) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) scenes.push_back(contentOf(file));
    ASSERT_GT(scenes.size(), 5u);
    Mutator mutator(seed_);
    for (std::uint64_t i = 0; i < inputs_; ++i) {
        const std::string& scene = scenes[mutator.pick(0, scenes.size() - 1)];
        const std::string& other = scenes[mutator.pick(0, scenes.size() - 1)];
        const std::string input = mutator.mutate(scene, other);
        expectTakenOrRefused(folder_.write("scene.toml", input), input);
    }
    // Otherwise the inputs are too far from scenes, or too near.
    EXPECT_GT(taken_, inputs_ / 50);
    EXPECT_GT(located_, inputs_ / 2);
}

TEST_F(SceneFuzz, MutatedInstanceFiles) {
    const auto scene = folder_.write(
        "scene.toml", "format = 1\n[world]\nsize = [100, 50]\n[[instance]]\nfile = \"rows.csv\"\n");
    const std::vector<std::string> tables = {
        "x,y,vx,vy\n1,2,3,4\n-1.5,2e3,0,-0\n", "x,y,vx,vy,w,h\r\n1,2,3,4,5,6\r\n\r\n7,8,9,1,2,3",
        "x,y,vx,vy,w,h,mass\n1,2,3,4,5,6,7\n1e-3,2,3,4,5,6,1e300\n"};
    Mutator mutator(seed_);
    for (std::uint64_t i = 0; i < inputs_; ++i) {
        const std::string& table = tables[mutator.pick(0, tables.size() - 1)];
        const std::string input = mutator.mutate(table, tables[mutator.pick(0, tables.size() - 1)]);
        folder_.write("rows.csv", input);
        expectTakenOrRefused(scene, input);
    }
    EXPECT_GT(taken_, inputs_ / 50);
    EXPECT_GT(located_, inputs_ / 2);
}

}  // namespace
}  // namespace quadrille
