#pragma once

#include <vector>

#include "collision/resolver.hpp"
#include "cuda/bodies/device_state.hpp"

namespace quadrille::cuda {

/// The law `baseline` on the device, bit for bit that of SequentialBaseline.
template <class Real>
class CudaBaseline final : public Resolver<Real> {
  public:
    /// `team` must outlive the resolver.
    CudaBaseline(const CudaOptions& options, const ThreadTeam& team) : state_(options, team) {}

    void integrated(const BodyView<Real>& bodies, const StepParameters<Real>& step,
                    PhaseClock& clock) override {
        state_.beginStep(bodies, step, clock);
    }
    ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                          const StepParameters<Real>& step,
                          std::vector<ContactRecord>* records) override;

    std::size_t bytes() const override { return state_.bytes(); }

  private:
    void reserve();
    void appendRecords(std::uint64_t count, const StepParameters<Real>& step,
                       std::vector<ContactRecord>& records) const;

    DeviceState<Real> state_;
    DeviceArray<std::uint32_t> heads_{state_.budget()}, done_{state_.budget()};
    DeviceArray<std::uint32_t> next_{state_.budget()}, turns_{state_.budget()};
    DeviceArray<bool> hit_{state_.budget()};
    DeviceArray<Real> future_{state_.budget()};
    DeviceArray<BaselineContact<Real>> contacts_{state_.budget()};
    std::uint32_t expected_ = 1024;  // contacts, judging by the last step
    bool hitsFalse_ = false;
};

}  // namespace quadrille::cuda
