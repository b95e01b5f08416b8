#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

#include <quadrille/components.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

/// Parses text that `checkSceneText` has seen. Throws SceneError, naming file, line and column.
toml::table parseScene(const std::string& text, const std::string& file);

/// Reads one table of a scene. Every failure is a SceneError "file:line:column: key: reason", or
/// "--set: key: reason" where a setting has put the value there; keys that nobody asked for are
/// errors too.
class SceneTable {
  public:
    /// `path` is what error messages put before a key, such as "world."; empty for the root.
    SceneTable(const toml::table& table, std::string file, std::string path);

    std::optional<double> number(std::string_view key);
    std::optional<double> positive(std::string_view key);
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t low, std::int64_t high);
    std::optional<bool> boolean(std::string_view key);
    std::optional<std::string> string(std::string_view key);
    std::optional<Vec2> vector(std::string_view key);
    /// Each may be halved and is still positive.
    std::optional<Vec2> positiveVector(std::string_view key);
    /// [low, high] of numbers, low <= high.
    std::optional<Vec2> range(std::string_view key);
    /// [[x0, y0], [x1, y1]] with x0 < x1 and y0 < y1, as low and high corner.
    std::optional<std::pair<Vec2, Vec2>> region(std::string_view key);
    /// "#rrggbb" or "#rrggbbaa".
    std::optional<Color> color(std::string_view key);
    std::optional<SceneTable> table(std::string_view key);
    std::vector<SceneTable> tables(std::string_view key);

    template <class T>
    T require(std::string_view key, std::optional<T> value) const {
        if (!value) fail(key, "is missing");
        return *std::move(value);
    }

    bool has(std::string_view key) const { return table_->contains(key); }

    /// What begins an error about the key's value, or about the table if it has no such key or none
    /// is given: "file:line:column: key".
    std::string place(std::string_view key = {}) const;

    /// Throws SceneError at `place`.
    [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

    /// Call when all keys have been asked for.
    void finish() const;

  private:
    const toml::node* find(std::string_view key);
    /// What to say of a key that is missing if another one, which nobody asked for, is near to it.
    std::string mistypedAs(std::string_view key) const;
    std::optional<Vec2> numbers(std::string_view key, const char* shape);

    const toml::table* table_;
    std::string file_;
    std::string path_;
    std::vector<std::string> known_;
};

}  // namespace quadrille
