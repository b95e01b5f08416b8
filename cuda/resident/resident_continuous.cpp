#include "cuda/resident/resident_continuous.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "collision/rules/closeness.hpp"
#include "cuda/device/range.hpp"
#include "cuda/resident/resident_grid.hpp"

namespace quadrille::cuda {

namespace {

/// Parts of a step at most.
constexpr std::uint32_t mostParts = 64;
/// After so many steps without trouble, longer windows are tried again.
constexpr std::uint32_t calmEnough = 64;
/// Windows of a partition at most.
constexpr std::uint32_t mostWindows = 32;
/// Tries of a step that fail.
constexpr std::uint32_t mostTroubles = 32;
/// Pairs a body that are worth a partition.
constexpr double mostPairs = 48;
/// Bodies get on by so much of their extent in a window at most.
constexpr double mostWay = 0.5;
/// No shorter windows: many of them in one of the cells of time that say what is jammed
/// (collision/continuous/bursts.hpp), s.
constexpr double shortestWindow = 0x1p-18;

/// What a partition costs a body, against what a pair costs in it (docs/performance.md).
constexpr double buildPrice = 1, pairPrice = 0.9;

std::uint32_t withRoom(std::uint64_t count) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(count + count / 2 + 1024, none / 2));
}

}  // namespace

template <class Real>
ResidentContinuous<Real>::ResidentContinuous(const SimulationConfig& config, const Vec2& worldSize,
                                             const ThreadTeam& team)
    : config_(config), worldSize_(worldSize), device_(config.cuda, team) {
    result_.reserve(1);
    device_.reserveZeroed(counts_, 2);
    device_.reserveZeroed(survey_, 2);
}

template <class Real>
bool ResidentContinuous<Real>::runs() const {
    return staysOnDevice(Law::Continuous, config_.step);
}

template <class Real>
ExactMotion<Real, StraightPath> ResidentContinuous<Real>::motion() const {
    return {.bodies = bodies_.bodies(), .gravityX = 0, .gravityY = 0, .restitution = 1};
}

/// What decides how time is cut and how far a partition reaches. The result does not depend on it.
template <class Real>
void ResidentContinuous<Real>::measure(const BodyView<Real>& bodies) {
    const auto largestOf = [&](auto&&... columns) {
        double most = 0;
        const auto take = [&](std::span<const Real> values) {
            for (const Real value : values) {
                most = std::max(most, std::abs(static_cast<double>(value)));
            }
        };
        (take(columns), ...);
        return most;
    };
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    uniformMass_ = m.mass.uniform();
    extent_ = meanExtent(bodies);
    largest_ = std::max(
        {largestOf(m.halfWidth.values, m.halfHeight.values, f.halfWidth, f.halfHeight),
         static_cast<double>(m.halfWidth.common), static_cast<double>(m.halfHeight.common)});
    fastest_ = largestOf(m.vx, m.vy);
    farthest_ = largestOf(m.x, m.y, f.x, f.y);
    density_ = static_cast<double>(m.size()) / (worldSize_.x() * worldSize_.y());
}

template <class Real>
bool ResidentContinuous<Real>::load(const LawBodies<Real>& bodies, double now, PhaseClock& clock) {
    const std::size_t rows = bodies.moving.size();
    const ExactMotion<Real, StraightPath> here{bodies.plain(), 0, 0, 1};
    const bool elsewhere =
        device_.team().any(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                if (!here.isPlaced(static_cast<std::uint32_t>(row), now)) return true;
            }
            return false;
        });
    if (elsewhere) return false;
    const BodyView<Real> view = bodies.read();
    bodies_.load(view, clock, bodies.anchors);
    measure(view);
    for (DeviceArray<std::uint32_t>* array :
         {&stamps_, &parents_, &firstEvent_, &changedIn_, &busyIn_, &eventOf_}) {
        array->reserve(rows);
    }
    device_.fill(stamps_, 0);
    marks_.reserve(rows);
    forgetWindows();
    device_.fill(parents_, 0xff);
    device_.fill(firstEvent_, 0xff);
    starts_.reserve(rows + 1);
    sketches_.reserve(rows);
    sumCounts(device_.launch(), nullptr, scratchBytes_, starts_.data(),
              static_cast<std::uint32_t>(rows));
    scratch_.reserve(scratchBytes_);
    if (eventRoom_ == 0) {
        const auto count = static_cast<std::uint32_t>(rows);
        eventRoom_ = entryRoom_ = withRoom(count / 8);
        claimedRoom_ = withRoom(count / 4);
    }
    expected_ = {entryRoom_, eventRoom_, eventRoom_ / 4, claimedRoom_};
    now_ = now;
    cells_ = {};
    cellsHere_ = true;
    margin_ = 0;
    lists_ = {};
    done_ = 0;
    parts_ = 1;
    calm_ = 0;
    return true;
}

