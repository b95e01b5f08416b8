#include "collision/broad/semi_static_quadtree.hpp"

#include <algorithm>
#include <cmath>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

/// Largest speed of any body along either axis.
template <class Real>
Real fastest(const BodyView<Real>& bodies, const ThreadTeam& team) {
    const auto largest = [&](std::span<const Real> values) {
        return team.maximum<Real>(values.size(), &Thresholds::streamed,
                                  [values](std::size_t begin, std::size_t end) {
                                      Real most = 0;
#pragma omp simd reduction(max : most)
                                      for (std::size_t i = begin; i < end; ++i) {
                                          const Real speed = std::abs(values[i]);
                                          most = speed > most ? speed : most;
                                      }
                                      return most;
                                  });
    };
    return std::max(largest(bodies.moving.vx), largest(bodies.moving.vy));
}

template <class Real>
double mean(const ColumnView<Real>& column, std::size_t rows, const ThreadTeam& team) {
    if (column.uniform() || rows == 0) return static_cast<double>(column.common);
    const double sum =
        team.sum(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
            double part = 0;
            for (std::size_t i = begin; i < end; ++i) part += static_cast<double>(column.values[i]);
            return part;
        });
    return sum / static_cast<double>(rows);
}

/// Sum over the bodies of the number density around each, 1/px^2. The bodies of a cell are those
/// whose centres lie in the cell or within half a box of it, where `box` is the mean inflated size.
double crowding(const Cells& cells, const Vec2& box, const ThreadTeam& team) {
    return team.sum(cells.size(), &Thresholds::built, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t c = begin; c < end; ++c) {
            const double count = cells.offsets[c + 1] - cells.offsets[c];
            const Vec2 size = double(1u << cells.coordinates[c].shift) * cells.fineCell;
            const double density = count / ((size.x() + box.x()) * (size.y() + box.y()));
            sum += density * density * size.x() * size.y();
        }
        return sum;
    });
}

}  // namespace

template <class Real>
SemiStaticQuadtreePartitioner<Real>::SemiStaticQuadtreePartitioner(const SemiStaticQuadtree& config,
                                                                   const Vec2& worldSize,
                                                                   const ThreadTeam& team)
    : config_(config), team_(team), builder_(config.maxDepth, config.maxPerCell, worldSize, team) {
    if (const auto* every = std::get_if<SemiStaticQuadtree::EveryFrames>(&config.rebuild)) {
        if (every->frames < 1) throw Error("semi-static quadtree: rebuild every 1 frame or more");
        this->partition_.complete = false;
    }
    if (const auto* skin = std::get_if<SemiStaticQuadtree::Skin>(&config.rebuild)) {
        if (!std::isfinite(static_cast<Real>(skin->width)) || skin->width < 0) {
            throw Error("semi-static quadtree: the skin must be finite and not negative");
        }
    }
}

template <class Real>
bool SemiStaticQuadtreePartitioner<Real>::update(const BodyView<Real>& bodies, Real dt,
                                                 const Reach<Real>& reach) {
    ++age_;
    if (const auto* every = std::get_if<SemiStaticQuadtree::EveryFrames>(&config_.rebuild)) {
        const bool due = this->partition_.generation == 0 || bodies.revision != builtRevision_ ||
                         age_ >= static_cast<std::uint32_t>(every->frames);
        if (due) rebuild(bodies, reach, 0);
        return due;
    }
    // A body that was put elsewhere has left its box, or is still covered.
    // Who knows how far bodies will get asks again when they may have got there.
    const bool looksAhead = reach.common > 0 || !reach.own.empty();
    const bool due = looksAhead || this->partition_.generation == 0 ||
                     bodies.layout != builtLayout_ || anyLeft(bodies);
    if (!due) return false;
    rebuild(bodies, reach, looksAhead ? Real(0) : chooseSkin(bodies, dt));
    if (!looksAhead) rememberPositions(bodies);
    return true;
}

template <class Real>
void SemiStaticQuadtreePartitioner<Real>::rebuild(const BodyView<Real>& bodies,
                                                  const Reach<Real>& reach, Real skin) {
    builder_.build(bodies, reach, skin, this->partition_);
    builtRevision_ = bodies.revision;
    builtLayout_ = bodies.layout;
    age_ = 0;
}

template <class Real>
void SemiStaticQuadtreePartitioner<Real>::rememberPositions(const BodyView<Real>& bodies) {
    const auto& m = bodies.moving;
    builtX_.resize(m.size());
    builtY_.resize(m.size());
    team_.shares(m.size(), &Thresholds::streamed,
                 [&](std::size_t begin, std::size_t end, unsigned) {
                     std::copy(m.x.data() + begin, m.x.data() + end, builtX_.data() + begin);
                     std::copy(m.y.data() + begin, m.y.data() + end, builtY_.data() + begin);
                 });
}

