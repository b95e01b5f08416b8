#include "collision/continuous/continuous_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <quadrille/error.hpp>

#include "collision/integrate.hpp"
#include "collision/rules/closeness.hpp"

namespace quadrille {

namespace {

/// Bodies that are so many times as fast as the mean have bounds of their own, or more times, where
/// collisions pass their speed on.
constexpr double leastOutlier = 8;

/// Events of a step, in the mean; beyond it, each body's are counted.
constexpr std::uint64_t usualEventsPerBody = 1000;
constexpr std::uint32_t mostEventsOfABody = 1'000'000;

/// Each edit of a body rounds its position, which the reach covers for so many.
constexpr int mostEdits = 16;

// What the parts of the search cost; measured (docs/performance.md).
constexpr double buildPrice = 90;    // ns a body, for cells and the walk through them
constexpr double collectPrice = 40;  // ns a candidate pair, found, listed and searched
constexpr double againPrice = 30;    // ns a neighbour, searched again after an event

/// px/s along the faster axis.
template <class Moving>
double speedOf(const Moving& m, std::size_t row) {
    return static_cast<double>(std::max(std::abs(m.vx[row]), std::abs(m.vy[row])));
}

}  // namespace

template <class Real, class Path>
ContinuousLaw<Real, Path>::ContinuousLaw(const StepSettings& settings, const ThreadTeam& team)
    : ContactLaw<Real>({.anchors = true, .rests = falls}),
      team_(team),
      gravityX_(settings.gravity.x()),
      gravityY_(settings.gravity.y()),
      restitution_(settings.restitution),
      candidates_(team),
      found_(team.size()) {
    const bool heaps = falls || restitution_ < 1;
    if (team.size() > 1 && (!heaps || team.threads() >= team.thresholds().heapThreads)) {
        shared_ = std::make_unique<SharedEvents<Real, Path>>(team);
    }
}

template <class Real, class Path>
void ContinuousLaw<Real, Path>::begin(const LawBodies<Real>& bodies, Step<Real>& step) {
    records_.clear();
    eventsOf_.clear();
    placed_ = bodies.placed;
    if (step.audited) place(bodies, step.from);
    if (revision_ == bodies.revision) return;
    const bool goesOn = done_ == step.from && step.from < horizon_;
    if (goesOn && bodies.edits == Edits::Values && layout_ == bodies.layout) {
        takeEdits(bodies, step.from);
    } else {
        takeOver(bodies, step.from);
    }
}

/// Has a body set out anew from where the columns say that it is.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::setOut(const LawBodies<Real>& bodies, std::uint32_t row,
                                       double now) {
    const auto& m = bodies.moving;
    bodies.anchors[row] = {m.x[row], m.y[row], m.vx[row], m.vy[row], now, now};
    if constexpr (falls) bodies.rests[row] = 0;
}

/// What happened at this very moment does not hold back bodies that were edited since.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::forgetMoment() {
    events_.bursts = {};
    events_.instant = -1;
    events_.separated.clear();
}

/// Makes the bodies those that the law knows: at the beginning, and when somebody else has changed
/// more of them than takeEdits() looks at, with the same result. A body that is not where its
/// anchor says, be it new, edited, or brought from another run or another time, sets out anew from
/// where it is.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::takeOver(const LawBodies<Real>& bodies, double now) {
    const auto& m = bodies.moving;
    const auto rows = static_cast<std::uint32_t>(m.size());
    // Rows may have moved, sizes changed: what is known is found again. Overlaps are looked for
    // around bodies that set out anew; where sizes or obstacles may be others, around all; where a
    // run is resumed, around none, so that it goes on as if it had not been interrupted.
    place(bodies, now);
    revision_ = bodies.revision;
    layout_ = bodies.layout;
    events_.queue.clear();
    forgetMoment();
    horizon_ = now;
    stamps_.assign(rows, 0);
    auto& changed = events_.changed;
    changed.clear();
    events_.mayRest = false;
    const Motion motion = motionOf(bodies);
    for (std::uint32_t i = 0; i < rows; ++i) {
        const bool setsOut = !motion.isPlaced(i, now);
        if (setsOut) setOut(bodies, i, now);
        if (setsOut || bodies.edits == Edits::Everything) changed.push_back(i);
        if constexpr (falls) events_.mayRest = events_.mayRest || bodies.rests[i] != 0;
    }
}

