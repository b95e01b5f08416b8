#include "cuda/device/launch.cuh"
#include "cuda/resident/resident_kernels.hpp"

namespace quadrille::cuda {

namespace {

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    noteStartsKernel(Bodies<Real> bodies, DeviceContacts<Real> list, Real dt, Place<Real>* starts) {
    const unsigned long long count = list.counts->contacts;
    if (count > list.capacity) return;
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) {
        const std::uint32_t a = list.contacts[i].a;
        const BodyRef b = list.contacts[i].b;
        starts[a] = placeBefore<Real>(bodies.moving, a, dt);
        if (!b.isStatic()) starts[b.row()] = placeBefore<Real>(bodies.moving, b.row(), dt);
    }
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    keepTouchedOutKernel(Bodies<Real> bodies, TouchedBodies touched, StaticMapView<Real> map,
                         const Place<Real>* starts) {
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        const std::uint32_t row = touched.rows[i];
        keepOut(map, bodies, row, starts[row]);
    }
}

__global__ void __launch_bounds__(largestBlock)
    finishStepKernel(std::uint32_t* heads, TouchedBodies touched, const std::uint32_t* entries,
                     const std::uint32_t* badRow, ResidentCounts* result) {
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        heads[touched.rows[i]] = none;
    }
    if (threadNumber() == 0) *result = {*touched.counts, *entries, *badRow};
}

}  // namespace

template <class Real>
void noteStarts(const Launch& launch, const Bodies<Real>& bodies,
                const DeviceContacts<Real>& contacts, Real dt, Place<Real>* starts,
                std::uint32_t expected) {
    noteStartsKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                       launch.stream>>>(bodies, contacts, dt, starts);
    checkLaunch("noteStartsKernel");
}

template <class Real>
void keepTouchedOut(const Launch& launch, const Bodies<Real>& bodies, const TouchedBodies& touched,
                    const StaticMapView<Real>& map, const Place<Real>* starts,
                    std::uint32_t expected) {
    keepTouchedOutKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                           launch.stream>>>(bodies, touched, map, starts);
    checkLaunch("keepTouchedOutKernel");
}

void finishStep(const Launch& launch, std::uint32_t* heads, const TouchedBodies& touched,
                const std::uint32_t* entries, const std::uint32_t* badRow, ResidentCounts* result,
                std::uint32_t expected) {
    finishStepKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                       launch.stream>>>(heads, touched, entries, badRow, result);
    checkLaunch("finishStepKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                           \
    template void noteStarts(const Launch&, const Bodies<Real>&, const DeviceContacts<Real>&, \
                             Real, Place<Real>*, std::uint32_t);                              \
    template void keepTouchedOut(const Launch&, const Bodies<Real>&, const TouchedBodies&,    \
                                 const StaticMapView<Real>&, const Place<Real>*, std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
