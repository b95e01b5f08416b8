#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "collision/law.hpp"
#include "cuda/bodies/device_bodies.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/pairs/uploaded_cells.hpp"

namespace quadrille::cuda {

/// What the discrete laws have in common on a device: it moves a copy of the bodies and resolves
/// their contacts; the host moves its own bodies and takes over those that contacts have changed.
template <class Real>
class CudaLaw : public ContactLaw<Real> {
  public:
    void begin(const LawBodies<Real>& bodies, Step<Real>& step) override;
    std::optional<Reach<Real>> reach(const LawBodies<Real>&, double, double) override {
        return Reach<Real>{};
    }
    double advance(const LawBodies<Real>& bodies, const Partition<Real>& partition, double now,
                   Step<Real>& step) override;
    std::span<const ContactRecord> contacts() override { return records_; }
    std::size_t bytes() const override;

  protected:
    /// `team` must outlive the law. Throws DeviceError if there is no device.
    CudaLaw(const CudaOptions& options, const ThreadTeam& team) : device_(options, team) {}

    /// Finds and resolves the contacts on the device, there being moving bodies, and publishes what
    /// they have changed; adds to the step's counts.
    virtual void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                         Step<Real>& step) = 0;

    /// Brings the contacts that were resolved, kept on the device, in the order of the law.
    virtual void fetchContacts(std::size_t count, const StepParameters<Real>& step,
                               std::vector<ContactRecord>& records) const = 0;

    DeviceSession device_;
    DeviceBodies<Real> bodies_{device_};
    UploadedCells<Real> cells_{device_};

  private:
    std::vector<ContactRecord> records_;
};

}  // namespace quadrille::cuda