template <class Real>
bool SemiStaticQuadtreePartitioner<Real>::anyLeft(const BodyView<Real>& bodies) const {
    const Real margin = this->partition_.margin;
    const auto left = [margin](const Real* now, const Real* then, std::size_t begin,
                               std::size_t end) {
        int count = 0;
        // Negated, so that a NaN counts as having left.
        for (std::size_t i = begin; i < end; ++i) count |= !(std::abs(now[i] - then[i]) <= margin);
        return count != 0;
    };
    const auto& m = bodies.moving;
    return team_.any(m.size(), &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
        return left(m.x.data(), builtX_.data(), begin, end) ||
               left(m.y.data(), builtY_.data(), begin, end);
    });
}

/// How far a body has moved since the last build at most, in px a step.
template <class Real>
double SemiStaticQuadtreePartitioner<Real>::walked(const BodyView<Real>& bodies) const {
    const auto& m = bodies.moving;
    if (bodies.revision != builtRevision_) return 0;  // some were put elsewhere
    const Real farthest = team_.maximum<Real>(m.size(), &Thresholds::streamed,
                                              [&](std::size_t begin, std::size_t end) {
                                                  Real most = 0;
#pragma omp simd reduction(max : most)
                                                  for (std::size_t i = begin; i < end; ++i) {
                                                      const Real x = std::abs(m.x[i] - builtX_[i]);
                                                      const Real y = std::abs(m.y[i] - builtY_[i]);
                                                      const Real distance = x > y ? x : y;
                                                      most = distance > most ? distance : most;
                                                  }
                                                  return most;
                                              });
    return static_cast<double>(farthest) / std::max(age_, 1u);
}

/// The skin that makes a step cheapest: a wider one is rebuilt less often and has more pairs to
/// test. Both grow in known ways, and the prices below are measured (docs/performance.md); the
/// result is the same with any skin, so a poor choice costs time only.
template <class Real>
Real SemiStaticQuadtreePartitioner<Real>::chooseSkin(const BodyView<Real>& bodies, Real dt) const {
    const double fixed = std::get<SemiStaticQuadtree::Skin>(config_.rebuild).width;
    if (fixed > 0) return static_cast<Real>(fixed);
    // The first tree shows how the bodies are spread, which decides about the second; and so does
    // the first tree of many more bodies.
    const auto& last = this->partition_;
    if (last.generation == 0 || last.ranges.size() < bodies.size() / 2) return 0;

    constexpr double buildPrice = 45;   // ns a body, for tree and walk through it
    constexpr double collectPrice = 8;  // ns a candidate pair, found and listed
    constexpr double testPrice = 1.2;   // ns a candidate pair and step
    constexpr int longest = 40;         // steps

    const auto& moving = bodies.moving;
    const auto count = static_cast<double>(moving.size());
    const Vec2 size(2 * mean(moving.halfWidth, moving.size(), team_),
                    2 * mean(moving.halfHeight, moving.size(), team_));
    const double margin = static_cast<double>(this->partition_.margin);
    const double crowd = crowding(this->partition_.cells, size + 2 * Vec2(margin, margin), team_);
    // What bodies walked lately counts too: pushing overlaps apart moves them beyond their speed.
    const double travel =
        std::max(static_cast<double>(fastest(bodies, team_) * dt), walked(bodies));
    double bestCost = 0;
    double bestSkin = 0;
    for (int steps = 0; steps <= longest; ++steps) {
        const double skin = steps == 0 ? 0 : (steps + 0.01) * travel;
        const Vec2 inflated = size + 2 * Vec2(skin, skin);
        const double pairs = 2 * inflated.x() * inflated.y() * crowd;
        const double cost =
            (buildPrice * count + collectPrice * pairs) / (steps + 1) + testPrice * pairs;
        if (steps == 0 || cost < bestCost) {
            bestCost = cost;
            bestSkin = skin;
        }
    }
    return static_cast<Real>(bestSkin);
}

template <class Real>
std::size_t SemiStaticQuadtreePartitioner<Real>::bytes() const {
    return this->partition_.bytes() + builder_.bytes() +
           (builtX_.capacity() + builtY_.capacity()) * sizeof(Real);
}

template class SemiStaticQuadtreePartitioner<double>;
template class SemiStaticQuadtreePartitioner<float>;

}  // namespace quadrille