/// Parts of a step of such a length in which bodies get on by little; 0 if they would be too short.
template <class Real>
std::uint32_t ResidentContinuous<Real>::partsOf(double length) const {
    const double way = 2 * fastest_ * length;
    std::uint32_t parts = parts_;
    while (parts <= mostParts && way > mostWay * extent_ * parts) parts *= 2;
    return parts <= mostParts && length / parts >= shortestWindow ? parts : 0;
}

/// Pairs a body that a partition for so many s shows.
template <class Real>
double ResidentContinuous<Real>::pairsOf(double life) const {
    const double side = 2 * (extent_ + 2 * gain() * fastest_ * life);
    return density_ * side * side / 2;
}

/// Corrects what is known of the density by the pairs that a partition shows.
template <class Real>
void ResidentContinuous<Real>::noteDensity(std::uint64_t pairs) {
    const double found = static_cast<double>(pairs) / bodies_.movingCount();
    if (found > 0) density_ *= found / pairsExpected_;
}

/// For how many windows of such a length the next partition is to last: the more, the seldomer it
/// is made, and the more pairs it shows.
template <class Real>
std::uint32_t ResidentContinuous<Real>::chooseWindows(double length) const {
    const auto costOf = [&](std::uint32_t windows) {
        return (buildPrice + pairPrice * pairsOf(windows * length)) / windows;
    };
    std::uint32_t best = 1;
    for (std::uint32_t windows = 2; windows <= mostWindows; ++windows) {
        if (costOf(windows) < costOf(best)) best = windows;
    }
    return best;
}

/// Whether the next window of the partition is this one.
template <class Real>
bool ResidentContinuous<Real>::covers(double from, double to) const {
    if (done_ >= lists_.windows) return false;
    const double begins = (from - lists_.from) * lists_.perSecond;
    const double ends = (to - lists_.from) * lists_.perSecond;
    return std::abs(begins - done_) < mostDifference &&
           std::abs(ends - (done_ + 1)) < mostDifference;
}

template <class Real>
EventBodies<Real> ResidentContinuous<Real>::eventBodies(bool record) const {
    const double life = lists_.windows / lists_.perSecond;
    return {.motion = motion(),
            .starts = starts_.data(),
            .others = others_.data(),
            .lists = lists_,
            // Times of steps are rounded.
            .horizon = lists_.from + life + unsureOfEnds / lists_.perSecond,
            .bound = bound_,
            .sketches = sketches_.data(),
            .slack = slack_,
            .stamps = stamps_.data(),
            .parents = parents_.data(),
            .firstEvent = firstEvent_.data(),
            .changedIn = changedIn_.data(),
            .marks = marks_.data(),
            .busyIn = busyIn_.data(),
            .eventOf = eventOf_.data(),
            .events = events_.data(),
            .fates = fates_.data(),
            .anchorsOf = anchorsOf_.data(),
            .recordOf = recordOf_.data(),
            .concerned = concerned_.data(),
            .nextEvent = nextEvent_.data(),
            .roots = roots_.data(),
            .eventRoom = eventRoom_,
            .claimed = claimed_.data(),
            .before = before_.data(),
            .claimedRoom = claimedRoom_,
            .records = record ? recorded_.data() : nullptr,
            .recordRoom = recordRoom_,
            .counts = counts_.data() + number_ % 2,
            .nextCounts = counts_.data() + (number_ + 1) % 2,
            .found = bodies_.counts(),
            .pairRoom = pairRoom_,
            .gridEntries = grid_.entries(),
            .gridRoom = grid_.cells().entries,
            .badRow = grid_.badRow(),
            .survey = survey_.data()};
}

