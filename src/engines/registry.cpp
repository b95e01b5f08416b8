#include "engines/registry.hpp"

#include <array>
#include <string>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>

#include "collision/continuous/continuous_law.hpp"
#include "collision/discrete/sequential_baseline.hpp"
#include "collision/discrete/sequential_impulse.hpp"
#include "collision/discrete/threads_impulse.hpp"
#include "core/engine.hpp"
#include "cuda/laws.hpp"
#include "engines/fallback.hpp"
#include "engines/host_engine.hpp"

namespace quadrille {

namespace {

/// A law on a resolver, and what makes it.
template <class Real>
struct Entry {
    ResolverKind resolver;
    Law law;
    std::unique_ptr<ContactLaw<Real>> (*make)(const SimulationConfig&, const ThreadTeam&);
};

template <class Real, class L>
std::unique_ptr<ContactLaw<Real>> make(const SimulationConfig&, const ThreadTeam& team) {
    return std::make_unique<L>(team);
}

/// What runs where: a law that is not here with a resolver does not run on it.
template <class Real>
constexpr std::array<Entry<Real>, 7> table = {{
    {ResolverKind::Sequential, Law::Baseline, make<Real, SequentialBaseline<Real>>},
    {ResolverKind::Sequential, Law::Impulse, make<Real, SequentialImpulse<Real>>},
    {ResolverKind::Sequential, Law::Continuous, makeContinuousLaw<Real>},
    {ResolverKind::Threads, Law::Impulse, make<Real, ThreadsImpulse<Real>>},
    {ResolverKind::Threads, Law::Continuous, makeContinuousLaw<Real>},
    {ResolverKind::Cuda, Law::Baseline, makeCudaBaseline<Real>},
    {ResolverKind::Cuda, Law::Impulse, makeCudaImpulse<Real>},
}};

template <class Real>
const Entry<Real>* findEntry(Law law, ResolverKind resolver) {
    for (const Entry<Real>& entry : table<Real>) {
        if (entry.law == law && entry.resolver == resolver) return &entry;
    }
    return nullptr;
}

bool needsDevice(ResolverKind resolver) { return resolver == ResolverKind::Cuda; }

std::unique_ptr<Engine> makeHostEngine(const SimulationConfig& config, const Vec2& worldSize,
                                       unsigned threads) {
    if (config.precision == Precision::Float) {
        return std::make_unique<HostEngine<float>>(config, worldSize, threads, Thresholds{});
    }
    return std::make_unique<HostEngine<double>>(config, worldSize, threads, Thresholds{});
}

}  // namespace

bool runsOn(Law law, ResolverKind resolver) {
    return resolver == ResolverKind::Auto || findEntry<double>(law, resolver) != nullptr;
}

unsigned threadsOf(const SimulationConfig& config) {
    // `cuda` leaves the partition to the host, which is most of its step.
    const bool shared = config.resolver != ResolverKind::Sequential;
    if (!shared) return 1;
    return static_cast<unsigned>(config.threads > 0 ? config.threads : Simulation::cores());
}

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeLaw(const SimulationConfig& config, const ThreadTeam& team) {
    if (const auto* entry = findEntry<Real>(config.law, config.resolver)) {
        return entry->make(config, team);
    }
    throw NotAvailable("the law '" + std::string(name(config.law)) +
                       "' does not run on the resolver '" + std::string(name(config.resolver)) +
                       "'");
}

template std::unique_ptr<ContactLaw<double>> makeLaw(const SimulationConfig&, const ThreadTeam&);
template std::unique_ptr<ContactLaw<float>> makeLaw(const SimulationConfig&, const ThreadTeam&);

std::unique_ptr<Engine> makeEngine(const SimulationConfig& config, const Vec2& worldSize) {
    const unsigned threads = threadsOf(config);
    if (!config.fallback || !needsDevice(config.resolver)) {
        return makeHostEngine(config, worldSize, threads);
    }
    // The threads that make the cells for a device do so for its substitute.
    SimulationConfig substitute = config;
    substitute.resolver = ResolverKind::Sequential;
    return std::make_unique<FallbackEngine>(
        [&] { return makeHostEngine(config, worldSize, threads); },
        [=] { return makeHostEngine(substitute, worldSize, threads); });
}

}  // namespace quadrille
