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
#include "cuda/resident_pipeline.hpp"
#include "engines/fallback.hpp"
#include "engines/host_engine.hpp"
#include "engines/resident_engine.hpp"

namespace quadrille {

namespace {

/// A law on a resolver, and what makes it: a law that goes by the host's cells, or a pipeline on a
/// device that makes cells of its own.
template <class Real>
struct Entry {
    ResolverKind resolver;
    Law law;
    std::unique_ptr<ContactLaw<Real>> (*make)(const SimulationConfig&, const ThreadTeam&);
    std::unique_ptr<ResidentPipeline<Real>> (*makeResident)(const SimulationConfig&, const Vec2&,
                                                            const ThreadTeam&) = nullptr;
};

template <class Real, class L>
std::unique_ptr<ContactLaw<Real>> make(const SimulationConfig&, const ThreadTeam& team) {
    return std::make_unique<L>(team);
}

/// What runs where: a law that is not here with a resolver does not run on it.
template <class Real>
constexpr std::array<Entry<Real>, 9> table = {{
    {ResolverKind::Sequential, Law::Baseline, make<Real, SequentialBaseline<Real>>},
    {ResolverKind::Sequential, Law::Impulse, make<Real, SequentialImpulse<Real>>},
    {ResolverKind::Sequential, Law::Continuous, makeContinuousLaw<Real>},
    {ResolverKind::Threads, Law::Impulse, make<Real, ThreadsImpulse<Real>>},
    {ResolverKind::Threads, Law::Continuous, makeContinuousLaw<Real>},
    {ResolverKind::Cuda, Law::Baseline, makeCudaBaseline<Real>},
    {ResolverKind::Cuda, Law::Impulse, makeCudaImpulse<Real>},
    {ResolverKind::CudaResident, Law::Impulse, nullptr, makeResidentImpulse<Real>},
    {ResolverKind::CudaResident, Law::Continuous, nullptr, makeResidentContinuous<Real>},
}};

template <class Real>
const Entry<Real>* findEntry(Law law, ResolverKind resolver) {
    for (const Entry<Real>& entry : table<Real>) {
        if (entry.law == law && entry.resolver == resolver) return &entry;
    }
    return nullptr;
}

[[noreturn]] void refuse(const SimulationConfig& config) {
    throw NotAvailable("the law '" + std::string(name(config.law)) +
                       "' does not run on the resolver '" + std::string(name(config.resolver)) +
                       "'");
}

template <class Real>
std::unique_ptr<Engine> makeEngineOf(const SimulationConfig& config, const Vec2& worldSize,
                                     unsigned threads) {
    if (config.resolver == ResolverKind::CudaResident) {
        return std::make_unique<ResidentEngine<Real>>(config, worldSize, threads);
    }
    return std::make_unique<HostEngine<Real>>(config, worldSize, threads, Thresholds{});
}

std::unique_ptr<Engine> makeWithoutFallback(const SimulationConfig& config, const Vec2& worldSize,
                                            unsigned threads) {
    return config.precision == Precision::Float ? makeEngineOf<float>(config, worldSize, threads)
                                                : makeEngineOf<double>(config, worldSize, threads);
}

}  // namespace

bool needsDevice(ResolverKind resolver) {
    return resolver == ResolverKind::Cuda || resolver == ResolverKind::CudaResident;
}

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
    const auto* entry = findEntry<Real>(config.law, config.resolver);
    if (entry == nullptr || entry->make == nullptr) refuse(config);
    return entry->make(config, team);
}

template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResident(const SimulationConfig& config,
                                                     const Vec2& worldSize,
                                                     const ThreadTeam& team) {
    const auto* entry = findEntry<Real>(config.law, config.resolver);
    if (entry == nullptr || entry->makeResident == nullptr) refuse(config);
    return entry->makeResident(config, worldSize, team);
}

#define QUADRILLE_INSTANTIATE(Real)                                                        \
    template std::unique_ptr<ContactLaw<Real>> makeLaw(const SimulationConfig&,            \
                                                       const ThreadTeam&);                 \
    template std::unique_ptr<ResidentPipeline<Real>> makeResident(const SimulationConfig&, \
                                                                  const Vec2&, const ThreadTeam&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

std::unique_ptr<Engine> makeEngine(const SimulationConfig& config, const Vec2& worldSize) {
    const unsigned threads = threadsOf(config);
    if (!config.fallback || !needsDevice(config.resolver)) {
        return makeWithoutFallback(config, worldSize, threads);
    }
    // The threads that make the cells for a device do so for its substitute.
    SimulationConfig substitute = config;
    substitute.resolver = ResolverKind::Sequential;
    return std::make_unique<FallbackEngine>(
        [&] { return makeWithoutFallback(config, worldSize, threads); },
        [=] { return makeWithoutFallback(substitute, worldSize, threads); });
}

}  // namespace quadrille
