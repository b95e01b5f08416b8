#include "collision/resolver.hpp"

#include <string>

#include <quadrille/error.hpp>

#include "collision/cuda_resolver.hpp"
#include "collision/discrete/sequential_baseline.hpp"
#include "collision/discrete/sequential_impulse.hpp"
#include "collision/discrete/threads_impulse.hpp"

namespace quadrille {

std::string_view name(Law law) {
    switch (law) {
        case Law::Baseline:
            return "baseline";
        case Law::Impulse:
            return "impulse";
        case Law::Continuous:
            return "continuous";
    }
    return "";
}

std::string_view name(ResolverKind resolver) {
    switch (resolver) {
        case ResolverKind::Sequential:
            return "sequential";
        case ResolverKind::Threads:
            return "threads";
        case ResolverKind::Cuda:
            return "cuda";
        case ResolverKind::CudaResident:
            return "cuda-resident";
    }
    return "";
}

template <class Real>
std::unique_ptr<Resolver<Real>> makeResolver(const SimulationConfig& config,
                                             const ThreadTeam& team) {
    switch (config.resolver) {
        case ResolverKind::Sequential:
            if (config.law == Law::Baseline) return std::make_unique<SequentialBaseline<Real>>();
            if (config.law == Law::Impulse) return std::make_unique<SequentialImpulse<Real>>();
            break;
        case ResolverKind::Threads:
            if (config.law == Law::Impulse) return std::make_unique<ThreadsImpulse<Real>>(team);
            break;
        case ResolverKind::Cuda:
            if (config.law != Law::Continuous) return makeCudaResolver<Real>(config, team);
            break;
        case ResolverKind::CudaResident:
            throw NotAvailable("the resolver '" + std::string(name(config.resolver)) +
                               "' is not available yet");
    }
    throw NotAvailable("the law '" + std::string(name(config.law)) +
                       "' does not run on the resolver '" + std::string(name(config.resolver)) +
                       "'");
}

template std::unique_ptr<Resolver<double>> makeResolver(const SimulationConfig&, const ThreadTeam&);
template std::unique_ptr<Resolver<float>> makeResolver(const SimulationConfig&, const ThreadTeam&);

}  // namespace quadrille
