// Stands in for the folder cuda/ in builds without it.

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>

#include "cuda/laws.hpp"
#include "cuda/resident_pipeline.hpp"

namespace quadrille {

CudaDevice findCudaDevice() { return {.name = {}, .reason = "this build has no CUDA"}; }

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaBaseline(const SimulationConfig&, const ThreadTeam&) {
    throw DeviceError("cuda: " + findCudaDevice().reason);
}

template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaImpulse(const SimulationConfig& config,
                                                  const ThreadTeam& team) {
    return makeCudaBaseline<Real>(config, team);
}

template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentImpulse(const SimulationConfig&, const Vec2&,
                                                            const ThreadTeam&) {
    throw DeviceError("cuda: " + findCudaDevice().reason);
}

template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentContinuous(const SimulationConfig& config,
                                                               const Vec2& worldSize,
                                                               const ThreadTeam& team) {
    return makeResidentImpulse<Real>(config, worldSize, team);
}

#define QUADRILLE_INSTANTIATE(Real)                                                      \
    template std::unique_ptr<ContactLaw<Real>> makeCudaBaseline(const SimulationConfig&, \
                                                                const ThreadTeam&);      \
    template std::unique_ptr<ContactLaw<Real>> makeCudaImpulse(const SimulationConfig&,  \
                                                               const ThreadTeam&);       \
    template std::unique_ptr<ResidentPipeline<Real>> makeResidentImpulse(                \
        const SimulationConfig&, const Vec2&, const ThreadTeam&);                        \
    template std::unique_ptr<ResidentPipeline<Real>> makeResidentContinuous(             \
        const SimulationConfig&, const Vec2&, const ThreadTeam&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille
