// A command line, an argument a line.

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "app/exit_code.hpp"
#include "app/options.hpp"
#include "fuzz/input.hpp"

namespace quadrille::fuzz {

namespace {

/// Keeps what is said while it lives.
class Listener {
  public:
    explicit Listener(std::ostream& stream)
        : stream_(stream), before_(stream.rdbuf(said_.rdbuf())) {}
    ~Listener() { stream_.rdbuf(before_); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    bool heard() const { return !said_.view().empty(); }

  private:
    std::ostream& stream_;
    std::ostringstream said_;
    std::streambuf* before_;
};

std::vector<std::string> argumentsIn(std::string_view input) {
    std::vector<std::string> arguments = {"collisionStress"};
    // An argument cannot hold a zero.
    std::istringstream lines{std::string(input.substr(0, input.find('\0')))};
    for (std::string line; std::getline(lines, line);) arguments.push_back(line);
    return arguments;
}

}  // namespace

bool tryInput(std::string_view input) {
    const std::vector<std::string> arguments = argumentsIn(input);
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    argv.push_back(nullptr);
    const Listener out(std::cout), err(std::cerr);
    try {
        const auto parsed = app::parseOptions(static_cast<int>(arguments.size()), argv.data());
        if (parsed.options) return true;
        if (parsed.exitCode != app::done && parsed.exitCode != app::usageError) {
            throw Finding("exit code " + std::to_string(parsed.exitCode));
        }
        if (!out.heard() && !err.heard()) throw Finding("ends without a word");
        return parsed.exitCode == app::done;
    } catch (const app::UsageError&) {
        return false;
    }
}

}  // namespace quadrille::fuzz
