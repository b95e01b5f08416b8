#include "cuda/laws.hpp"

#include "cuda/discrete/cuda_baseline.hpp"
#include "cuda/discrete/cuda_impulse.hpp"

namespace quadrille {

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaBaseline(const SimulationConfig& config,
                                                   const ThreadTeam& team) {
    return std::make_unique<cuda::CudaBaseline<Real>>(config.cuda, team);
}

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaImpulse(const SimulationConfig& config,
                                                  const ThreadTeam& team) {
    return std::make_unique<cuda::CudaImpulse<Real>>(config.cuda, team);
}

#define QUADRILLE_INSTANTIATE(Real)                                                      \
    template std::unique_ptr<ContactLaw<Real>> makeCudaBaseline(const SimulationConfig&, \
                                                                const ThreadTeam&);      \
    template std::unique_ptr<ContactLaw<Real>> makeCudaImpulse(const SimulationConfig&,  \
                                                               const ThreadTeam&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille
