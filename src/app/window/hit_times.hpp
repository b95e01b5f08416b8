#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <quadrille/contact.hpp>

namespace quadrille::app {

/// When each entity last exchanged an impulse with another, as far as it was watched.
class HitTimes {
  public:
    static constexpr double never = -std::numeric_limits<double>::infinity();

    void record(const Contact& contact) {
        if (!contact.collided) return;
        hit(contact.a.index, contact.time);
        hit(contact.b.index, contact.time);
    }

    /// s since the start of the run, or `never`.
    double last(std::uint32_t entity) const {
        return entity < times_.size() ? times_[entity] : never;
    }

    void clear() { times_.clear(); }

  private:
    void hit(std::uint32_t entity, double time) {
        if (entity >= times_.size()) times_.resize(entity + std::size_t(1), never);
        times_[entity] = time;
    }

    std::vector<double> times_;  // by the index of the entity
};

}  // namespace quadrille::app
