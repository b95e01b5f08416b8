#include "core/scene_settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "core/scene_table.hpp"
#include "core/scene_text.hpp"

namespace quadrille {

namespace {

/// Shells take quotes away, so text needs none: what begins like no other value is text.
bool isPlainText(std::string_view value) {
    static constexpr std::array<std::string_view, 4> words = {"true", "false", "inf", "nan"};
    static constexpr std::string_view starts = "0123456789+-\"'[{ \t";
    return !value.empty() && starts.find(value.front()) == std::string_view::npos &&
           std::find(words.begin(), words.end(), value) == words.end();
}

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

/// The setting as a scene of this one value.
toml::table parse(const std::string& setting, std::string_view key) {
    const auto value = std::string_view(setting).substr(key.size() + 1);
    std::string line(key);
    line += '=';
    line += isPlainText(value) ? quoted(value) : std::string(value);
    try {
        if (value.find('\n') != std::string::npos) {
            throw SceneError(std::string(settingSource) + ": must be one line");
        }
        checkSceneText(line, settingSource);
        return parseScene(line, settingSource);
    } catch (const SceneError& error) {
        throw SceneError(std::string(error.what()) + ", in '" + setting + "'");
    }
}

/// What stands before the first '=': no key of a scene needs quotes.
std::string_view keyOf(std::string_view setting) {
    static constexpr std::string_view letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    const std::size_t equals = setting.find('=');
    const std::string_view key = setting.substr(0, equals);
    if (equals == std::string_view::npos || key.empty() ||
        key.find_first_not_of(letters) != std::string_view::npos) {
        throw SceneError(std::string(settingSource) + ": '" + std::string(setting) +
                         "' is not KEY=VALUE, such as step.restitution=0.5 or spawn.0.count=10");
    }
    return key;
}

/// Takes the one value of a setting down into the scene.
class Descent {
  public:
    explicit Descent(std::string_view key)
        : parts_(1 + static_cast<std::size_t>(std::count(key.begin(), key.end(), '.'))) {}

    void into(toml::table& scene, toml::table&& patch) {
        auto [key, value] = *patch.begin();
        const std::string name(key.str());
        toml::node* there = scene.get(name);
        path_ += (path_.empty() ? "" : ".") + name;
        if (there == nullptr && parts_ > 1 && isIndexed(value)) {
            fail("the scene has none" + didYouMean(nearestNames(name, keysOf(scene))));
        }
        if (there == nullptr || parts_ == 1) {
            value.visit([&](auto& typed) { scene.insert_or_assign(name, std::move(typed)); });
            return;
        }
        below(*there, std::move(*value.as_table()));
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw SceneError(std::string(settingSource) + ": " + path_ + ": " + reason);
    }

    static std::vector<std::string> keysOf(const toml::table& table) {
        std::vector<std::string> keys;
        for (const auto& [key, value] : table) keys.emplace_back(key.str());
        return keys;
    }

    static std::optional<std::size_t> indexOf(std::string_view text) {
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
        if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
        return index;
    }
    static bool isIndexed(const toml::node& patch) {
        const toml::table* table = patch.as_table();
        return table != nullptr && !table->empty() && indexOf(table->begin()->first.str());
    }

    void below(toml::node& there, toml::table&& patch) {
        --parts_;
        if (toml::table* table = there.as_table()) {
            into(*table, std::move(patch));
        } else if (toml::array* array = there.as_array()) {
            intoList(*array, std::move(patch));
        } else {
            fail("is neither a table nor a list");
        }
    }

    void intoList(toml::array& list, toml::table&& patch) {
        auto [key, value] = *patch.begin();
        const auto index = indexOf(key.str());
        if (!index || *index >= list.size()) {
            fail("is a list of " + std::to_string(list.size()) + ", counted from 0, and has no '" +
                 std::string(key.str()) + "'");
        }
        path_ += "." + std::string(key.str());
        if (parts_ > 1) return below(list[*index], std::move(*value.as_table()));
        value.visit([&](auto& typed) {
            list.replace(list.cbegin() + std::ptrdiff_t(*index), std::move(typed));
        });
    }

    std::size_t parts_;  // of the key that are left
    std::string path_;
};

}  // namespace

void applySettings(const std::vector<std::string>& settings, toml::table& scene) {
    for (const std::string& setting : settings) {
        const std::string_view key = keyOf(setting);
        Descent(key).into(scene, parse(setting, key));
    }
}

bool isSetting(const toml::node& value) {
    const auto& path = value.source().path;
    if (path && *path == settingSource) return true;
    const toml::array* list = value.as_array();
    return list != nullptr && std::any_of(list->begin(), list->end(),
                                          [](const toml::node& part) { return isSetting(part); });
}

}  // namespace quadrille
