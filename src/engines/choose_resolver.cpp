#include <cstddef>

#include <quadrille/device.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>

#include "core/engine.hpp"

namespace quadrille {

namespace {

/// From how many moving bodies on a device is faster than any number of threads, as measured on an
/// H100 and an H200 beside 16 cores (docs/performance.md).
constexpr std::size_t devicePaysFrom = 10'000;

/// From how many moving bodies on so many threads are worth it, measured there and on 2 cores.
std::size_t threadsPayFrom(int threads) { return threads >= 4 ? 5'000 : 10'000; }

}  // namespace

ResolverKind chooseResolver(const SimulationConfig& config, std::size_t movingCount) {
    // The device is looked for last: that takes longer than many a small run.
    // Exact steps that can stay there are faster than those of any host.
    if (config.law == Law::Continuous && staysOnDevice(config.law, config.step) &&
        movingCount >= devicePaysFrom && findCudaDevice().usable()) {
        return ResolverKind::CudaResident;
    }
    // A law that threads cannot share out, `baseline`, gains nothing on a device either.
    if (runsOn(config.law, ResolverKind::Cuda) && runsOn(config.law, ResolverKind::Threads) &&
        movingCount >= devicePaysFrom && findCudaDevice().usable()) {
        return ResolverKind::Cuda;
    }
    const int threads = config.threads > 0 ? config.threads : Simulation::cores();
    const bool pays = threads > 1 && movingCount >= threadsPayFrom(threads);
    return pays && runsOn(config.law, ResolverKind::Threads) ? ResolverKind::Threads
                                                             : ResolverKind::Sequential;
}

}  // namespace quadrille