/// Partitions the bodies as they are now, for as many windows of such a length as pay, and lists
/// what happens in each. Returns whether that is worth it.
template <class Real>
bool ResidentContinuous<Real>::partition(double now, double length, Step<Real>& step) {
    const std::uint32_t rows = bodies_.movingCount();
    // Where one window is to hold very many, few of its kind.
    const std::size_t mostEntries =
        std::max(entries_.capacity(), std::size_t(mostWindows) * withRoom(rows / 4));
    const auto most = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(mostEntries / entryRoom_, 1, mostWindows));
    const std::uint32_t windows = std::min(chooseWindows(length), most);
    const double life = windows * length;
    if (pairsOf(life) > mostPairs) return false;
    pairsExpected_ = pairsOf(life);
    const auto pairs = static_cast<std::uint64_t>(pairsExpected_ * rows);
    if (pairs > none / 4) return false;
    if (pairs > pairRoom_ || pairRoom_ == 0) {
        pairRoom_ = 0;
        const std::uint32_t room = withRoom(pairs);
        pairs_.reserve(room);
        others_.reserve(2 * std::size_t(room));
        pairRoom_ = room;
    }
    entries_.reserve(std::size_t(windows) * entryRoom_);
    entryCounts_.reserve(windows);
    lists_ = {.pairs = entries_.data(),
              .counts = entryCounts_.data(),
              .windows = windows,
              .room = entryRoom_,
              .from = now,
              .perSecond = 1 / length};
    done_ = 0;
    bound_ = gain() * fastest_ * (1 + 1e-6);
    const double until = life + 2 * unsureOfEnds * length;
    const double reach =
        reachOfLife<Real>(bound_, until, farthest_ + 2 * bound_ * until, largest_, 0);
    slack_ = sketchSlack({.from = now,
                          .to = now + until,
                          .farthest = farthest_ + 2 * bound_ * until,
                          .fastest = bound_,
                          .largest = largest_,
                          .gravity = 0});
    const Real margin = std::max(static_cast<Real>(reach), std::numeric_limits<Real>::min());
    // Somewhat wider, so that it lasts: for another one, static bodies are listed anew.
    if (!(margin_ >= margin) || reach < 0.6 * margin_) {
        margin_ = static_cast<Real>(1.02) * margin;
        grid_.lay(gridFor(config_.partitioner, rows, extent_ + 2 * reach, worldSize_), worldSize_);
    }

    const Launch& launch = device_.launch();
    device_.begin(Phase::Partition, step.clock);
    device_.fill(survey_, 0, 1);
    placeAll(launch, motion(), rows, now, survey_.data(), sketches_.data());
    grid_.sort(margin_);
    bodies_.zeroCounts();
    collectCandidates(launch, bodies_.bodies(), grid_.cells(), grid_.ownership(),
                      candidateInflation(margin, static_cast<Real>(largest_)),
                      {pairs_.data(), pairRoom_, bodies_.counts()});
    device_.fill(starts_, 0, std::size_t(rows) + 1);
    const EventBodies<Real> bodies = eventBodies(false);
    countNeighbours(launch, bodies, pairs_.data(), pairRoom_, starts_.data());
    sumCounts(launch, scratch_.data(), scratchBytes_, starts_.data(), rows);
    device_.fill(entryCounts_, 0, windows);
    linkAndFind(launch, bodies, pairs_.data(), pairRoom_, starts_.data(), others_.data(), now);
    device_.end(Phase::Partition, step.clock);
    cellsHere_ = false;
    return true;
}

