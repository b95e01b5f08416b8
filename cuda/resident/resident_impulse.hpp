#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cuda/bodies/device_bodies.hpp"
#include "cuda/broad/device_grid.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/replay.hpp"
#include "cuda/discrete/impulse_contacts.hpp"
#include "cuda/resident/device_static_map.hpp"
#include "cuda/resident/resident_kernels.hpp"
#include "cuda/resident_pipeline.hpp"

namespace quadrille::cuda {

/// The law `impulse` with everything on the device, bit for bit that of SequentialImpulse.
template <class Real>
class ResidentImpulse final : public ResidentPipeline<Real> {
  public:
    ResidentImpulse(const SimulationConfig& config, const Vec2& worldSize, const ThreadTeam& team)
        : config_(config), worldSize_(worldSize), device_(config.cuda, team) {}

    bool load(const LawBodies<Real>& bodies, double now, PhaseClock& clock) override;
    double step(Step<Real>& step) override;
    void fetch(const LawBodies<Real>& bodies) override { bodies_.fetch(bodies); }

    const Cells& cells() override;
    std::span<const ContactRecord> contacts() override { return records_; }
    std::size_t bytes() const override;

  private:
    /// What launches depend on, beside what was loaded.
    struct Shape {
        std::uint32_t contacts, contactRoom, entryRoom;
        bool keepsContacts;

        bool operator==(const Shape&) const = default;
    };

    DeviceContacts<Real> begin(bool keepContacts);
    void enqueueStep(const DeviceContacts<Real>& list, const Step<Real>& step);
    void enqueueTry(const DeviceContacts<Real>& list, const Step<Real>& step);

    SimulationConfig config_;
    Vec2 worldSize_;
    DeviceSession device_;
    DeviceBodies<Real> bodies_{device_};
    DeviceGrid<Real> grid_{device_, bodies_};
    ImpulseContacts<Real> contacts_{device_, bodies_};
    DeviceStaticMap<Real> map_{device_};
    DeviceArray<Place<Real>> starts_{device_.budget()};  // by rows, of bodies with contacts
    PinnedArray<ResidentCounts> hostCounts_;
    Replay replay_;
    Shape shape_{};  // of the last step
    std::vector<ContactRecord> records_;
    Cells cells_;
    bool cellsHere_ = true;  // as of the last step
};

}  // namespace quadrille::cuda
