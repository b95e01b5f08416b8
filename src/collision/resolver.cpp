#include "collision/resolver.hpp"

#include <string>

#include <quadrille/error.hpp>

#include "collision/cuda_resolver.hpp"
#include "collision/sequential_baseline.hpp"
#include "collision/sequential_impulse.hpp"

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
std::unique_ptr<Resolver<Real>> makeResolver(const SimulationConfig& config) {
    if (config.resolver == ResolverKind::Cuda) return makeCudaResolver<Real>(config);
    if (config.resolver != ResolverKind::Sequential) {
        throw NotAvailable("the resolver '" + std::string(name(config.resolver)) +
                           "' is not available yet");
    }
    switch (config.law) {
        case Law::Baseline:
            return std::make_unique<SequentialBaseline<Real>>();
        case Law::Impulse:
            return std::make_unique<SequentialImpulse<Real>>();
        case Law::Continuous:
            break;
    }
    throw NotAvailable("the law '" + std::string(name(config.law)) + "' is not available yet");
}

template std::unique_ptr<Resolver<double>> makeResolver(const SimulationConfig&);
template std::unique_ptr<Resolver<float>> makeResolver(const SimulationConfig&);

}  // namespace quadrille