/// Takes over positions and velocities that somebody else has changed, and keeps what is known of
/// all other bodies.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::takeEdits(const LawBodies<Real>& bodies, double now) {
    const auto& m = bodies.moving;
    const auto rows = static_cast<std::uint32_t>(m.size());
    revision_ = bodies.revision;
    forgetMoment();
    const Motion motion = motionOf(bodies);
    const Search search(motion, neighbours_, stamps_, sketches_);
    bool covered = ++editsSince_ <= mostEdits;
    for (std::uint32_t i = 0; i < rows; ++i) {
        if (motion.isPlaced(i, now)) continue;
        // The partition knows nothing of what is near another place.
        covered = covered && static_cast<Real>(motion.path(i, 0).position(now)) == m.x[i] &&
                  static_cast<Real>(motion.path(i, 1).position(now)) == m.y[i];
        setOut(bodies, i, now);
        search.changed(i);
        events_.changed.push_back(i);
    }
    if (!covered || !coversChanged(motion, now, false)) horizon_ = now;
}

/// Whether the partition covers what bodies do that have changed now. A fresh one covers their
/// speeds; but one that rested, and that nothing holds any more, falls.
template <class Real, class Path>
bool ContinuousLaw<Real, Path>::coversChanged(const Motion& motion, double now, bool fresh) const {
    const auto falling = [&](std::uint32_t row, int axis) {
        return magnitude(acceleration(motion.path(row, axis))) > gravityNow_;
    };
    return std::none_of(events_.changed.begin(), events_.changed.end(), [&](std::uint32_t row) {
        return fresh ? falling(row, 0) || falling(row, 1)
                     : outruns(motion, row, now, horizon_, bounds_);
    });
}

template <class Real, class Path>
ExactMotion<Real, Path> ContinuousLaw<Real, Path>::motionOf(const LawBodies<Real>& bodies) const {
    return {.bodies = bodies.plain(),
            .gravityX = gravityX_,
            .gravityY = gravityY_,
            .restitution = restitution_};
}

/// Writes where all bodies are at time t, the present one, unless that has been done. Throws Error
/// if a position is not finite.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::place(const LawBodies<Real>& bodies, double t) {
    if (placed_) return;
    placed_ = true;
    constexpr Real largest = std::numeric_limits<Real>::max();
    const std::size_t rows = bodies.moving.size();
    const bool lost =
        team_.any(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
            const Motion motion = motionOf(bodies);
            const Real* const x = motion.bodies.moving.x;
            const Real* const y = motion.bodies.moving.y;
            int bad = 0;
            for (std::size_t i = begin; i < end; ++i) {
                motion.place(static_cast<std::uint32_t>(i), t);
                bad |= !(std::abs(x[i]) <= largest) | !(std::abs(y[i]) <= largest);
            }
            return bad != 0;
        });
    if (lost) requireFinite(bodies.read(), team_);
}

/// Whether bodies are to be placed at the end of the step. If not, whoever wants to see them has
/// them placed (BodyStore), on one thread; and nobody would notice in this step if one got lost.
template <class Real, class Path>
bool ContinuousLaw<Real, Path>::someoneLooks(const Step<Real>& step) const {
    constexpr auto most = static_cast<double>(std::numeric_limits<Real>::max());
    const double anchors = farthest_ + gainOf() * fastest_ * std::abs(step.to);
    return team_.size() > 1 || !(16 * anchors < most);
}

/// The largest half extent of any body, px.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::largestHalf(const BodyView<Real>& bodies) const {
    const auto largest = [](std::span<const Real> values, Real most) {
        for (const Real value : values) most = std::max(most, value);
        return most;
    };
    const auto& m = bodies.moving;
    Real most = std::max(largest(m.halfWidth.values, m.halfWidth.common),
                         largest(m.halfHeight.values, m.halfHeight.common));
    most = largest(bodies.fixed.halfWidth, most);
    return static_cast<double>(largest(bodies.fixed.halfHeight, most));
}

