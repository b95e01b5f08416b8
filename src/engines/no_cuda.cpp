// Stands in for the folder cuda/ in builds without it.

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>

#include "collision/cuda_resolver.hpp"

namespace quadrille {

CudaDevice findCudaDevice() { return {.name = {}, .reason = "this build has no CUDA"}; }

template <class Real>
std::unique_ptr<Resolver<Real>> makeCudaResolver(const SimulationConfig&, const ThreadTeam&) {
    throw DeviceError("cuda: " + findCudaDevice().reason);
}

template std::unique_ptr<Resolver<double>> makeCudaResolver(const SimulationConfig&,
                                                            const ThreadTeam&);
template std::unique_ptr<Resolver<float>> makeCudaResolver(const SimulationConfig&,
                                                           const ThreadTeam&);

}  // namespace quadrille
