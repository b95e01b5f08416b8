#pragma once

#include <cstddef>

#include <quadrille/bodies.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille::cuda {

/// The mean extent of moving bodies along the axis on which it is larger, px.
template <class Real>
double meanExtent(const BodyView<Real>& bodies);

/// The grid that the configuration names. With another partitioner, cells of twice the extent of a
/// body, in px, with what boxes are made larger by: so a body touches few, and few bodies that
/// do not overlap fit into one, however crowded a part of the world is. In a sparse world they are
/// larger, up to a quarter of a body in each, and along an axis there are no more than a grid can
/// have.
StaticGrid gridFor(const PartitionerConfig& config, std::size_t moving, double extent,
                   const Vec2& worldSize);

}  // namespace quadrille::cuda