/// Looks at the speeds and positions of all bodies, at a time when they are up to date.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::survey(const LawBodies<Real>& bodies) {
    const auto& m = bodies.moving;
    const auto largest = [&](std::span<const Real> along, std::span<const Real> across) {
        return static_cast<double>(team_.template maximum<Real>(
            along.size(), &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
                Real most = 0;
#pragma omp simd reduction(max : most)
                for (std::size_t i = begin; i < end; ++i) {
                    const Real x = std::abs(along[i]);
                    const Real y = std::abs(across[i]);
                    const Real larger = x > y ? x : y;
                    most = larger > most ? larger : most;
                }
                return most;
            }));
    };
    // A body that rests falls only after an event.
    const auto accelerated = [&](std::size_t i, int axis) {
        if constexpr (falls) {
            return gravityAlong(axis) != 0 && (bodies.rests[i] & axisBit(axis)) == 0;
        }
        return false;
    };
    farthest_ = largest(m.x, m.y);
    fastest_ = largest(m.vx, m.vy);
    const auto rows = static_cast<double>(m.size());
    speedSum_ = sumOver(m.size(), [&](std::size_t i) { return speedOf(m, i); });
    squareSum_ = sumOver(m.size(), [&](std::size_t i) { return speedOf(m, i) * speedOf(m, i); });
    sizeSum_ = m.halfWidth.uniform() && m.halfHeight.uniform()
                   ? rows * static_cast<double>(m.halfWidth.common + m.halfHeight.common)
                   : sumOver(m.size(), [&](std::size_t i) {
                         return static_cast<double>(m.halfWidth[i] + m.halfHeight[i]);
                     });
    largest_ = largestHalf(bodies.read());
    gravityNow_ = 0;
    for (int axis = 0; falls && axis < 2; ++axis) {
        const bool any = team_.any(m.size(), &Thresholds::streamed, [&](auto begin, auto end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (accelerated(i, axis)) return true;
            }
            return false;
        });
        if (any) gravityNow_ = std::max(gravityNow_, std::abs(gravityAlong(axis)));
    }
}

template <class Real, class Path>
template <class Function>
double ContinuousLaw<Real, Path>::sumOver(std::size_t rows, Function&& function) const {
    return team_.sum(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t i = begin; i < end; ++i) part += function(i);
        return part;
    });
}

/// The sum over the bodies of the area in which another's centre makes a candidate pair, px^2, of a
/// partition that covers a life of so many s.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::areaOf(std::size_t rows, double life) const {
    const auto count = static_cast<double>(rows);
    const double size = sizeSum_ / count;
    const double gain = gainOf();
    // All have the common bound at least.
    const double sum = std::max(speedSum_, count * common_);
    const double squareSum = std::max(squareSum_, count * common_ * common_);
    const double speeds = gain * (sum + count * gravityNow_ * life);
    const double squares = gain * gain * squareSum + 2 * gain * gravityNow_ * life * speeds;
    return count * size * size + 4 * size * life * speeds + 4 * life * life * squares;
}

/// For how long the next partition is to cover the bodies, s: the longer, the seldomer it is built,
/// and the more pairs it shows. `rest` is what is left of the step. The result does not depend on
/// the choice.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::chooseLife(std::size_t rows, double rest) {
    constexpr double longest = 60;  // s

    const auto count = static_cast<double>(rows);
    const double size = sizeSum_ / count;
    const double gain = gainOf();
    const auto costOf = [&](double life) {
        const double pairs = density_ * areaOf(rows, life);
        return (buildPrice * count + collectPrice * pairs) / life +
               againPrice * eventRate_ * 4 * pairs / count;
    };
    // From the time in which a typical body gets on by a hundredth of its size.
    const double typical = gain * speedSum_ / count;
    const double fall = gravityNow_ > 0 ? std::sqrt(0.02 * size / (gain * gravityNow_)) : longest;
    double best = std::min({longest, fall, typical > 0 ? 0.01 * size / typical : longest});
    // Enormous speeds would make it so short that time stands still. Not against all of a long
    // step: what is short beside that may be long beside a collision.
    const double span = std::max(std::min(rest, 1.0), 1e-3 * rest);
    if (!(best >= 1e-5 * span)) return shortestLife_ = span;
    shortestLife_ = best;
    // The first partitions show how crowded it is, step by step: pairs grow with the square.
    const double most = life_ > 0 ? std::min(4 * life_, longest) : best;
    for (double life = best; life < most; life *= 1.25) {
        if (costOf(life) < costOf(best)) best = life;
    }
    return best;
}

