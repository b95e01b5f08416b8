#pragma once

#include <cstdint>

#include <quadrille/cell_coordinates.hpp>
#include <quadrille/components.hpp>

namespace quadrille::app {

/// From dark violet over red to light yellow, `t` from 0 to 1: evenly growing lightness.
Color heatColor(double t);

/// From blue over green to yellow, `t` from 0 to 1.
Color speedColor(double t);

/// From dark blue over teal to light yellow, `t` from 0 to 1.
Color energyColor(double t);

/// From light yellow, just hit, over red to a dim violet, `t` from 0 to 1.
Color sinceHitColor(double t);

/// One of many bright colours for a cell, the same as long as the cell exists.
Color cellColor(const CellCoordinates& cell);

/// Where `count` bodies stand on the scale of the heat map, from 0 to 1; the square root keeps the
/// cells with few bodies apart where some have hundreds.
double heatScale(std::size_t count, std::size_t most);

}  // namespace quadrille::app
