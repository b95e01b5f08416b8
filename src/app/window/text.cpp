#include "app/window/text.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

namespace quadrille::app {

std::string formatted(const char* format, ...) {
    std::array<char, 160> buffer{};
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    va_end(arguments);
    return buffer.data();
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (auto i = std::ptrdiff_t(digits.size()) - 3; i > 0; i -= 3) {
        digits.insert(static_cast<std::size_t>(i), 1, ',');
    }
    return digits;
}

std::string compact(double number) {
    const double size = std::abs(number);
    if (!(size >= 999.5 && size < 1e12)) return formatted("%.3g", number);
    const double unit = std::pow(10, std::floor(std::log10(size)) - 2);
    const auto rounded = static_cast<std::uint64_t>(std::llround(size / unit) * std::llround(unit));
    return (number < 0 ? "-" : "") + grouped(rounded);
}

std::string speedLabel(double speed) {
    if (speed == 0) return "as fast as it can";
    return speed < 1 ? formatted("x 1/%.3g", 1 / speed) : formatted("x %.3g", speed);
}

}  // namespace quadrille::app
