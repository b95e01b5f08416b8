#include "app/window/trails.hpp"

#include <algorithm>
#include <iterator>

#include <quadrille/creation_ranks.hpp>

namespace quadrille::app {

void Trails::record(const World& world, std::uint64_t step) {
    if (places_.contains(step)) return;
    std::vector<Place>& places = places_[step];
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        places.reserve(m.size());
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            places.push_back({static_cast<float>(m.x[i]), static_cast<float>(m.y[i])});
        }
    });
    const std::size_t most =
        std::clamp<std::size_t>(mostPlaces / std::max<std::size_t>(places.size(), 1), 2, mostSteps);
    while (places_.size() > most) {
        const auto oldest = places_.begin();
        const auto newest = std::prev(places_.end());
        places_.erase(step - oldest->first >= newest->first - step ? oldest : newest);
    }
}

std::vector<Trails::Place> Trails::of(std::size_t body, std::uint64_t step,
                                      std::uint64_t steps) const {
    std::vector<Place> trail;
    auto after = places_.upper_bound(step);
    for (std::uint64_t expected = step; trail.size() <= steps && after != places_.begin();) {
        --after;
        if (after->first != expected-- || body >= after->second.size()) break;
        trail.push_back(after->second[body]);
    }
    std::reverse(trail.begin(), trail.end());
    return trail;
}

}  // namespace quadrille::app
