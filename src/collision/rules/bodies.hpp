#pragma once

#include <cstdint>
#include <limits>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

/// The body columns over plain pointers, in host or in device memory: what every rule reads and
/// writes.

namespace quadrille {

/// One number a row, or one that stands for all rows.
template <class Real>
struct SharedColumn {
    const Real* values;  ///< null if all rows have the common value
    Real common;

    QUADRILLE_HD Real operator[](std::uint32_t row) const {
        return values != nullptr ? values[row] : common;
    }
};

/// The number of each row in the order of creation. Every order that decides about a result ends in
/// these and never in rows, so that storage may be permuted without a change of bits.
struct CreationNumbers {
    const std::uint32_t* values;  ///< null while rows lie in the order of creation

    QUADRILLE_HD std::uint32_t operator[](std::uint32_t row) const {
        return values != nullptr ? values[row] : row;
    }
};

/// Where, when and how fast a body set out on its present path, along each axis: one record,
/// because an event reads all of it.
template <class Real>
struct Anchor {
    /// The time of a body that is new: it is nowhere yet.
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    Real x = 0, y = 0;                        ///< px
    Real vx = 0, vy = 0;                      ///< px/s
    double timeX = unknown, timeY = unknown;  ///< s
    float lowX = 0, lowY = 0;                 ///< px; what x and y have no digits for
};

template <class Real>
struct Bodies {
    struct Moving {
        Real *x, *y, *vx, *vy;
        SharedColumn<Real> halfWidth, halfHeight, mass;
        const std::uint32_t* entity;
        CreationNumbers created;
        Anchor<Real>* anchors;  ///< of the law `continuous`, else null
        /// Bit 0 along x, bit 1 along y: whether the body rests on something and does not fall.
        /// Null where nothing can.
        std::uint8_t* rests;
    } moving;
    struct Static {
        const Real *x, *y, *halfWidth, *halfHeight;
        const std::uint32_t* entity;
        CreationNumbers created;
    } fixed;
};

}  // namespace quadrille
