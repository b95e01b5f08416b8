#pragma once

#include <gtest/gtest.h>
#include <string>

namespace quadrille {

/// The precisions of a typed test, and their names.
using Reals = testing::Types<double, float>;

struct RealNames {
    template <class Real>
    static std::string GetName(int) {
        return sizeof(Real) == sizeof(double) ? "Double" : "Float";
    }
};

}  // namespace quadrille
