#include "core/scene_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "core/scene_settings.hpp"

namespace quadrille {

namespace {

std::optional<double> finiteNumber(const toml::node& node) {
    if (const auto value = node.value_exact<double>()) {
        return std::isfinite(*value) ? value : std::nullopt;
    }
    if (const auto value = node.value_exact<std::int64_t>()) return static_cast<double>(*value);
    return std::nullopt;
}

std::optional<Vec2> pairOfNumbers(const toml::node& node) {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2) return std::nullopt;
    const auto first = finiteNumber(*array->get(0));
    const auto second = finiteNumber(*array->get(1));
    if (!first || !second) return std::nullopt;
    return Vec2(*first, *second);
}

std::optional<Color> parseColor(std::string_view text) {
    if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
    std::uint32_t value = 0;
    const auto [end, error] =
        std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (text.size() == 7) value = value << 8 | 0xff;
    return Color{static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
                 static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

std::string placeOf(const toml::source_region& where, const std::string& file) {
    return file + ":" + std::to_string(where.begin.line) + ":" + std::to_string(where.begin.column);
}

}  // namespace

toml::table parseScene(const std::string& text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw SceneError(placeOf(error.source(), file) + ": " + std::string(error.description()));
    }
}

SceneTable::SceneTable(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

const toml::node* SceneTable::find(std::string_view key) {
    known_.emplace_back(key);
    return table_->get(key);
}

std::string SceneTable::place(std::string_view key) const {
    const toml::node* value = table_->get(key);
    const toml::node& guilty = value != nullptr ? *value : *table_;
    const std::string where =
        isSetting(guilty) ? std::string(settingSource) : placeOf(guilty.source(), file_);
    const std::string full = path_ + std::string(key);
    return where + ": " + full.substr(0, full.size() - (key.empty() && !path_.empty()));
}

void SceneTable::fail(std::string_view key, const std::string& reason) const {
    const std::string mistyped = table_->get(key) == nullptr ? mistypedAs(key) : "";
    throw SceneError(place(key) + ": " + reason + mistyped);
}

std::string SceneTable::mistypedAs(std::string_view key) const {
    const std::array<std::string, 1> meant = {std::string(key)};
    for (const auto& [there, node] : *table_) {
        const bool known = std::find(known_.begin(), known_.end(), there.str()) != known_.end();
        if (known || nearestNames(there.str(), meant).empty()) continue;
        return "; '" + std::string(there.str()) + "' is not a known key" + didYouMean(meant);
    }
    return "";
}

std::optional<double> SceneTable::number(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = finiteNumber(*node);
    if (!value) fail(key, "must be a finite number");
    return value;
}

std::optional<double> SceneTable::positive(std::string_view key) {
    const auto value = number(key);
    if (value && !(*value > 0)) fail(key, "must be positive");
    return value;
}

std::optional<std::int64_t> SceneTable::integer(std::string_view key, std::int64_t low,
                                                std::int64_t high) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::int64_t>();
    if (!value) fail(key, "must be an integer");
    if (*value < low || *value > high) {
        fail(key, "must be from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return value;
}

std::optional<bool> SceneTable::boolean(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<bool>();
    if (!value) fail(key, "must be true or false");
    return value;
}

std::optional<std::string> SceneTable::string(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    auto value = node->value_exact<std::string>();
    if (!value) fail(key, "must be a string");
    return value;
}

std::optional<Vec2> SceneTable::numbers(std::string_view key, const char* shape) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    auto value = pairOfNumbers(*node);
    if (!value) fail(key, std::string("must be two finite numbers, ") + shape);
    return value;
}

std::optional<Vec2> SceneTable::vector(std::string_view key) { return numbers(key, "[x, y]"); }

std::optional<Vec2> SceneTable::positiveVector(std::string_view key) {
    auto value = numbers(key, "[width, height]");
    if (value && !(value->minCoeff() > 0)) fail(key, "must be positive");
    // Bodies keep half of their sizes.
    if (value && !(value->minCoeff() / 2 > 0)) fail(key, "is too small");
    return value;
}

std::optional<Vec2> SceneTable::range(std::string_view key) {
    auto value = numbers(key, "[low, high]");
    if (value && !(value->x() <= value->y())) fail(key, "must not end below its start");
    return value;
}

std::optional<std::pair<Vec2, Vec2>> SceneTable::region(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const toml::array* array = node->as_array();
    if (array != nullptr && array->size() == 2) {
        const auto low = pairOfNumbers(*array->get(0));
        const auto high = pairOfNumbers(*array->get(1));
        if (low && high && low->x() < high->x() && low->y() < high->y()) {
            return std::pair(*low, *high);
        }
    }
    fail(key, "must be two corners, [[left, bottom], [right, top]]");
}

std::optional<Color> SceneTable::color(std::string_view key) {
    const auto text = string(key);
    if (!text) return std::nullopt;
    const auto value = parseColor(*text);
    if (!value) fail(key, "must be \"#rrggbb\" or \"#rrggbbaa\"");
    return value;
}

std::optional<SceneTable> SceneTable::table(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (node->as_table() == nullptr) fail(key, "must be a table");
    return SceneTable(*node->as_table(), file_, path_ + std::string(key) + ".");
}

std::vector<SceneTable> SceneTable::tables(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr) fail(key, "must be a list of tables, [[" + std::string(key) + "]]");
    std::vector<SceneTable> result;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::table* table = array->get(i)->as_table();
        if (table == nullptr) fail(key, "must be a list of tables, [[" + std::string(key) + "]]");
        result.emplace_back(*table, file_,
                            path_ + std::string(key) + "[" + std::to_string(i) + "].");
    }
    return result;
}

void SceneTable::finish() const {
    for (const auto& [key, node] : *table_) {
        if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
        std::string valid;
        for (const std::string& name : known_) valid += (valid.empty() ? "" : ", ") + name;
        fail(key.str(), "is not a known key; known here: " + valid +
                            didYouMean(nearestNames(key.str(), known_)));
    }
}

}  // namespace quadrille
