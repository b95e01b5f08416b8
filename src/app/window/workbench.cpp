#include "app/window/workbench.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <quadrille/names.hpp>

#include "app/scene_catalog.hpp"
#include "app/window/body_colors.hpp"

namespace quadrille::app {

namespace {

/// Steps of one picture may take this long; then it is shown, and the rest is dropped.
constexpr std::chrono::milliseconds longestStepping{40};
/// The past moves by so many seconds from one picture to the next at most.
constexpr double longestPast = 0.25;

/// So many further on in the list, the first after the last.
template <class Kind>
Kind nextOf(std::span<const Named<Kind>> all, Kind kind, std::size_t further) {
    std::size_t i = 0;
    while (i < all.size() && all[i].kind != kind) ++i;
    return all[(i + further) % all.size()].kind;
}

}  // namespace

Workbench::Workbench(const Options& options)
    : filmed_(!options.window.video.empty()),
      pacer_(1, options.window.speed.value_or(options.window.offscreen && !filmed_ ? 0 : 1)),
      paused_(options.window.paused) {
    for (const std::string& name : sceneNames()) {
        scenes_.push_back({name, quadrille::app::aboutScene(findScene(name))});
    }
    start(setUp(options), options);
}

void Workbench::start(Run run, Options options) {
    for (Run* each : {&run, run.beside.get()}) {
        if (each == nullptr) continue;
        ensureRenderers(each->simulation.world());
        // The panels show the phases of every step.
        SimulationConfig config = each->simulation.config();
        config.profile = true;
        each->simulation.reconfigure(config);
    }
    // Outputs have one writer: the old session's go before the new one's come.
    std::optional<Shown> shown;
    if (session_) shown = session_->statistics().shown;
    session_.reset();
    options_ = std::make_unique<Options>(std::move(options));
    session_ = std::make_unique<RunSession>(std::move(run), *options_);
    about_ = startsFromScene() ? quadrille::app::aboutScene(findScene(options_->scene)) : "";
    session_->statistics().shown = std::move(shown);
    const RunBeside* beside = session_->beside();
    const double steps = beside != nullptr ? double(beside->stepsPerMeeting()) : 1;
    pacer_ = Pacer(steps * config().step.dt, pacer_.speed());
    comparison_.clear();
    shown_ = &session_->simulation();
    lookingBack_ = backwards_ = seeking_ = false;
    trails_.clear();
    recordTrails();
    timeline_.reset();
    if (options_->window.history > 0 && beside == nullptr) {
        timeline_.emplace(options_->window.history);
        timeline_->begin(session_->simulation());
    }
    listening_ = false;
    contacts_.clear();
    hits_.clear();
    lastStep_ = {};
    selected_.reset();
    following_ = false;
    listen();
    ++cellsVersion_;
    ++runVersion_;
}

// ---- time

void Workbench::togglePause() {
    paused_ = !paused_;
    pacer_.drop();
}

void Workbench::singleStep() {
    paused_ = true;
    if (lookingBack_) return lookAt(std::floor(place_) + 1);
    if (!done()) step();
}

void Workbench::setSpeed(double speed) {
    pacer_.setSpeed(speed);
    pacer_.drop();
}

void Workbench::changeSpeed(bool faster) {
    const auto rank = [](double speed) {
        return speed == 0 ? std::numeric_limits<double>::infinity() : speed;
    };
    const double now = rank(speed());
    if (faster) {
        for (const double candidate : offeredSpeeds) {
            if (rank(candidate) > now) return setSpeed(candidate);
        }
    } else {
        for (auto it = std::rbegin(offeredSpeeds); it != std::rend(offeredSpeeds); ++it) {
            if (rank(*it) < now) return setSpeed(*it);
        }
    }
}

int Workbench::advance(double seconds) {
    if (lookingBack_) {
        movePast(seconds);
        return 0;
    }
    if (paused_) return 0;
    pacer_.pass(seconds);
    const auto start = Clock::now();
    int steps = 0;
    while (!done() && pacer_.take(steps)) {
        step();
        ++steps;
        if (!filmed_ && Clock::now() - start > longestStepping) {
            pacer_.drop();
            break;
        }
    }
    return steps;
}

void Workbench::step() {
    contacts_.clear();
    const ResolverKind before = config().resolver;
    const RunBeside* beside = session_->beside();
    // What two runs show is of one time.
    do {
        lastStep_ = session_->step();
        cellsVersion_ += lastStep_.rebuilt;
        for (std::size_t i = 0; i < phaseCount; ++i) phases_[i] += lastStep_.phaseSeconds[i];
        errorSeconds_ += session_->errorSeconds();
    } while (beside != nullptr && !beside->met() && !done());
    if (config().resolver != before) sayFallback();
    if (beside != nullptr && beside->met()) comparison_.add(*beside->last());
    if (timeline_) timeline_->record();
    recordTrails();
}

// ---- the past

double Workbench::place() const {
    return lookingBack_ ? place_ : double(session_->simulation().stepsDone());
}

std::uint64_t Workbench::firstPlace() const { return timeline_ ? timeline_->first() : lastPlace(); }

void Workbench::lookAt(double place) {
    if (!timeline_) return;
    if (place >= double(lastPlace())) return toNewest();
    place_ = std::max(place, double(firstPlace()));
    lookingBack_ = true;
    showPast();
}

void Workbench::stepBack() {
    paused_ = true;
    lookAt(std::ceil(place()) - 1);
}

void Workbench::playBackwards() {
    if (!timeline_ || (!backwards_ && place() <= double(firstPlace()))) return;
    backwards_ = !backwards_;
    paused_ = false;
    if (backwards_ && !lookingBack_) lookAt(std::nextafter(place(), 0));
}

void Workbench::toNewest() {
    shown_ = &session_->simulation();
    lookingBack_ = backwards_ = seeking_ = false;
    contacts_.clear();
    ++cellsVersion_;
    pacer_.drop();
}

void Workbench::movePast(double seconds) {
    if (paused_) {
        if (seeking_) showPast();
        return;
    }
    // What is not reached yet need not move on.
    if (seeking_) return showPast();
    const double steps =
        speed() == 0 ? 1 : std::min(seconds, longestPast) * speed() / config().step.dt;
    lookAt(place_ + (backwards_ ? -steps : steps));
    if (backwards_ && place_ <= double(firstPlace())) {
        backwards_ = false;
        paused_ = true;
    }
}

void Workbench::showPast() {
    const double step = std::floor(place_);
    seeking_ = !timeline_->goTo(static_cast<std::uint64_t>(step), Clock::now() + longestStepping);
    shown_ = &timeline_->past();
    const auto found = shown_->contacts();
    contacts_.assign(found.begin(), found.end());
    if (!seeking_ && place_ > step && shown_->config().law == Law::Continuous) {
        shown_ = &timeline_->between(place_ - step);
    }
    pastHash_ = stateHash(shown_->world());
    if (shown_ == &timeline_->past()) recordTrails();
    ++cellsVersion_;
}

std::uint64_t Workbench::shownHash() const {
    return lookingBack_ ? pastHash_ : timeline_->hashAt(lastPlace());
}

std::optional<bool> Workbench::sameAsOnTheWay() const {
    if (!lookingBack_ || shown_ != &timeline_->past()) return std::nullopt;
    return pastHash_ == timeline_->hashAt(shown_->stepsDone());
}

std::array<double, phaseCount> Workbench::takePhases() { return std::exchange(phases_, {}); }

double Workbench::takeErrorSeconds() { return std::exchange(errorSeconds_, 0); }

// ---- the run

void Workbench::reset() { restart(*options_, "started anew", false); }

/// What is changed for the run is changed for the one beside it.
template <class Change>
Options Workbench::forBoth(Change&& change) const {
    Options options = *options_;
    change(options);
    if (options.beside) {
        Options other = *options.beside;
        change(other);
        options.beside = std::make_shared<const Options>(std::move(other));
    }
    return options;
}

void Workbench::restartWith(std::optional<std::uint64_t> seed, std::optional<std::uint64_t> count) {
    restart(forBoth([&](Options& options) {
                if (seed) options.seed = seed;
                if (count) options.entities = count;
            }),
            "started anew", false);
}

void Workbench::open(const std::string& scene) {
    restart(forBoth([&](Options& options) {
                options.scene = scene;
                options.load.clear();
                // What the command line says of the first scene does not hold for this one.
                options.set.clear();
                options.entities.reset();
                options.seed.reset();
                if (!options.label.empty()) return;  // says in what compared runs differ
                options.dt.reset();
                options.restitution.reset();
            }),
            "opened " + scene, true);
}

void Workbench::openNext(int further) {
    const auto count = static_cast<int>(scenes_.size());
    if (count == 0) return;
    int now = further > 0 ? -1 : count;  // of a scene that is not in the list
    for (int i = 0; i < count; ++i) {
        if (scenes_[std::size_t(i)].name == options_->scene) now = i;
    }
    open(scenes_[std::size_t((now + further + count) % count)].name);
}

void Workbench::restart(Options options, const std::string& success, bool otherScene) {
    const SimulationConfig before = config();
    if (!options.beside) {
        options.partitioner = before.partitioner;
        options.law = before.law;
        if (otherScene) options.law.reset();
        options.resolver = session_->run().requestedResolver;
    }
    std::optional<Run> run;
    try {
        run = setUp(options);
        if (!options.beside) {
            SimulationConfig next = run->simulation.config();
            if (otherScene) {
                if (!run->lawNamed) next.law = before.law;
            } else {
                next.step.gravity = before.step.gravity;
                next.step.restitution = before.step.restitution;
            }
            run->simulation.reconfigure(next);
        }
    } catch (const std::exception& error) {
        say(error.what(), true);
        return;
    }
    start(std::move(*run), std::move(options));
    say(success);
}

void Workbench::apply(SimulationConfig config) {
    config.countMissedPairs = options_->error || mayMissPairs(config.partitioner);
    // Here nothing is gained by a fallback: what runs can go on.
    if (needsDevice(config.resolver) && !needsDevice(this->config().resolver)) {
        const CudaDevice device = findCudaDevice();
        if (!device.usable()) throw DeviceError("cuda: " + device.reason);
    }
    session_->reconfigure(config);
    if (lookingBack_) toNewest();
    if (timeline_) timeline_->change();
    ++cellsVersion_;
}

bool Workbench::refuseChange() {
    if (session_->beside() == nullptr) return false;
    say("two runs that are compared stay as they are");
    return true;
}

void Workbench::reconfigure(SimulationConfig config) {
    if (refuseChange()) return;
    const ResolverKind before = this->config().resolver;
    std::string reason;
    try {
        apply(config);
        if (config.resolver != before) session_->run().requestedResolver = config.resolver;
        const bool chosen = config.resolver == ResolverKind::Auto;
        if (!chosen && config.resolver != this->config().resolver) sayFallback();
        return;
    } catch (const std::exception& error) {
        reason = error.what();
    }
    // A law may not run where the one before did; a resolver that was not chosen just now gives
    // way.
    if (config.resolver == before && before != ResolverKind::Sequential) {
        config.resolver = ResolverKind::Sequential;
        try {
            apply(config);
            reason += "; running '" + std::string(name(config.resolver)) + "'";
        } catch (const std::exception& error) {
            reason = error.what();
        }
    }
    say(reason, true);
}

void Workbench::setPartitioner(const PartitionerConfig& partitioner) {
    SimulationConfig next = config();
    next.partitioner = partitioner;
    reconfigure(std::move(next));
}

void Workbench::nextLaw() {
    SimulationConfig next = config();
    next.law = nextOf(laws(), next.law, 1);
    reconfigure(std::move(next));
}

void Workbench::nextResolver() {
    if (refuseChange()) return;
    for (std::size_t i = 1; i < resolvers().size(); ++i) {
        SimulationConfig next = config();
        next.resolver = nextOf(resolvers(), next.resolver, i);
        if (next.resolver == ResolverKind::Auto) continue;  // it would be one of the others
        const std::string resolver(name(next.resolver));
        try {
            apply(next);
        } catch (const std::exception&) {
            continue;  // not here, or not with this law
        }
        session_->run().requestedResolver = next.resolver;
        say("runs on " + resolver);
        return;
    }
    say("no other resolver can run this");
}

// ---- the comparison

std::array<std::string, 2> Workbench::labels() const {
    return {options_->label, options_->beside ? options_->beside->label : std::string()};
}

const World& Workbench::world(std::size_t run) const {
    return run == 0 ? simulation().world() : session_->beside()->run().simulation.world();
}

// ---- looking closer

void Workbench::select(std::optional<Entity> entity) {
    selected_ = entity;
    if (!entity) following_ = false;
    listen();
}

std::optional<Entity> Workbench::selected() const {
    if (selected_ && simulation().world().alive(*selected_)) return selected_;
    return std::nullopt;
}

void Workbench::toggleFollow() { following_ = !following_ && selected(); }

void Workbench::watchContacts(bool wanted) {
    watching_ = wanted;
    listen();
}

void Workbench::watchHits(bool wanted) {
    if (wanted == watchingHits_) return;
    watchingHits_ = wanted;
    hits_.clear();  // what happened meanwhile is not known
    listen();
}

/// A simulation with a listener hands out every contact; it gets one when there is a use.
void Workbench::listen() {
    if (listening_ || !(watching_ || watchingHits_ || selected_)) return;
    listening_ = true;
    session_->simulation().onContact([this](const Contact& contact) {
        if (watching_ || selected_) contacts_.push_back(contact);
        if (watchingHits_) hits_.record(contact);
    });
}

void Workbench::watchTrails(bool wanted) {
    if (wanted == watchingTrails_) return;
    watchingTrails_ = wanted;
    trails_.clear();
    recordTrails();
}

void Workbench::recordTrails() {
    if (watchingTrails_ && session_->beside() == nullptr)
        trails_.record(shown_->world(), shown_->stepsDone());
}

void Workbench::sayFallback() {
    say(session_->simulation().resolverFailure() + "; running '" +
            std::string(name(config().resolver)) + "'",
        true);
}

void Workbench::say(std::string text, bool isError) {
    const auto shown = std::chrono::seconds(isError ? 8 : 3);
    message_ = {std::move(text), isError, Clock::now() + shown};
}

const Workbench::Message* Workbench::message() const {
    return Clock::now() < message_.until ? &message_ : nullptr;
}

}  // namespace quadrille::app
