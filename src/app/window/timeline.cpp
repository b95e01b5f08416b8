#include "app/window/timeline.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

namespace quadrille::app {

namespace {

/// Beside what World::bytes counts: the colour of a body, and where it is found.
constexpr std::size_t bytesOfColor = 20;

std::size_t bytesOf(const World& world) {
    return world.bytes() + bytesOfColor * (world.movingCount() + world.staticCount());
}

/// What the past is run with: the results are the same, and a device has room for one run.
SimulationConfig forPast(SimulationConfig config) {
    if (needsDevice(config.resolver)) config.resolver = ResolverKind::Sequential;
    config.keepContacts = true;
    config.profile = false;
    config.countMissedPairs = false;
    return config;
}

}  // namespace

void Timeline::begin(const Simulation& run) {
    run_ = &run;
    kept_.clear();
    nearby_.clear();
    parts_ = {{run.stepsDone(), run.config()}};
    hashes_.clear();
    firstHash_ = run.stepsDone();
    past_.reset();
    between_.reset();
    stride_ = 1;
    keep();
    hashes_.push_back(stateHash(run.world()));
}

bool Timeline::Part::repeats() const {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&config.partitioner);
    const bool misses =
        tree != nullptr && std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
    return config.law != Law::Baseline && !misses;
}

void Timeline::record() {
    hashes_.push_back(stateHash(run_->world()));
    if (!parts_.back().repeats() || (last() - firstHash_) % stride_ == 0) keep();
}

void Timeline::change() {
    if (parts_.back().from == last()) parts_.pop_back();
    parts_.push_back({last(), run_->config()});
    past_.reset();
    keep();
}

void Timeline::keep() {
    kept_.insert_or_assign(last(), run_->snapshot());
    stateBytes_ = bytesOf(run_->world());
    makeRoom();
}

/// Half of the memory is for the states nearby.
void Timeline::makeRoom() {
    const std::size_t most = std::max<std::size_t>(memory_ / 2 / stateBytes_, 2);
    const auto isNeeded = [&](const auto& state) {
        const Part& part = parts_[partOf(state.first)];
        // What comes after a gap could not be made again.
        return part.from == state.first || !part.repeats();
    };
    while (kept_.size() > most) {
        const auto needed = std::count_if(kept_.begin(), kept_.end(), isNeeded);
        if (2 * std::size_t(needed) > kept_.size()) {
            kept_.erase(kept_.begin());
            continue;
        }
        stride_ *= 2;
        std::erase_if(kept_, [&](const auto& state) {
            return !isNeeded(state) && (state.first - firstHash_) % stride_ != 0;
        });
    }
}

const Snapshot* Timeline::lastUpTo(std::uint64_t step) const {
    const Snapshot* found = nullptr;
    for (const States* states : {&kept_, &nearby_}) {
        const auto after = states->upper_bound(step);
        if (after == states->begin()) continue;
        const Snapshot& state = std::prev(after)->second;
        if (found == nullptr || state.stepsDone > found->stepsDone) found = &state;
    }
    return found;
}

/// The part in which the step after this one is made.
std::size_t Timeline::partOf(std::uint64_t step) const {
    std::size_t part = parts_.size() - 1;
    while (part > 0 && parts_[part].from > step) --part;
    return part;
}

void Timeline::restore(const Snapshot& state, std::size_t part) {
    if (!past_ || pastPart_ != part) {
        past_.emplace(state.world.clone(), forPast(parts_[part].config));
        pastPart_ = part;
    }
    past_->restore(state);
}

/// Keeps states between the last kept one and the next, as many as there is room for.
void Timeline::keepNearby() {
    const std::uint64_t step = past_->stepsDone();
    const auto next = kept_.upper_bound(step);
    if (next == kept_.begin()) return;
    const std::uint64_t from = std::prev(next)->first;
    const std::uint64_t to = next == kept_.end() ? last() : next->first;
    std::erase_if(nearby_,
                  [&](const auto& state) { return state.first < from || state.first > to; });
    const std::size_t most = std::max<std::size_t>(memory_ / 2 / stateBytes_, 1);
    const std::uint64_t apart = (to - from) / most + 1;
    if (step == from || (step - from) % apart != 0 || nearby_.size() >= most) return;
    nearby_.try_emplace(step, past_->snapshot());
}

bool Timeline::goTo(std::uint64_t step, Clock::time_point until) {
    step = std::clamp(step, first(), last());
    // From one step before, so that there are contacts to show.
    const std::uint64_t before = step > first() ? step - 1 : step;
    const std::size_t part = partOf(before);
    const bool repeats = parts_[part].repeats();
    const Snapshot* const start = lastUpTo(repeats ? before : step);
    const bool onTheWay = past_ && pastPart_ == part && repeats && past_->stepsDone() <= step &&
                          past_->stepsDone() >= start->stepsDone;
    if (!onTheWay) restore(*start, part);
    while (past_->stepsDone() < step) {
        past_->step();
        keepNearby();
        if (Clock::now() > until) break;
    }
    return past_->stepsDone() == step;
}

const Simulation& Timeline::between(double share) {
    SimulationConfig config = past_->config();
    config.step.dt *= share;
    World world = past_->world().clone();
    // Its times are counted from here, as after an edit.
    world.editBodies([](const auto&) {});
    between_.emplace(std::move(world), config);
    between_->step();
    between_->resumeAt(past_->stepsDone());
    return *between_;
}

std::size_t Timeline::bytes() const {
    return (kept_.size() + nearby_.size()) * stateBytes_ + hashes_.size() * sizeof(hashes_[0]);
}

}  // namespace quadrille::app