template <class Real, class Path>
std::optional<Reach<Real>> ContinuousLaw<Real, Path>::reach(const LawBodies<Real>& bodies,
                                                            double now, double to) {
    if (now < horizon_) return std::nullopt;
    const auto& m = bodies.moving;
    if (m.size() == 0) {
        horizon_ = to;
        return Reach<Real>{};
    }
    uniformMass_ = m.mass.uniform();
    place(bodies, now);
    survey(bodies);
    const double elapsed = now - partitionTime_;
    eventRate_ = elapsed > 0 ? static_cast<double>(eventsSince_) / elapsed : 0;
    // Bounds that events break again and again are too narrow. Few that are much faster than the
    // others have bounds of their own, or all boxes would grow with the fastest.
    outlier_ = outran_ ? std::min(4 * outlier_, 1e9) : std::max(outlier_ / 2, leastOutlier);
    outran_ = false;
    const double typical = outlier_ * speedSum_ / static_cast<double>(m.size());
    const bool outliers = fastest_ > typical;
    common_ = outliers ? typical : fastest_;
    life_ = chooseLife(m.size(), to - now);
    const double life = life_;
    editsSince_ = 0;
    horizon_ = now + life;
    partitionTime_ = now;
    eventsSince_ = 0;

    const double gain = gainOf();
    const double gained = gravityNow_ * life;
    const auto boundOf = [&](double speed) { return gain * (speed + gained); };
    bounds_.common = boundOf(common_);
    bounds_.own = nullptr;
    farthest_ += boundOf(fastest_) * life;
    const auto wayAt = [&](double bound) {
        return static_cast<Real>(reachOfLife<Real>(bound, life, farthest_, largest_, mostEdits));
    };
    Reach<Real> reach(std::max(wayAt(bounds_.common), std::numeric_limits<Real>::min()));
    if (outliers) {
        ownBounds_.resize(m.size());
        ownReach_.resize(m.size());
        for (std::size_t i = 0; i < m.size(); ++i) {
            ownBounds_[i] = std::max(bounds_.common, boundOf(speedOf(m, i)));
            ownReach_[i] = wayAt(ownBounds_[i]);
        }
        bounds_.own = ownBounds_.data();
        reach.own = ownReach_;
    }
    return reach;
}

/// All meetings of candidates between `from` and `to`.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::findAll(const Search& search, double from, double to) {
    const unsigned workers = team_.workersFor(candidates_.size(), &Thresholds::tested);
    const auto findShare = [&](unsigned worker, EventQueue& queue) {
        const auto find = [&](auto pairs) { search.findAmong(pairs, from, to, queue); };
        candidates_.forShare(worker, workers, find, find);
    };
    if (workers == 1) {
        findShare(0, events_.queue);
        return;
    }
    team_.run(workers, [&](unsigned worker) {
        found_[worker].events.collect();
        findShare(worker, found_[worker].events);
    });
    for (Found& found : found_) events_.queue.take(found.events);
}

template <class Real, class Path>
double ContinuousLaw<Real, Path>::advance(const LawBodies<Real>& bodies,
                                          const Partition<Real>& partition, double now,
                                          Step<Real>& step) {
    done_.reset();
    const double done = runEvents(bodies, partition, now, step);
    placed_ = false;
    step.clock.finish(Phase::Resolve);
    if (someoneLooks(step)) place(bodies, done);
    done_ = done;
    step.clock.finish(Phase::Integrate);
    return done;
}

