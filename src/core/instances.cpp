#include "core/instances.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <quadrille/error.hpp>

#include "system/input_file.hpp"
#include "system/memory.hpp"

namespace quadrille {

namespace {

constexpr std::array<std::string_view, 7> columnNames = {"x", "y", "vx", "vy", "w", "h", "mass"};

class InstanceReader {
  public:
    InstanceReader(std::string file, const Instance& defaults)
        : file_(std::move(file)), defaults_(defaults) {}

    void readHeader(std::string_view line) {
        std::string expected;
        for (std::size_t i = 0; i < columnNames.size(); ++i) {
            if (i > 0) expected += ',';
            expected += columnNames[i];
            if (i + 1 != 4 && i + 1 != 6 && i + 1 != 7) continue;
            if (line == expected) columns_ = i + 1;
        }
        if (columns_ == 0) fail(1, 1, "the header must be x,y,vx,vy[,w,h[,mass]]");
    }

    Instance readRow(std::string_view line, std::size_t lineNumber) const {
        std::array<double, 7> values{};
        std::size_t at = 0;
        for (std::size_t i = 0; i < columns_; ++i) {
            const auto [end, error] =
                std::from_chars(line.data() + at, line.data() + line.size(), values[i]);
            const auto next = static_cast<std::size_t>(end - line.data());
            if (error != std::errc() || !std::isfinite(values[i])) {
                fail(lineNumber, at + 1, std::string(columnNames[i]) + ": must be a finite number");
            }
            if (i >= 4 && !(values[i] > 0)) {
                fail(lineNumber, at + 1, std::string(columnNames[i]) + ": must be positive");
            }
            // Bodies keep half of their sizes.
            if ((i == 4 || i == 5) && !(values[i] / 2 > 0)) {
                fail(lineNumber, at + 1, std::string(columnNames[i]) + ": is too small");
            }
            const bool last = i + 1 == columns_;
            if (last ? next != line.size() : next >= line.size() || line[next] != ',') {
                fail(lineNumber, next + 1,
                     "must have " + std::to_string(columns_) + " numbers, with commas between");
            }
            at = next + 1;
        }
        Instance result = defaults_;
        result.position = Vec2(values[0], values[1]);
        result.velocity = Vec2(values[2], values[3]);
        if (columns_ >= 6) result.size = Vec2(values[4], values[5]);
        if (columns_ >= 7) result.mass = values[6];
        return result;
    }

  private:
    [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& reason) const {
        throw SceneError(file_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " +
                         reason);
    }

    std::string file_;
    Instance defaults_;
    std::size_t columns_ = 0;
};

}  // namespace

std::vector<Instance> readInstances(const std::filesystem::path& file, const Instance& defaults,
                                    const std::string& place,
                                    const std::function<void(std::uint64_t)>& announce) {
    const auto fail = [&](const std::string& reason) {
        throw SceneError(place + ": " + file.string() + ": " + reason);
    };
    std::string text;
    try {
        text = readRegularFile(file, memoryOfMachine());
    } catch (const Error& error) {
        fail(error.what());
    }
    dropByteOrderMark(text);
    const auto lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    if (lines > mostBodies + 2) {  // a header, and nothing behind the last line break
        fail("has more than " + std::to_string(mostBodies) + " rows");
    }
    announce(lines - 1);

    InstanceReader reader(file.string(), defaults);
    std::vector<Instance> result;
    result.reserve(static_cast<std::size_t>(lines - 1));
    std::string_view rest = text;
    for (std::size_t number = 1; number == 1 || !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (number == 1) {
            reader.readHeader(line);
        } else if (!line.empty()) {
            result.push_back(reader.readRow(line, number));
        }
    }
    return result;
}

}  // namespace quadrille
