#pragma once

#include <string>
#include <toml++/toml.h>
#include <vector>

namespace quadrille {

/// Stands in errors where a setting, and no file, is at fault.
inline constexpr const char* settingSource = "--set";

/// Puts each "key=value" in place of what the scene says, in their order, as SceneOptions::set
/// describes. Throws SceneError where one is no such text or leads nowhere; what a key may be and
/// hold is for the reader of the scene to say.
void applySettings(const std::vector<std::string>& settings, toml::table& scene);

/// Whether the value, or a part of it, was put there by a setting.
bool isSetting(const toml::node& value);

}  // namespace quadrille