/// Runs the events from `now` on, to the end of the step or of what the partition covers, or to an
/// event that makes a body too fast for it. Returns the time of that.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::runEvents(const LawBodies<Real>& bodies,
                                            const Partition<Real>& partition, double now,
                                            Step<Real>& step) {
    double to = std::min(step.to, horizon_);
    const double stretch = sharedStretch(now, step.to - now);
    const bool shares = stretch > 0;
    if (shares) to = std::min(to, now + stretch);
    const Motion motion = motionOf(bodies);
    const Search search(motion, neighbours_, stamps_, sketches_);
    const bool fresh = candidates_.update(bodies.read(), partition);
    if (fresh) {
        neighbours_.link(bodies.moving.size(), candidates_);
        // Meetings do not depend on steps, so they are found for as long as the pairs last. What an
        // event has led to at this very moment stays.
        sketches_.draw(motion, bodies.moving.size(),
                       {.from = now,
                        .to = horizon_,
                        .farthest = farthest_,
                        .fastest = fastestAllowed(),
                        .largest = largest_,
                        .gravity = std::max(std::abs(gravityX_), std::abs(gravityY_))},
                       team_);
        events_.queue.forgetAfter(now);
        events_.queue.begin(to, eventOrder(motion.bodies));
        events_.queue.collect();
        findAll(search, now, horizon_);
        events_.queue.spread(now, horizon_);
        step.counts.pairsTested += candidates_.size();
        noteDensity(bodies.moving.size());
        mostEvents_ = eventsWorthTheLife(bodies.moving.size());
    } else {
        events_.queue.begin(to, eventOrder(motion.bodies));
    }

    using Loop = EventLoop<Real, Path>;
    const EventWindow window{
        .to = to, .horizon = horizon_, .bounds = bounds_, .mostEvents = mostEvents_ - eventsSince_};
    Loop loop(search, events_, window);
    const auto neighboursOf = [&](std::uint32_t row) { return neighbours_[row]; };
    loop.releaseFromChanged(now);
    if (!coversChanged(motion, now, fresh)) {
        horizon_ = now;
        return now;
    }
    loop.findForChanged(now, neighboursOf);
    const std::uint64_t before = step.counts.events;
    if (shares && runShared(bodies, search, window, now, step)) {
        eventsSince_ += step.counts.events - before;
        return to;
    }
    const std::uint64_t usual = usualEventsPerBody * (bodies.moving.size() + 1);
    const auto count = [&](const PairEvent& event) {
        if (++step.counts.events > usual) requireProgress(bodies.read(), event);
        return true;
    };
    const auto collided = [&](const PairEvent&, const ContactRecord& record) {
        ++step.counts.contacts;
        ++step.counts.collisions;
        if (step.keepContacts) records_.push_back(record);
    };
    const bool complete = loop.run(count, collided, neighboursOf);
    eventsSince_ += step.counts.events - before;
    if (complete) return to;
    // A body has become too fast, or pairs too dear; the search goes on with another partition.
    outran_ = eventsSince_ <= mostEvents_;
    horizon_ = loop.stoppedAt();
    return horizon_;
}

/// How fast a body within its bounds is at most until the horizon, px/s along an axis.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::fastestAllowed() const {
    return gainOf() * (fastest_ + gravityNow_ * (horizon_ - partitionTime_));
}

/// A stretch of time in which bodies stay so close to where they are that few concern each other,
/// and whose events threads share out, s; 0 if that brings nothing. `rest` is what is left of the
/// step.
template <class Real, class Path>
double ContinuousLaw<Real, Path>::sharedStretch(double now, double rest) {
    if (!shared_) return 0;
    const double size = sizeSum_ / static_cast<double>(stamps_.size());
    const double stretch = size / (6 * fastestAllowed());
    // Many stretches a step cost more than they bring, and one may be so short that time stands
    // still.
    if (!(now + stretch > now) || stretch < rest / 16) return 0;
    // As many events are expected as before.
    const auto fewest = static_cast<double>(team_.thresholds().events);
    if (eventRate_ * std::min(stretch, rest) < fewest) return 0;
    return shared_->isWorthATry() ? stretch : 0;
}

