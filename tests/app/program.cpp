#include "program.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <system_error>

template class nlohmann::basic_json<>;

namespace quadrille {

namespace fs = std::filesystem;

ProcessResult runProgram(const Arguments& arguments) {
    ProcessResult result = Process(QUADRILLE_PROGRAM, arguments).finish();
    EXPECT_FALSE(result.timedOut);
    return result;
}

Json parseJson(const std::string& text) { return Json::parse(text, nullptr, false); }

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

std::string identifier(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) result += c;
    }
    return result;
}

fs::path shippedScene(const std::string& name) {
    return fs::path(QUADRILLE_SCENES_DIR) / (name + ".toml");
}

Table parseTable(const std::string& text) {
    Table table;
    std::istringstream in(text);
    std::string line;
    for (bool header = true; std::getline(in, line); header = false) {
        std::vector<std::string> fields;
        std::istringstream row(line);
        for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
        if (header) {
            table.columns = std::move(fields);
        } else {
            table.rows.push_back(std::move(fields));
        }
    }
    return table;
}

double numberOf(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_TRUE(error == std::errc() && end == text.data() + text.size())
        << "'" << text << "' is not a number";
    return value;
}

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

ProgramTest::ProgramTest() {
    std::random_device random;
    do {
        folder_ = fs::temp_directory_path() / ("quadrille-app-test-" + std::to_string(random()));
    } while (!fs::create_directory(folder_));
}

ProgramTest::~ProgramTest() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::string ProgramTest::write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return file(name);
}

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

Json ProgramTest::summaryOf(const Arguments& arguments) const {
    const ProcessResult result = runProgram(Arguments{"--headless", "--json", "-"} + arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    Json summary = parseJson(result.out);
    EXPECT_TRUE(summary.is_object()) << result.out;
    return summary;
}

void expectRefusal(const Arguments& arguments, int exitCode,
                   const std::vector<std::string>& words) {
    std::string command;
    for (const std::string& argument : arguments) command += " '" + argument + "'";
    SCOPED_TRACE("collisionStress" + command);
    const ProcessResult result = runProgram(arguments);
    EXPECT_EQ(result.exitCode, exitCode);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err, "");
    for (const std::string& word : words) {
        EXPECT_TRUE(contains(result.err, word)) << "no '" << word << "' in: " << result.err;
    }
}

}  // namespace quadrille
