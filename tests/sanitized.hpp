#pragma once

#include <cstdint>

namespace quadrille {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

/// How many random scenes a test looks at: fewer under a sanitizer, which slows each down several
/// times and looks for what nearly every scene would show.
constexpr std::uint64_t scenesOf(std::uint64_t all) { return sanitized ? (all + 4) / 5 : all; }

/// And for how many steps it runs a scene whose later steps are like the earlier ones.
constexpr std::uint64_t stepsOf(std::uint64_t all) { return scenesOf(all); }

}  // namespace quadrille
