#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace quadrille {

/// What a scene file may need at most. Beyond that a parser of TOML runs out of stack or of time;
/// bodies in bulk belong into an instance file.
struct SceneTextLimits {
    static constexpr std::size_t bytes = std::size_t(16) << 20;
    static constexpr std::size_t line = std::size_t(64) << 10;  ///< bytes
    static constexpr std::size_t key = 128;                     ///< bytes, with its dots
    static constexpr std::size_t keyParts = 8;
    static constexpr std::size_t nesting = 8;     ///< arrays and inline tables in each other
    static constexpr std::size_t number = 64;     ///< bytes of a number or a word
    static constexpr std::size_t headers = 64;    ///< different [table] and [[table]]
    static constexpr std::size_t dotted = 1'000;  ///< keys with a dot
};

/// The text of a scene file, without a byte order mark, which `checkSceneText` has seen. Throws
/// SceneError.
std::string readSceneText(const std::filesystem::path& file);

/// Throws SceneError, naming file, line and column, unless the text is UTF-8, has the outline of
/// TOML (tables, keys, strings, brackets) and keeps the limits. What the values are is for the
/// parser to say; dates, which no scene has, are refused.
void checkSceneText(std::string_view text, const std::string& file);

}  // namespace quadrille
