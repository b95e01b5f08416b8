#include "cuda/device/launch.cuh"
#include "cuda/resident/resident_kernels.hpp"

namespace quadrille::cuda {

namespace {

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    finishStepKernel(Bodies<Real> bodies, DeviceContacts<Real> list, TouchedBodies touched,
                     StaticMapView<Real> map, const std::uint32_t* entries,
                     const std::uint32_t* badRow, ResidentCounts* result) {
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        const std::uint32_t row = touched.rows[i];
        if (list.starts != nullptr) keepOut(map, bodies, row, list.starts[row]);
        list.heads[row] = none;
    }
    if (threadNumber() == 0) *result = {*touched.counts, *entries, *badRow};
}

}  // namespace

template <class Real>
void finishStep(const Launch& launch, const Bodies<Real>& bodies,
                const DeviceContacts<Real>& contacts, const TouchedBodies& touched,
                const StaticMapView<Real>& map, const std::uint32_t* entries,
                const std::uint32_t* badRow, ResidentCounts* result, std::uint32_t expected) {
    finishStepKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                       launch.stream>>>(bodies, contacts, touched, map, entries, badRow, result);
    checkLaunch("finishStepKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                           \
    template void finishStep(const Launch&, const Bodies<Real>&, const DeviceContacts<Real>&, \
                             const TouchedBodies&, const StaticMapView<Real>&,                \
                             const std::uint32_t*, const std::uint32_t*, ResidentCounts*,     \
                             std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
