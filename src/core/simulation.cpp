#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/simulation.hpp>

#include "core/step_times.hpp"
#include "core/stepper.hpp"

namespace quadrille {

std::string_view name(Precision precision) {
    return precision == Precision::Double ? "double" : "float";
}

namespace {

/// More than any machine has cores; fewer than what makes an operating system give up.
constexpr int mostThreads = 1024;

void validate(const SimulationConfig& config) {
    if (!std::isfinite(config.dt) || !(config.dt > 0)) {
        throw Error("simulation: dt must be finite and positive");
    }
    if (!config.gravity.allFinite()) throw Error("simulation: gravity must be finite");
    if (config.threads < 0 || config.threads > mostThreads) {
        throw Error("simulation: the number of threads must be from 1 to " +
                    std::to_string(mostThreads) + ", or 0 for one on each core");
    }
    if (config.precision == Precision::Float) {
        const auto dt = static_cast<float>(config.dt);
        if (!std::isfinite(dt) || !(dt > 0)) {
            throw Error("simulation: dt does not fit single precision");
        }
        if (!config.gravity.cast<float>().allFinite()) {
            throw Error("simulation: gravity does not fit single precision");
        }
    }
    const int block = config.cuda.blockSize;
    if (block < 32 || block > 1024 || block % 32 != 0) {
        throw Error("simulation: the block size must be a multiple of 32 from 32 to 1024");
    }
    if (!(config.restitution >= 0 && config.restitution <= 1)) {
        throw Error("simulation: restitution must be from 0 to 1");
    }
    if (config.missedPairsEvery == 0) throw Error("simulation: missedPairsEvery must be positive");
}

using AnyStepper = std::variant<Stepper<double>, Stepper<float>>;

AnyStepper makeStepper(const SimulationConfig& config, const Vec2& worldSize) {
    if (config.precision == Precision::Float) return Stepper<float>(config, worldSize);
    return Stepper<double>(config, worldSize);
}

}  // namespace

struct Simulation::Impl {
    World world;
    SimulationConfig config;
    AnyStepper stepper;
    std::string resolverFailure;  // outlives the stepper that noticed it
    StepReport report;
    std::uint64_t stepsDone = 0;

    // Deques: a callback may register another one, and must not be moved while it runs.
    std::deque<std::function<void(World&, double)>> systems;
    std::deque<std::function<void(const Contact&)>> contactListeners;
    std::deque<std::function<void(const World&, const StepReport&)>> observers;
    std::vector<ContactRecord> records;
    std::vector<Contact> contacts;

    Impl(World w, SimulationConfig c)
        : world(std::move(w)),
          config(std::move(c)),
          stepper(makeStepper(config, world.config().size)) {
        world.setPrecision(config.precision);
        dropUnusedAnchors();
        noteFallback();
    }

    void dropUnusedAnchors();
    void collectContacts();
    void notify();

