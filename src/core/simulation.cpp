#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/error.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>

#include "core/engine.hpp"
#include "core/step_fault.hpp"
#include "core/step_times.hpp"
#include "core/world_access.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

namespace {

/// More than any machine has cores; fewer than what makes an operating system give up.
constexpr int mostThreads = 1024;

constexpr const char* tooManySteps =
    "simulation: beyond 2^53 steps, times are no longer told apart";

void validate(const SimulationConfig& config) {
    if (const char* fault = stepFault(config.step, config.precision)) {
        throw Error(std::string("simulation: ") + fault);
    }
    if (config.threads < 0 || config.threads > mostThreads) {
        throw Error("simulation: the number of threads must be from 1 to " +
                    std::to_string(mostThreads) + ", or 0 for one on each core");
    }
    const int block = config.cuda.blockSize;
    if (block < 32 || block > 1024 || block % 32 != 0) {
        throw Error("simulation: the block size must be a multiple of 32 from 32 to 1024");
    }
    if (config.missedPairsEvery == 0) throw Error("simulation: missedPairsEvery must be positive");
}

/// Functions that are called in the order in which they were registered. One may register another
/// one, or remove any, while it runs.
template <class Function>
class Listeners {
  public:
    Subscription add(Function function) {
        auto active = std::make_shared<bool>(true);
        list_.push_back({std::move(function), active});
        return Subscription(std::move(active));
    }
    template <class... Arguments>
    void call(Arguments&&... arguments) {
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (*list_[i].active) list_[i].function(arguments...);
        }
    }
    /// Not while they are called.
    void forgetRemoved() {
        std::erase_if(list_, [](const Entry& entry) { return !*entry.active; });
    }
    bool empty() const {
        return std::none_of(list_.begin(), list_.end(),
                            [](const Entry& entry) { return *entry.active; });
    }

  private:
    struct Entry {
        Function function;
        std::shared_ptr<bool> active;
    };
    std::deque<Entry> list_;  // does not move its elements when one is added
};

SimulationConfig chosen(SimulationConfig config, const World& world) {
    if (config.resolver == ResolverKind::Auto) {
        config.resolver = chooseResolver(config, world.movingCount());
    }
    return config;
}

}  // namespace

struct Simulation::Impl {
    World world;
    SimulationConfig config;
    std::unique_ptr<Engine> engine;
    std::string resolverFailure;  // outlives the engine that noticed it
    StepReport report;
    std::uint64_t stepsDone = 0;

    Listeners<std::function<void(World&, double)>> systems;
    Listeners<std::function<void(const Contact&)>> contactListeners;
    Listeners<std::function<void(const World&, const StepReport&)>> observers;
    std::vector<Contact> contacts;
    std::optional<bool> lastKept;  // whether the last step kept contacts
    bool busy = false;             // inside a step

    Impl(World w, const SimulationConfig& c)
        : world(std::move(w)),
          config(chosen(c, world)),
          engine(makeEngine(config, world.config().size)) {
        world.setPrecision(config.precision);
        noteFallback();
    }

    void collectContacts();
    void notify();

    /// Says in the configuration what runs after a fallback.
    void noteFallback() {
        config.resolver = engine->resolver();
        if (!engine->failure().empty()) resolverFailure = engine->failure();
    }
    bool keepsContacts() const { return config.keepContacts || !contactListeners.empty(); }

    /// A system or listener that stepped or went back would do so under the step that called it.
    void requireIdle(const char* what) const {
        if (busy) {
            throw Error(std::string("simulation: ") + what + " cannot be called inside a step");
        }
    }
};

