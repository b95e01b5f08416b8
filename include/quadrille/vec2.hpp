#pragma once

#include <Eigen/Core>

namespace quadrille {

/// A point, a displacement (px) or a velocity (px/s) in the plane; y points up.
using Vec2 = Eigen::Vector2d;

}  // namespace quadrille
