#pragma once

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "process.hpp"

// Compiled once, in program.cpp.
extern template class nlohmann::basic_json<>;

namespace quadrille {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

inline Arguments operator+(Arguments left, const Arguments& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

/// Runs collisionStress to its end.
ProcessResult runProgram(const Arguments& arguments);

/// What a text says; a discarded value if it is no JSON.
Json parseJson(const std::string& text);

bool contains(std::string_view text, std::string_view part);

/// The letters and digits of a text, as the names of parametrized tests need them.
std::string identifier(std::string_view text);

std::filesystem::path shippedScene(const std::string& name);

/// A CSV file: the names of its columns and its rows.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};
Table parseTable(const std::string& text);

/// The number that is all of the text; a test failure if there is none.
double numberOf(const std::string& text);

std::string contentOf(const std::filesystem::path& file);

/// Tests that need a folder of their own; it goes away with its content.
class ProgramTest : public testing::Test {
  protected:
    ProgramTest();
    ~ProgramTest() override;

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::string file(const std::string& name) const { return path(name).string(); }
    std::string write(const std::string& name, const std::string& content) const;
    /// The names of the files in the folder, sorted.
    std::vector<std::string> files() const;

    /// The summary of a headless run, which must succeed.
    Json summaryOf(const Arguments& arguments) const;

  private:
    std::filesystem::path folder_;
};

/// The program must refuse with this code, all of these words on stderr and nothing on stdout.
void expectRefusal(const Arguments& arguments, int exitCode, const std::vector<std::string>& words);

}  // namespace quadrille
