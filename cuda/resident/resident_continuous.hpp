#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cuda/bodies/device_bodies.hpp"
#include "cuda/broad/device_grid.hpp"
#include "cuda/continuous/candidate_kernels.hpp"
#include "cuda/continuous/window_kernels.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/resident_pipeline.hpp"

namespace quadrille::cuda {

/// The law `continuous` with everything on the device, bit for bit that of ContinuousLaw: without
/// gravity, and with restitution 1.
///
/// A partition covers the bodies for several windows, a window being a step or an equal part of
/// one. Whatever has no room gets it, and whatever is too crowded gets shorter windows; a step that
/// would need too short ones is left to the host.
template <class Real>
class ResidentContinuous final : public ResidentPipeline<Real> {
  public:
    ResidentContinuous(const SimulationConfig& config, const Vec2& worldSize,
                       const ThreadTeam& team);

    bool runs() const override;
    KeptColumns kept() const override { return {.anchors = true}; }
    bool load(const LawBodies<Real>& bodies, double now, PhaseClock& clock) override;
    double step(Step<Real>& step) override;
    void fetch(const LawBodies<Real>& bodies) override;

    const Cells& cells() override;
    std::span<const ContactRecord> contacts() override { return records_; }
    std::size_t bytes() const override;

  private:
    ExactMotion<Real, StraightPath> motion() const;
    EventBodies<Real> eventBodies(bool record) const;
    void measure(const BodyView<Real>& bodies);

    /// A light body leaves a heavy one at up to twice the heavy one's speed.
    double gain() const { return uniformMass_ ? 1 : 2; }
    std::uint32_t partsOf(double length) const;
    double pairsOf(double life) const;
    void noteDensity(std::uint64_t pairs);
    std::uint32_t chooseWindows(double length) const;
    bool covers(double from, double to) const;
    bool partition(double now, double length, Step<Real>& step);
    void forgetWindows();
    WindowResult run(double from, double to, Step<Real>& step);
    bool mend(const WindowResult& result);
    void keepRecords(std::uint32_t count);

    SimulationConfig config_;
    Vec2 worldSize_;
    DeviceSession device_;
    DeviceBodies<Real> bodies_{device_};
    DeviceGrid<Real> grid_{device_, bodies_};

    // By rows:
    DeviceArray<std::uint32_t> stamps_{device_.budget()}, parents_{device_.budget()},
        firstEvent_{device_.budget()}, changedIn_{device_.budget()}, busyIn_{device_.budget()},
        eventOf_{device_.budget()};
    DeviceArray<EventMark> marks_{device_.budget()};
    DeviceArray<std::uint32_t> starts_{device_.budget()};  // and the end
    DeviceArray<PathSketch> sketches_{device_.budget()};

    // Of a partition:
    DeviceArray<CandidatePair> pairs_{device_.budget()};
    DeviceArray<BodyRef> others_{device_.budget()};
    DeviceArray<CandidatePair> entries_{device_.budget()};
    DeviceArray<Counter> entryCounts_{device_.budget()};
    DeviceArray<std::byte> scratch_{device_.budget()};
    DeviceArray<Survey> survey_{device_.budget()};  // and one that nobody reads
    std::size_t scratchBytes_ = 0;
    std::uint32_t pairRoom_ = 0, entryRoom_ = 0;

    // Of a window:
    DeviceArray<PairEvent> events_{device_.budget()};
    DeviceArray<Fate> fates_{device_.budget()};
    DeviceArray<Anchor<Real>> anchorsOf_{device_.budget()};
    DeviceArray<ContactRecord> recordOf_{device_.budget()};
    DeviceArray<std::uint32_t> concerned_{device_.budget()}, nextEvent_{device_.budget()},
        roots_{device_.budget()};
    DeviceArray<std::uint32_t> claimed_{device_.budget()};
    DeviceArray<Anchor<Real>> before_{device_.budget()};
    DeviceArray<RecordedContact> recorded_{device_.budget()};
    DeviceArray<WindowCounts> counts_{device_.budget()};
    std::uint32_t eventRoom_ = 0, claimedRoom_ = 0, recordRoom_ = 0;
    std::uint32_t number_ = 0;  // of the last window
    WindowExpectation expected_{};
    PinnedArray<WindowResult> result_;
    PinnedArray<Anchor<Real>> hostAnchors_;

    double now_ = 0;  // s; up to here all is done

    // What the bodies are like:
    bool uniformMass_ = true;
    double extent_ = 0, largest_ = 0;    // px; mean extent, and half of the largest
    double fastest_ = 0, farthest_ = 0;  // px/s and px along an axis, at the last partition
    double density_ = 0;                 // bodies/px^2, around a body

    // The partition:
    WindowLists lists_{};
    std::uint32_t done_ = 0;  // windows of it
    double bound_ = 0;        // px/s
    double margin_ = 0;       // px, for which the grid was laid
    float slack_ = 0;         // px, of the sketches
    double pairsExpected_ = 0;

    // The windows:
    std::uint32_t parts_ = 1;  // of a step
    std::uint32_t calm_ = 0;   // steps since the last that needed shorter ones

    std::vector<RecordedContact> recordedHere_;
    std::vector<ContactRecord> records_;
    Cells cells_;
    bool cellsHere_ = true;
};

}  // namespace quadrille::cuda
