#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cuda/discrete/baseline_kernels.hpp"
#include "cuda/discrete/cuda_law.hpp"

namespace quadrille::cuda {

/// The law `baseline` on the device, bit for bit that of SequentialBaseline.
template <class Real>
class CudaBaseline final : public CudaLaw<Real> {
  public:
    CudaBaseline(const CudaOptions& options, const ThreadTeam& team)
        : CudaLaw<Real>(options, team) {}

  private:
    using CudaLaw<Real>::device_;
    using CudaLaw<Real>::bodies_;
    using CudaLaw<Real>::cells_;

    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;
    void fetchContacts(std::size_t count, const StepParameters<Real>& step,
                       std::vector<ContactRecord>& records) const override;

    void reserve(bool keepContacts);
    BaselineOrder<Real> order(bool keepContacts) const;
    StepCounts tryStep(const Partition<Real>& partition, Step<Real>& step);

    DeviceArray<std::uint32_t> heads_{device_.budget()}, done_{device_.budget()};
    DeviceArray<std::uint32_t> next_{device_.budget()}, turns_{device_.budget()};
    std::uint64_t turnsOf_ = 0;  // generation of the partition that the turns are of
    DeviceArray<bool> hit_{device_.budget()};
    DeviceArray<Real> future_{device_.budget()};
    DeviceArray<BaselineContact<Real>> contacts_{device_.budget()};
    std::uint32_t expected_ = 1024;  // contacts, judging by the last step
    bool hitsFalse_ = false;
};

}  // namespace quadrille::cuda
