#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/static_barrier.hpp"
#include "cuda/discrete/cuda_law.hpp"
#include "cuda/discrete/impulse_contacts.hpp"

namespace quadrille::cuda {

/// The law `impulse` on the device, bit for bit that of SequentialImpulse.
template <class Real>
class CudaImpulse final : public CudaLaw<Real> {
  public:
    CudaImpulse(const CudaOptions& options, const ThreadTeam& team)
        : CudaLaw<Real>(options, team) {}

  private:
    using CudaLaw<Real>::device_;
    using CudaLaw<Real>::bodies_;
    using CudaLaw<Real>::cells_;

    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;
    void fetchContacts(std::size_t count, const StepParameters<Real>& step,
                       std::vector<ContactRecord>& records) const override {
        contacts_.fetch(count, step, records);
    }

    void collect(const LawBodies<Real>& bodies, const Partition<Real>& partition);
    void keepOut(const LawBodies<Real>& bodies, std::uint32_t touched, Real dt);
    StepCounts tryStep(const Partition<Real>& partition, Step<Real>& step);

    StaticBarrier<Real> barrier_;
    DeviceArray<CandidatePair> candidates_{device_.budget()};
    std::uint32_t candidateCount_ = 0;
    std::uint64_t candidatesOf_ = 0;  // generation of the partition that they come from
    ImpulseContacts<Real> contacts_{device_, bodies_};
};

}  // namespace quadrille::cuda
