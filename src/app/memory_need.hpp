#pragma once

#include <cstdint>
#include <string>

#include <quadrille/simulation.hpp>

#include "app/options.hpp"

namespace quadrille::app {

/// Bytes of memory that a run takes, about: world, cells and work space. Crowds, whose bodies lie
/// in many cells and meet many others, take more.
std::uint64_t memoryNeed(const SimulationConfig& config, std::uint64_t movingBodies,
                         bool colors = false);

/// Unless --force-memory is given, throws Wrong (SceneError or SnapshotError, naming `file`) if so
/// many bodies need more memory than this process may use. Law and precision are those of the file;
/// the options may ask for others.
template <class Wrong>
void requireMemory(const Options& options, const std::string& file, std::uint64_t movingBodies,
                   Law law, Precision precision = Precision::Double);

/// "1.5 GB"
std::string inUnits(std::uint64_t bytes);

}  // namespace quadrille::app
