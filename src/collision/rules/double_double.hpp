#pragma once

#include <quadrille/detail/host_device.hpp>

/// Sums and products with twice the digits of a double, for host and device alike (Dekker 1971;
/// Knuth, The Art of Computer Programming 2, section 4.2.2). They need arithmetic that contracts
/// nothing.

namespace quadrille {

/// A number as the sum of two, the second within the rounding of the first.
struct DoubleDouble {
    double high = 0;
    double low = 0;

    QUADRILLE_HD DoubleDouble operator-() const { return {-high, -low}; }
};

/// a + b without any error.
QUADRILLE_HD inline DoubleDouble twoSum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

/// a b without any error, unless it or 2^27 of one of them overflows, or its last digits underflow.
QUADRILLE_HD inline DoubleDouble twoProduct(double a, double b) {
    constexpr double splitter = 134217729;  // 2^27 + 1
    const double bigA = splitter * a;
    const double highA = bigA - (bigA - a);
    const double lowA = a - highA;
    const double bigB = splitter * b;
    const double highB = bigB - (bigB - b);
    const double lowB = b - highB;
    const double product = a * b;
    const double rest = highA * highB - product;
    return {product, ((rest + highA * lowB) + lowA * highB) + lowA * lowB};
}

/// Exact to about 104 bits.
QUADRILLE_HD inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = twoSum(a.high, b.high);
    const DoubleDouble low = twoSum(a.low, b.low);
    const DoubleDouble sum = twoSum(high.high, high.low + low.high);
    return twoSum(sum.high, sum.low + low.low);
}

QUADRILLE_HD inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
}

/// Exact if the factor is a power of two.
QUADRILLE_HD inline DoubleDouble operator*(double factor, const DoubleDouble& a) {
    return {factor * a.high, factor * a.low};
}

}  // namespace quadrille
