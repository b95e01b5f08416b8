#pragma once

#include <cstdint>
#include <vector>

#include <quadrille/quadrille.hpp>

namespace quadrille::accuracy {

/// Equal squares of side 3 and mass 1 between four walls, in a square world: hard parallel squares.
struct GasConfig {
    double filling;             ///< part of the area that the squares fill
    Law law = Law::Continuous;  ///< or Impulse
    Precision precision = Precision::Double;
    double dt = 1.0 / 60;     ///< s
    int squaresPerSide = 32;  ///< of the lattice that they start from
    std::uint64_t seed = 1;
};

/// What happened in an interval; a component for each axis.
struct GasTally {
    double time = 0;      ///< s
    Vec2 pairHits{0, 0};  ///< a corner hit counts on both axes
    Vec2 wallHits{0, 0};
    Vec2 pairVirial{0, 0};    ///< sum over pair hits of m |dv| S
    Vec2 wallImpulse{0, 0};   ///< given to both walls
    Vec2 momentChange{0, 0};  ///< of the sum of m x v
};

/// Mean of |dv| over the distinct pairs, over all signs of their velocities; px/s. Hits exchange
/// velocities and walls turn them, so that in a run the signs are random and the sizes stay.
Vec2 meanRelativeSpeed(const std::vector<Vec2>& velocities);

/// A run of the engine whose hits are counted as they are handed to listeners.
class Gas {
  public:
    static constexpr double side = 3;  ///< px

    explicit Gas(const GasConfig& config);

    GasTally run(double seconds);

    double count() const { return static_cast<double>(velocities_.size()); }
    double length() const { return length_; }  ///< of the world, px
    /// Sum of m v^2, which no collision changes.
    Vec2 twiceEnergy() const;
    Vec2 relativeSpeed() const { return meanRelativeSpeed(velocities_); }

    const World& world() const { return sim_.world(); }
    /// Whether the velocities that follow from the hits are those of the world.
    bool agreesWithWorld() const;

  private:
    void count(const Contact& contact);
    Vec2 moment() const;

    double length_;
    double dt_;
    Simulation sim_;
    std::vector<Vec2> velocities_;  // as the hits seen so far leave them
    GasTally tally_;
};

// ---- samples

/// A mean with its standard error, from the means of blocks of a run.
struct Estimate {
    double mean = 0;
    double error = 0;
};
Estimate estimate(const std::vector<double>& blocks);

}  // namespace quadrille::accuracy