    /// Says in the configuration what runs after a fallback.
    void noteFallback() {
        const std::string failure =
            std::visit([](const auto& s) { return std::string(s.resolverFailure()); }, stepper);
        if (failure.empty()) return;
        config.resolver = ResolverKind::Sequential;
        resolverFailure = failure;
    }
};

Simulation::Simulation(World world, SimulationConfig config) {
    validate(config);
    impl_ = std::make_unique<Impl>(std::move(world), std::move(config));
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const StepReport& Simulation::step() {
    Impl& s = *impl_;
    s.world.flush();
    for (std::size_t i = 0; i < s.systems.size(); ++i) s.systems[i](s.world, s.config.dt);
    s.world.flush();

    s.report = StepReport{.step = s.stepsDone + 1};
    s.records.clear();
    std::visit(
        [&](auto& stepper) {
            stepper.step(s.world, s.stepsDone + 1,
                         s.contactListeners.empty() ? nullptr : &s.records, s.report,
                         s.config.profile);
        },
        s.stepper);
    ++s.stepsDone;
    s.noteFallback();
    s.notify();
    return s.report;
}

/// Discrete laws move bodies without their anchors; `continuous` must not find old ones later.
void Simulation::Impl::dropUnusedAnchors() {
    if (config.law == Law::Continuous) return;
    world.visitBodies([](const auto& bodies) { *bodies.moving.anchors = {}; });
}

/// Contacts are complete before a listener sees one: it may create and destroy bodies.
void Simulation::Impl::collectContacts() {
    contacts.clear();
    world.visitBodies([&](const auto& bodies) {
        const auto entityOf = [&](std::int64_t row) {
            return world.entityAt(row >= 0
                                      ? bodies.moving.entity[static_cast<std::size_t>(row)]
                                      : bodies.fixed.entity[static_cast<std::size_t>(-1 - row)]);
        };
        for (const ContactRecord& record : records) {
            contacts.push_back({.a = entityOf(record.a),
                                .b = entityOf(record.b),
                                .time = record.time,
                                .axis = static_cast<Axis>(record.axes),
                                .normal = Vec2((record.axes & 1) != 0 ? record.senseX : 0,
                                               (record.axes & 2) != 0 ? record.senseY : 0),
                                .collided = record.collided,
                                .rowA = record.a,
                                .rowB = record.b});
        }
    });
}

void Simulation::Impl::notify() {
    if (contactListeners.empty() && observers.empty()) return;
    const auto before = std::chrono::steady_clock::now();
    if (!records.empty()) {
        collectContacts();
        for (const Contact& contact : contacts) {
            for (std::size_t i = 0; i < contactListeners.size(); ++i) contactListeners[i](contact);
        }
    }
    for (std::size_t i = 0; i < observers.size(); ++i) observers[i](world, report);
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
double Simulation::time() const { return StepTimes(impl_->config.dt).at(impl_->stepsDone); }

void Simulation::onContact(std::function<void(const Contact&)> listener) {
    impl_->contactListeners.push_back(std::move(listener));
}

void Simulation::onStep(std::function<void(const World&, const StepReport&)> observer) {
    impl_->observers.push_back(std::move(observer));
}

void Simulation::addSystem(std::function<void(World&, double)> system) {
    impl_->systems.push_back(std::move(system));
}

void Simulation::setPartitioner(const PartitionerConfig& partitioner) {
    SimulationConfig config = impl_->config;
    config.partitioner = partitioner;
    reconfigure(config);
}

void Simulation::reconfigure(const SimulationConfig& config) {
    Impl& s = *impl_;
    validate(config);
    if (config.dt != s.config.dt) throw Error("simulation: dt cannot change during a run");
    if (config.precision != s.config.precision) {
        throw Error("simulation: the precision cannot change during a run");
    }
    AnyStepper stepper = makeStepper(config, s.world.config().size);
    s.config = config;
    s.stepper = std::move(stepper);
    if (config.resolver != ResolverKind::Sequential) s.resolverFailure.clear();
    s.dropUnusedAnchors();
    s.noteFallback();
}

const Cells& Simulation::cells() const {
    return std::visit([](const auto& s) -> const Cells& { return s.cells(); }, impl_->stepper);
}

int Simulation::threads() const {
    return static_cast<int>(std::visit([](const auto& s) { return s.threads(); }, impl_->stepper));
}

int Simulation::cores() { return std::min(mostThreads, static_cast<int>(ThreadTeam::cores())); }

ModelFeatures Simulation::features() const {
    const Impl& s = *impl_;
    return s.world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        return ModelFeatures{
            .movingBodies = m.size() > 0,
            .staticBodies = bodies.fixed.size() > 0,
            .gravity = s.config.gravity != Vec2(0, 0),
            .inelastic = s.config.restitution != 1,
            .sizesDiffer = !m.halfWidth.uniform() || !m.halfHeight.uniform(),
            .massesDiffer = !m.mass.uniform(),
            .listeners = !s.contactListeners.empty(),
            .profile = s.config.profile,
        };
    });
}

std::size_t Simulation::workspaceBytes() const {
    return std::visit([](const auto& s) { return s.bytes(); }, impl_->stepper) +
           impl_->records.capacity() * sizeof(ContactRecord) +
           impl_->contacts.capacity() * sizeof(Contact);
}

void Simulation::resumeAt(std::uint64_t stepsDone) { impl_->stepsDone = stepsDone; }

}  // namespace quadrille
