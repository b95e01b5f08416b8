#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "collision/law.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/event_order.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/memory.hpp"
#include "cuda/device/packed_upload.hpp"

namespace quadrille::cuda {

/// A copy of the host's bodies on the device, kept up to date with as little copying as possible:
/// they are sent when somebody edited them and otherwise moved here by the same rule as on the
/// host, and only those that contacts have changed come back.
template <class Real>
class DeviceBodies {
  public:
    /// `device` must outlive this.
    explicit DeviceBodies(DeviceSession& device);

    /// Makes the bodies those of the host, with the anchors of a law that has any.
    void load(const BodyView<Real>& view, PhaseClock& clock,
              std::span<const Anchor<Real>> anchors = {});
    /// Moves them to the end of a step, and zeroes the counts.
    void moveOn(const StepParameters<Real>& step);
    /// Copies positions and velocities to the rows that were loaded; writes nothing if that fails.
    void fetch(const MutableBodyView<Real>& bodies) const;

    /// Makes the bodies those of the host at the start of the step, and moves them to its end, to
    /// where the host moves its own. Zeroes the counts.
    void beginStep(const LawBodies<Real>& bodies, Step<Real>& step);
    /// Zeroes the counts within a step.
    void zeroCounts();
    /// Takes back what the step has done so far here, counts included, by sending the host's
    /// bodies, which are at its end.
    void restart(const LawBodies<Real>& bodies, PhaseClock& clock);
    /// Where the step's result is to be published.
    HostResult<Real> hostResult() const;
    /// Waits for the step's work, publishing included, and returns what it counted.
    const StepCounts& finish(PhaseClock& clock);
    /// Copies what contacts have changed to the host's bodies; the step has then succeeded.
    void writeBack(const LawBodies<Real>& bodies, PhaseClock& clock);

    const Bodies<Real>& bodies() const { return bodies_; }
    std::uint32_t movingCount() const { return movingCount_; }
    std::uint32_t fixedCount() const { return fixedCount_; }
    StepCounts* counts() const { return counts_.data(); }
    TouchedBodies touched() const { return {touchedRows_.data(), counts_.data()}; }

    /// The order of the contacts of the last step, for the host: by numbers of its own, since those
    /// of the host's bodies may have changed in the meantime.
    CanonicalOrder hostOrder() const;
    /// The same of events.
    EventOrder hostEventOrder() const;

    /// The entity in a moving row.
    std::uint32_t entityAt(std::uint32_t row) const {
        return upload_.onHost<std::uint32_t>(entity_)[row];
    }

    /// Of page-locked host memory.
    std::size_t hostBytes() const;

  private:
    DeviceSession& device_;
    PackedUpload upload_{device_.budget()};
    // Parts of it:
    std::size_t entity_ = 0, created_ = 0, fixedEntity_ = 0, fixedCreated_ = 0;
    Bodies<Real> bodies_{};
    std::uint32_t movingCount_ = 0, fixedCount_ = 0;
    std::uint64_t revision_ = 0;  // of the host's bodies that are here
    bool valid_ = false;          // the bodies here are those of the host

    DeviceArray<StepCounts> counts_{device_.budget()};
    DeviceArray<std::uint32_t> touchedRows_{device_.budget()};
    PinnedArray<StepCounts> hostCounts_;
    PinnedArray<std::uint32_t> hostRows_;
    PinnedArray<Real> hostColumns_;  // x, y, vx, vy of the touched bodies
};

}  // namespace quadrille::cuda