/// Takes away the numbers of windows.
template <class Real>
void ResidentContinuous<Real>::forgetWindows() {
    device_.fill(changedIn_, 0);
    device_.fill(busyIn_, 0);
    device_.fill(marks_, 0);
}

template <class Real>
WindowResult ResidentContinuous<Real>::run(double from, double to, Step<Real>& step) {
    // Gaps between members are copied, too.
    device_.reserveZeroed(events_, eventRoom_);
    fates_.reserve(eventRoom_);
    anchorsOf_.reserve(2 * std::size_t(eventRoom_));
    concerned_.reserve(eventRoom_);
    nextEvent_.reserve(eventRoom_);
    roots_.reserve(eventRoom_);
    claimed_.reserve(claimedRoom_);
    before_.reserve(claimedRoom_);
    if (step.keepContacts) {
        recordRoom_ = std::max(recordRoom_, withRoom(eventRoom_ / 4));
        device_.reserveZeroed(recorded_, recordRoom_);
        device_.reserveZeroed(recordOf_, eventRoom_);
    }
    if (++number_ == 0) {
        forgetWindows();
        number_ = 2;  // even, as counts take turns
    }
    const double farthest = farthest_ + bound_ * lists_.windows / lists_.perSecond;
    const Window window{.from = from,
                        .to = to,
                        .number = number_,
                        .list = done_,
                        .first = done_ == 0,
                        .close = static_cast<float>(
                            islandWay<Real>(bound_, to - from, to, farthest, largest_, false))};
    runWindow(device_.launch(), eventBodies(step.keepContacts), window, expected_, result_.data());
    device_.finish(step.clock);
    return *result_.data();
}

/// Makes room for what had none. Returns whether the window can be tried again: with shorter ones,
/// if it was crowded.
template <class Real>
bool ResidentContinuous<Real>::mend(const WindowResult& result) {
    if ((result.troubles & trouble::notFinite) != 0) return false;
    if ((result.troubles & trouble::tooFast) != 0) {
        // The survey was made before the window.
        const double surveyed = std::bit_cast<double>(result.survey.fastest);
        fastest_ = surveyed > bound_ ? surveyed : 2 * fastest_;
        lists_.windows = 0;
    }
    if ((result.troubles & trouble::partition) != 0) {
        if (result.gridEntries == none) return false;  // more than 32 bits count
        if (grid_.lacksRoom(result.gridEntries)) {
            grid_.makeRoom(std::size_t(result.gridEntries) + result.gridEntries / 16);
        } else {
            noteDensity(result.pairs);
        }
        lists_.windows = 0;
    }
    if ((result.troubles & trouble::entries) != 0) {
        entryRoom_ = withRoom(result.entries);
        lists_.windows = 0;
    }
    if ((result.troubles & trouble::events) != 0) eventRoom_ = withRoom(result.events);
    if ((result.troubles & trouble::claimed) != 0) {
        claimedRoom_ = withRoom(result.claimed);
        device_.fill(parents_, 0xff);
        device_.fill(firstEvent_, 0xff);
    }
    if ((result.troubles & trouble::records) != 0) recordRoom_ = withRoom(result.records);
    if ((result.troubles & trouble::crowded) != 0) {
        parts_ *= 2;
        calm_ = 0;
        lists_.windows = 0;
    }
    return true;
}

