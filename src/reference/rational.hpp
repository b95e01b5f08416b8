#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace quadrille::reference {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

inline std::int64_t checkedAdd(std::int64_t a, std::int64_t b) {
    std::int64_t sum = 0;
    if (__builtin_add_overflow(a, b, &sum)) throw std::overflow_error("lattice: 64 bits exceeded");
    return sum;
}

inline std::int64_t checkedSubtract(std::int64_t a, std::int64_t b) {
    std::int64_t difference = 0;
    if (__builtin_sub_overflow(a, b, &difference)) {
        throw std::overflow_error("lattice: 64 bits exceeded");
    }
    return difference;
}

inline std::int64_t checkedMultiply(std::int64_t a, std::int64_t b) {
    std::int64_t product = 0;
    if (__builtin_mul_overflow(a, b, &product)) {
        throw std::overflow_error("lattice: 64 bits exceeded");
    }
    return product;
}

/// A quotient of two integers of 64 bits, not reduced; its comparisons are exact.
class Rational {
  public:
    Rational() = default;

    /// Throws std::overflow_error if the sign of a lowest integer would have to change.
    Rational(std::int64_t numerator, std::int64_t denominator)
        : p_(denominator < 0 ? checkedSubtract(0, numerator) : numerator),
          q_(denominator < 0 ? checkedSubtract(0, denominator) : denominator) {}

    std::int64_t numerator() const { return p_; }
    std::int64_t denominator() const { return q_; }  ///< positive

    // A product of two 64-bit integers always fits in 128 bits.
    friend bool operator<(const Rational& a, const Rational& b) {
        return Int128{a.p_} * b.q_ < Int128{b.p_} * a.q_;
    }
    friend bool operator==(const Rational& a, const Rational& b) {
        return Int128{a.p_} * b.q_ == Int128{b.p_} * a.q_;
    }

  private:
    std::int64_t p_ = 0;
    std::int64_t q_ = 1;
};

/// The double nearest to value * 2^exponent (ties to even), for results in the normal range.
inline double nearestDouble(Int128 value, int exponent) {
    return std::ldexp(static_cast<double>(value), exponent);
}

/// The double nearest to value * 2^exponent (ties to even), for results in the normal range.
inline double nearestDouble(const Rational& value, int exponent) {
    const std::int64_t p = value.numerator();
    if (p == 0) return 0;
    // The quotient gets at least 63 bits; a last bit that is set for any remainder decides ties.
    const std::uint64_t magnitude = p < 0 ? 0 - static_cast<std::uint64_t>(p) : std::uint64_t(p);
    const int shift = 126 - static_cast<int>(std::bit_width(magnitude));
    const UInt128 dividend = UInt128{magnitude} << shift;
    const auto divisor = UInt128(static_cast<std::uint64_t>(value.denominator()));
    const UInt128 quotient = dividend / divisor | UInt128(dividend % divisor != 0 ? 1 : 0);
    const auto rounded = nearestDouble(static_cast<Int128>(quotient), exponent - shift);
    return p < 0 ? -rounded : rounded;
}

}  // namespace quadrille::reference