/// Throws Error for a body that has so many events in this step that it would hardly ever end.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::requireProgress(const BodyView<Real>& bodies,
                                                const PairEvent& event) {
    eventsOf_.resize(bodies.moving.size());
    const auto countFor = [&](std::uint32_t row) {
        if (++eventsOf_[row] <= mostEventsOfABody) return;
        const auto& others = event.withStatic() ? bodies.fixed.entity : bodies.moving.entity;
        throw Error("the law 'continuous': entity " +
                    std::to_string(bodies.moving.entity[event.a]) + " collided more than " +
                    std::to_string(mostEventsOfABody) + " times in one step, with entity " +
                    std::to_string(others[event.b.row()]) + " at " + std::to_string(event.time) +
                    " s; there is hardly any room between them and what holds them");
    };
    countFor(event.a);
    if (!event.withStatic()) countFor(event.b.row());
}

/// After how many events the candidate pairs have cost several times what a new partition would,
/// of those that one of the shortest life would not show: more happens than was expected when their
/// life was chosen.
template <class Real, class Path>
std::uint64_t ContinuousLaw<Real, Path>::eventsWorthTheLife(std::size_t rows) const {
    constexpr double patience = 4;
    const auto count = static_cast<double>(rows);
    const auto pairs = static_cast<double>(candidates_.size());
    const double spared = pairs - density_ * areaOf(rows, shortestLife_);
    const double build = buildPrice * count + collectPrice * pairs;
    const double events = patience * build * count / (4 * againPrice * spared);
    constexpr auto most = std::numeric_limits<std::uint64_t>::max();
    // In a crowd, where all are near, no partition shows fewer.
    return spared > 0 && events < 1e18 ? static_cast<std::uint64_t>(events) + 1 : most;
}

/// How many bodies there are around each, from the pairs that the partition shows.
template <class Real, class Path>
void ContinuousLaw<Real, Path>::noteDensity(std::size_t rows) {
    const double area = areaOf(rows, life_);
    if (area > 0) density_ = static_cast<double>(candidates_.size()) / area;
}

template <class Real, class Path>
bool ContinuousLaw<Real, Path>::runShared(const LawBodies<Real>& bodies, const Search& search,
                                          const EventWindow& window, double now, Step<Real>& step) {
    const double way =
        islandWay<Real>(fastestAllowed(), window.to - now, window.to, farthest_, largest_, falls);
    std::vector<ContactRecord>* const records = step.keepContacts ? &records_ : nullptr;
    return shared_->run(bodies.read(), search, events_, window, way, records, step.counts);
}

template <class Real, class Path>
std::size_t ContinuousLaw<Real, Path>::bytes() const {
    std::size_t sum =
        candidates_.bytes() + neighbours_.bytes() + sketches_.bytes() + events_.bytes() +
        ownBounds_.capacity() * sizeof(double) + ownReach_.capacity() * sizeof(Real) +
        stamps_.capacity() * sizeof(std::uint32_t) + found_.capacity() * sizeof(Found) +
        eventsOf_.capacity() * sizeof(std::uint32_t) + records_.capacity() * sizeof(ContactRecord);
    for (const Found& found : found_) sum += found.events.bytes();
    sum += events_.gathered->capacity() * sizeof(std::uint64_t);
    return shared_ ? sum + shared_->bytes() : sum;
}

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeContinuousLaw(const SimulationConfig& config,
                                                    const ThreadTeam& team) {
    if (config.step.gravity == Vec2(0, 0)) {
        return std::make_unique<ContinuousLaw<Real, StraightPath>>(config.step, team);
    }
    return std::make_unique<ContinuousLaw<Real, FallingPath>>(config.step, team);
}

template std::unique_ptr<ContactLaw<double>> makeContinuousLaw(const SimulationConfig&,
                                                               const ThreadTeam&);
template std::unique_ptr<ContactLaw<float>> makeContinuousLaw(const SimulationConfig&,
                                                              const ThreadTeam&);

}  // namespace quadrille
