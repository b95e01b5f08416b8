#pragma once

#include <memory>
#include <vector>

#include <quadrille/vec2.hpp>

#include "reference/oracle.hpp"

namespace quadrille::reference {

/// The reference without rounding, for boxes of equal mass, restitution 1 and no gravity
/// (accuracy.md, section 1). Sizes may differ; any static boxes.
///
/// Every axis of a box follows x = a + v t. A hit exchanges the trajectories of the pair, offset by
/// the distance of contact, and a hit on a static box mirrors one, so that a and v stay integers
/// (in units of a power of two that is found from the input) and event times are quotients of
/// 64-bit integers, compared by 128-bit products. Order, ties, corner hits and the strictness of
/// "edges level" are exact; what Oracle says of a box that meets two others at once holds here too.
/// The rules are those of Oracle, except that boxes must not overlap at the start; then they never
/// do.
class LatticeOracle {
  public:
    /// Throws std::invalid_argument, naming the box, for what Oracle refuses, for unequal masses,
    /// for boxes that overlap, and for numbers whose common unit leaves no room in 64 bits.
    explicit LatticeOracle(std::vector<Box> boxes);
    ~LatticeOracle();
    LatticeOracle(LatticeOracle&&) noexcept;
    LatticeOracle& operator=(LatticeOracle&&) noexcept;

    /// As Oracle::runUntil. Throws std::overflow_error rather than round: if an anchor leaves the
    /// 64 bits, or if `time` is not a multiple of a unit that fits.
    void runUntil(double time);

    double time() const;  ///< s

    /// All boxes, in the order given, at time(): the exact positions, rounded once to the nearest
    /// double.
    std::vector<Box> state() const;

    /// All collisions up to time(); the exact times, rounded once to the nearest double.
    const std::vector<Event>& events() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::reference
