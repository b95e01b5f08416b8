#pragma once

#include <vector>

#include "collision/resolver.hpp"
#include "cuda/bodies/device_state.hpp"

namespace quadrille::cuda {

/// The law `impulse` on the device, bit for bit that of SequentialImpulse.
template <class Real>
class CudaImpulse final : public Resolver<Real> {
  public:
    /// `team` must outlive the resolver.
    CudaImpulse(const CudaOptions& options, const ThreadTeam& team) : state_(options, team) {}

    void integrated(const BodyView<Real>& bodies, const StepParameters<Real>& step,
                    PhaseClock& clock) override {
        state_.beginStep(bodies, step, clock);
    }
    ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                          const StepParameters<Real>& step,
                          std::vector<ContactRecord>* records) override;

    std::size_t bytes() const override { return state_.bytes(); }

  private:
    void reserveLists();
    void reserveContacts(std::uint64_t count);
    void collect(const BodyView<Real>& bodies, const Partition<Real>& partition);
    void forgetSeenPairs(const Partition<Real>& partition);
    void launchStep(const Partition<Real>& partition, const StepParameters<Real>& step);
    void appendRecords(std::uint32_t count, const StepParameters<Real>& step,
                       std::vector<ContactRecord>& records) const;
    ContactList<Real> list() const;

    DeviceState<Real> state_;
    DeviceArray<CandidatePair> candidates_{state_.budget()};
    std::uint32_t candidateCount_ = 0;
    DeviceArray<PendingContact<Real>> contacts_{state_.budget()};
    DeviceArray<std::uint32_t> nextA_{state_.budget()}, nextB_{state_.budget()};
    DeviceArray<Successors> successors_{state_.budget()};
    DeviceArray<std::uint32_t> waiting_{state_.budget()};
    DeviceArray<bool> collided_{state_.budget()};
    DeviceArray<std::uint32_t> heads_{state_.budget()};
    DeviceArray<unsigned long long> seenSlots_{state_.budget()};
    SeenPairs seen_{};
    std::uint32_t capacity_ = 0;  // contacts for which there is room
    std::uint32_t expected_ = 0;  // contacts, judging by the last step
    bool listsEmpty_ = false;
};

}  // namespace quadrille::cuda
