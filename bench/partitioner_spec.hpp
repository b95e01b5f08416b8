#pragma once

#include <string>
#include <string_view>

#include <quadrille/partitioner_config.hpp>

namespace quadrille::bench {

/// Reads a partitioner with its parameters; what is left out has the library's default:
///   brute-force
///   static-grid[:WIDTHxHEIGHT]
///   quadtree[:DEPTH/MAX_PER_CELL]
///   semi-static-quadtree[:DEPTH/MAX_PER_CELL[/skin|/skin=WIDTH|/every=FRAMES]]
/// Throws Error for anything else.
PartitionerConfig parsePartitioner(std::string_view spec);

/// All forms that there are, for messages.
std::string partitionerSpecs();

/// The spec with all parameters; parsePartitioner reads it back.
std::string specOf(const PartitionerConfig& config);

}  // namespace quadrille::bench