Simulation::Simulation(World world, const SimulationConfig& config) {
    validate(config);
    impl_ = std::make_unique<Impl>(std::move(world), config);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const StepReport& Simulation::step() {
    Impl& s = *impl_;
    s.requireIdle("step");
    s.busy = true;
    struct Idle {
        Impl& s;
        ~Idle() { s.busy = false; }
    } const idle{s};
    s.world.flush();
    s.systems.call(s.world, s.config.step.dt);
    s.systems.forgetRemoved();
    s.world.flush();

    const StepTimes times(s.config.step.dt);
    StepWindow window{.number = s.stepsDone + 1,
                      .from = times.at(s.stepsDone),
                      .to = times.at(s.stepsDone + 1),
                      .keepContacts = s.keepsContacts()};
    s.report = StepReport{.step = window.number};
    s.contacts.clear();
    s.lastKept = window.keepContacts;
    s.engine->step(WorldAccess::store(s.world), window, s.report);
    ++s.stepsDone;
    s.noteFallback();
    if (window.keepContacts) s.collectContacts();
    s.notify();
    return s.report;
}

/// Contacts are complete before a listener sees one: it may create and destroy bodies.
void Simulation::Impl::collectContacts() {
    world.visitBodies([&](const auto& bodies) {
        const CreationRanks moving(bodies.moving.created, bodies.moving.size());
        const CreationRanks fixed(bodies.fixed.created, bodies.fixed.size());
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        for (const ContactRecord& record : engine->contacts()) {
            const std::uint32_t b = record.b.row();
            const bool withStatic = record.b.isStatic();
            const bool alongX = (record.axes & static_cast<int>(Axis::X)) != 0;
            const bool alongY = (record.axes & static_cast<int>(Axis::Y)) != 0;
            contacts.push_back(
                {.a = world.entityAt(m.entity[record.a]),
                 .b = world.entityAt(withStatic ? f.entity[b] : m.entity[b]),
                 .time = record.time,
                 .axis = static_cast<Axis>(record.axes),
                 .normal = Vec2(alongX ? record.senseX : 0, alongY ? record.senseY : 0),
                 .collided = record.collided,
                 .impulse = Vec2(record.impulseX, record.impulseY),
                 .approach = Vec2(record.approachX, record.approachY),
                 .numberA = static_cast<std::int64_t>(moving[record.a]),
                 .numberB = withStatic ? -1 - static_cast<std::int64_t>(fixed[b])
                                       : static_cast<std::int64_t>(moving[b])});
        }
    });
}

void Simulation::Impl::notify() {
    contactListeners.forgetRemoved();
    observers.forgetRemoved();
    if (contactListeners.empty() && observers.empty()) return;
    const auto before = std::chrono::steady_clock::now();
    if (!contactListeners.empty()) {
        for (const Contact& contact : contacts) contactListeners.call(contact);
    }
    observers.call(std::as_const(world), std::as_const(report));
    world.flush();
    report.observeSeconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (config.profile) {
        report.phaseSeconds[static_cast<std::size_t>(Phase::Observe)] = report.observeSeconds;
    }
}

void Simulation::run(std::uint64_t steps) {
    for (std::uint64_t i = 0; i < steps; ++i) step();
}

World& Simulation::world() { return impl_->world; }
const World& Simulation::world() const { return impl_->world; }
const SimulationConfig& Simulation::config() const { return impl_->config; }
const std::string& Simulation::resolverFailure() const { return impl_->resolverFailure; }

std::uint64_t Simulation::stepsDone() const { return impl_->stepsDone; }
double Simulation::time() const { return StepTimes(impl_->config.step.dt).at(impl_->stepsDone); }

std::span<const Contact> Simulation::contacts() const {
    if (!impl_->lastKept.value_or(impl_->keepsContacts())) {
        throw Error(
            "simulation: contacts are not kept; SimulationConfig::keepContacts asks for it");
    }
    return impl_->contacts;
}

const Cells& Simulation::cells() const { return impl_->engine->cells(); }

Subscription Simulation::onContact(std::function<void(const Contact&)> listener) {
    return impl_->contactListeners.add(std::move(listener));
}

Subscription Simulation::onStep(std::function<void(const World&, const StepReport&)> observer) {
    return impl_->observers.add(std::move(observer));
}

Subscription Simulation::addSystem(std::function<void(World&, double)> system) {
    return impl_->systems.add(std::move(system));
}

void Simulation::setPartitioner(const PartitionerConfig& partitioner) {
    SimulationConfig config = impl_->config;
    config.partitioner = partitioner;
    reconfigure(config);
}

void Simulation::reconfigure(const SimulationConfig& config) {
    Impl& s = *impl_;
    validate(config);
    if (config.step.dt != s.config.step.dt) {
        throw Error("simulation: dt cannot change during a run");
    }
    if (config.precision != s.config.precision) {
        throw Error("simulation: the precision cannot change during a run");
    }
    const SimulationConfig next = chosen(config, s.world);
    std::unique_ptr<Engine> engine = makeEngine(next, s.world.config().size);
    s.config = next;
    s.engine = std::move(engine);
    if (next.resolver != ResolverKind::Sequential) s.resolverFailure.clear();
    s.noteFallback();
}

Snapshot Simulation::snapshot() const {
    const Impl& s = *impl_;
    return {.scene = {},
            .seed = s.world.config().seed,
            .stepsDone = s.stepsDone,
            .law = s.config.law,
            .step = s.config.step,
            .world = s.world.clone()};
}

void Simulation::restore(const Snapshot& snapshot) {
    Impl& s = *impl_;
    s.requireIdle("restore");
    if (snapshot.stepsDone > StepTimes::mostSteps) throw Error(tooManySteps);
    SimulationConfig config = s.config;
    config.law = snapshot.law;
    config.step = snapshot.step;
    config.precision = snapshot.world.precision();
    validate(config);
    World world = snapshot.world.clone();
    std::unique_ptr<Engine> engine = makeEngine(config, world.config().size);
    s.world = std::move(world);
    s.config = config;
    s.engine = std::move(engine);
    s.stepsDone = snapshot.stepsDone;
    s.contacts.clear();
    s.lastKept.reset();
    s.noteFallback();
}

int Simulation::threads() const { return static_cast<int>(impl_->engine->threads()); }

int Simulation::cores() { return std::min(mostThreads, static_cast<int>(ThreadTeam::cores())); }

ModelFeatures Simulation::features() const {
    const Impl& s = *impl_;
    return s.world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        return ModelFeatures{
            .movingBodies = m.size() > 0,
            .staticBodies = bodies.fixed.size() > 0,
            .gravity = s.config.step.gravity != Vec2(0, 0),
            .inelastic = s.config.step.restitution != 1,
            .sizesDiffer = !m.halfWidth.uniform() || !m.halfHeight.uniform(),
            .massesDiffer = !m.mass.uniform(),
            .listeners = s.keepsContacts(),
            .profile = s.config.profile,
        };
    });
}

std::size_t Simulation::workspaceBytes() const {
    return impl_->engine->bytes() + impl_->contacts.capacity() * sizeof(Contact);
}

void Simulation::resumeAt(std::uint64_t stepsDone) {
    if (stepsDone > StepTimes::mostSteps) throw Error(tooManySteps);
    impl_->stepsDone = stepsDone;
}

}  // namespace quadrille