template <class Real>
double ResidentContinuous<Real>::step(Step<Real>& step) {
    const Range range("quadrille resident continuous");
    records_.clear();
    if (bodies_.movingCount() == 0) return now_ = step.to;
    if (++calm_ > calmEnough && parts_ > 1) {
        parts_ /= 2;
        calm_ = 0;
    }
    const double length = step.to - step.from;
    std::uint32_t parts = 0;
    std::uint32_t part = 0;
    std::uint32_t troubles = 0;
    while (now_ < step.to) {
        const std::uint32_t wanted = partsOf(length);
        if (wanted == 0) {
            parts_ = 1;
            return now_;
        }
        // What is done stays, in parts of the new length.
        if (wanted > parts) {
            part = parts == 0 ? 0 : part * (wanted / parts);
            parts = wanted;
        }
        const double to = part + 1 == parts ? step.to : step.from + length * (part + 1) / parts;
        if (!covers(now_, to)) {
            if (!partition(now_, to - now_, step)) return now_;
        }
        const WindowResult result = run(now_, to, step);
        if (result.troubles != 0) {
            if (++troubles > mostTroubles || !mend(result)) {
                lists_.windows = 0;
                return now_;
            }
            continue;
        }
        if (done_ == 0) {
            // What the partition has shown is the guess for the next one.
            fastest_ = std::bit_cast<double>(result.survey.fastest);
            farthest_ = std::max(std::bit_cast<double>(result.survey.farthest), largest_);
            noteDensity(result.pairs);
            grid_.expect(result.gridEntries);
            step.counts.pairsTested += result.pairs;
            step.rebuilt = true;
        }
        ++done_;
        ++part;
        now_ = to;
        expected_ = {withRoom(result.entries), withRoom(result.events), withRoom(result.concerned),
                     withRoom(result.claimed)};
        step.counts.contacts += result.collisions;
        step.counts.collisions += result.collisions;
        if (step.keepContacts) keepRecords(result.records);
    }
    return now_;
}

/// Brings the contacts of a window, in the order in which one thread would have them.
template <class Real>
void ResidentContinuous<Real>::keepRecords(std::uint32_t count) {
    recordedHere_.resize(count);
    device_.fetch(recordedHere_.data(), recorded_.data(), count * sizeof(RecordedContact));
    const EventOrder isLater = bodies_.hostEventOrder();
    std::sort(recordedHere_.begin(), recordedHere_.end(),
              [&](const RecordedContact& p, const RecordedContact& q) {
                  if (isLater(q.after, p.after)) return true;
                  return !isLater(p.after, q.after) && p.number < q.number;
              });
    for (const RecordedContact& recorded : recordedHere_) records_.push_back(recorded.record);
}

template <class Real>
void ResidentContinuous<Real>::fetch(const LawBodies<Real>& bodies) {
    const std::uint32_t rows = bodies_.movingCount();
    if (rows == 0) return;
    hostAnchors_.reserve(rows);
    Survey* const unread = survey_.data() + 1;
    placeAll<Real>(device_.launch(), motion(), rows, now_, unread, nullptr);
    check(cudaMemcpyAsync(hostAnchors_.data(), bodies_.bodies().moving.anchors,
                          rows * sizeof(Anchor<Real>), cudaMemcpyDeviceToHost,
                          device_.launch().stream),
          "copy from the device");
    bodies_.fetch(bodies);
    device_.team().shares(rows, &Thresholds::copied, [&](std::size_t b, std::size_t e, unsigned) {
        std::copy_n(hostAnchors_.data() + b, e - b, bodies.anchors.begin() + b);
    });
}

template <class Real>
const Cells& ResidentContinuous<Real>::cells() {
    if (!cellsHere_) grid_.fetch(cells_);
    cellsHere_ = true;
    return cells_;
}

template <class Real>
std::size_t ResidentContinuous<Real>::bytes() const {
    return device_.memoryUsed() + bodies_.hostBytes() + result_.bytes() + hostAnchors_.bytes() +
           recordedHere_.capacity() * sizeof(RecordedContact) +
           records_.capacity() * sizeof(ContactRecord);
}

template class ResidentContinuous<double>;
template class ResidentContinuous<float>;

}  // namespace quadrille::cuda

namespace quadrille {

template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentContinuous(const SimulationConfig& config,
                                                               const Vec2& worldSize,
                                                               const ThreadTeam& team) {
    return std::make_unique<cuda::ResidentContinuous<Real>>(config, worldSize, team);
}

#define QUADRILLE_INSTANTIATE(Real)                                          \
    template std::unique_ptr<ResidentPipeline<Real>> makeResidentContinuous( \
        const SimulationConfig&, const Vec2&, const ThreadTeam&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille
