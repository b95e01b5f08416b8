#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/contact_record.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/step_parameters.hpp"
#include "cuda/bodies/device_bodies.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/memory.hpp"
#include "cuda/discrete/impulse_kernels.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// Throws DeviceError if there are more than 31 bits count: with room for what grows beyond them,
/// contacts and pairs are counted in 32 bits on the device.
std::uint32_t count31(std::uint64_t count, const char* what);

/// The contacts of a step of the law `impulse` on the device. A try finds them into `begin`'s list,
/// then comes `resolve`; if `lacksRoom` says so of what the try has counted, nothing has happened
/// to the bodies, and after `makeRoom` there is another try. A step ends with `end`.
template <class Real>
class ImpulseContacts {
  public:
    /// Both must outlive this.
    ImpulseContacts(DeviceSession& device, DeviceBodies<Real>& bodies)
        : device_(device), bodies_(bodies) {}

    /// The list of contacts, empty. `shownOnce` says that no pair is shown twice, `keep` that
    /// somebody wants to know what they exchange.
    DeviceContacts<Real> begin(bool shownOnce, bool keep);
    void resolve(const DeviceContacts<Real>& list, const StepParameters<Real>& step);
    bool lacksRoom(const StepCounts& counts) const { return counts.contacts > capacity_; }
    void makeRoom(std::uint64_t contacts);
    /// The lists of the bodies must have been made empty again.
    void end(const StepCounts& counts);

    /// About so many there are in a try, judging by the step before.
    std::uint32_t expected() const { return expected_; }

    /// Brings those of the last step, if it kept them, in canonical order.
    void fetch(std::size_t count, const StepParameters<Real>& step,
               std::vector<ContactRecord>& records) const;

  private:
    void reserve(std::uint64_t count);
    SeenPairs forgetSeenPairs();

    DeviceSession& device_;
    DeviceBodies<Real>& bodies_;
    DeviceArray<PendingContact<Real>> contacts_{device_.budget()};
    DeviceArray<std::uint32_t> nextA_{device_.budget()}, nextB_{device_.budget()};
    DeviceArray<Successors> successors_{device_.budget()};
    DeviceArray<std::uint32_t> waiting_{device_.budget()};
    DeviceArray<ContactOutcome<Real>> outcomes_{device_.budget()};
    DeviceArray<std::uint32_t> heads_{device_.budget()};
    DeviceArray<unsigned long long> seenSlots_{device_.budget()};
    std::uint32_t capacity_ = 0;  // contacts for which there is room
    std::uint32_t expected_ = 0;
    bool listsEmpty_ = false;
};

}  // namespace quadrille::cuda
