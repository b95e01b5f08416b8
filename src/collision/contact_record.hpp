#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>

namespace quadrille {

/// A contact as the laws hand it on.
struct ContactRecord {
    double time;      ///< of the impact, s since the start of the run
    std::uint32_t a;  ///< row of the moving body that was created first
    BodyRef b;
    std::uint8_t axes;
    std::int8_t senseX, senseY;
    bool collided;
    double impulseX = 0, impulseY = 0;    ///< exchanged along each axis, kg px/s
    double approachX = 0, approachY = 0;  ///< speed of approach before it, px/s
};

}  // namespace quadrille
