#include "collision/cuda_resolver.hpp"

#include <quadrille/error.hpp>

#include "cuda/discrete/cuda_baseline.hpp"
#include "cuda/discrete/cuda_impulse.hpp"

namespace quadrille {

template <class Real>
std::unique_ptr<Resolver<Real>> makeCudaResolver(const SimulationConfig& config,
                                                 const ThreadTeam& team) {
    switch (config.law) {
        case Law::Baseline:
            return std::make_unique<cuda::CudaBaseline<Real>>(config.cuda, team);
        case Law::Impulse:
            return std::make_unique<cuda::CudaImpulse<Real>>(config.cuda, team);
        case Law::Continuous:
            break;
    }
    throw NotAvailable("the resolver 'cuda' knows the laws 'baseline' and 'impulse'");
}

template std::unique_ptr<Resolver<double>> makeCudaResolver(const SimulationConfig&,
                                                            const ThreadTeam&);
template std::unique_ptr<Resolver<float>> makeCudaResolver(const SimulationConfig&,
                                                           const ThreadTeam&);

}  // namespace quadrille
