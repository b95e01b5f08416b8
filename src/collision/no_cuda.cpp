// Stands in for the folder cuda/ in builds without it.

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>

#include "collision/cuda_resolver.hpp"

namespace quadrille {

CudaDevice findCudaDevice() { return {.name = {}, .reason = "this build has no CUDA"}; }

template <class Real>
std::unique_ptr<Resolver<Real>> makeCudaResolver(const SimulationConfig&) {
    throw DeviceError("cuda: " + findCudaDevice().reason);
}

template std::unique_ptr<Resolver<double>> makeCudaResolver(const SimulationConfig&);
template std::unique_ptr<Resolver<float>> makeCudaResolver(const SimulationConfig&);

}  // namespace quadrille
