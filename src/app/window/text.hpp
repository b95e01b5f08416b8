#pragma once

#include <cstdint>
#include <string>

namespace quadrille::app {

/// As printf, for short texts.
#if defined(__GNUC__)
[[gnu::format(printf, 1, 2)]]
#endif
std::string
formatted(const char* format, ...);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// To three digits, "0.0123" or "12,300"; from a million millions on "1.23e+15".
std::string compact(double number);

/// "x 1/4", "x 2", or what 0 stands for.
std::string speedLabel(double speed);

}  // namespace quadrille::app
