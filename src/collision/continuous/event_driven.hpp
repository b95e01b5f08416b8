#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "collision/continuous/continuous_law.hpp"
#include "collision/continuous/event_loop.hpp"
#include "collision/continuous/shared_events.hpp"
#include "collision/continuous/trajectories.hpp"
#include "collision/pairs/candidate_lists.hpp"
#include "collision/pairs/neighbours.hpp"

namespace quadrille {

/// The law `continuous`, for paths that are straight or fall.
///
/// Positions follow from anchors that change in events only, and an event's time from the
/// trajectories of its bodies only, so the state does not depend on dt; nor, since events are
/// carried out in an order that is complete, on who finds them.
template <class Real, class Path>
class EventDriven final : public ContinuousLaw<Real> {
  public:
    EventDriven(const SimulationConfig& config, const ThreadTeam& team);

    void anchor(const BodyView<Real>& bodies, double now) override;
    Real reach(const BodyView<Real>& bodies, double from, double to) override;
    double advance(const BodyView<Real>& bodies, const Partition<Real>& partition, Real reach,
                   double from, double to, std::vector<ContactRecord>* records,
                   ResolveCounts& counts) override;
    bool place(const BodyView<Real>& bodies, double t) const override;
    std::size_t bytes() const override;

  private:
    static constexpr bool falls = Path::falls;
    using Search = EventSearch<Real, Path>;

    struct alignas(64) Found {
        EventQueue events;
    };

    void survey(const BodyView<Real>& bodies);
    void findAll(const Search& search, double from, double to);
    bool runShared(const Search& search, const EventWindow<Real>& window,
                   std::vector<ContactRecord>* records, ResolveCounts& counts);

    const ThreadTeam& team_;
    std::array<double, 2> gravity_;  // px/s^2
    double restitution_;

    std::optional<std::uint64_t> revision_;  // of the bodies that all below is about
    bool surveyed_ = false;                  // whether these two are bounds:
    double fastest_ = 0;                     // px/s, along an axis
    double farthest_ = 0;                    // px, from the origin along an axis
    double horizon_ = -1;                    // s; all meetings up to here have been found

    CandidateLists<Real> candidates_;
    Neighbours neighbours_;
    std::vector<std::uint32_t> stamps_;  // changes of each body so far
    std::vector<Found> found_;           // by each worker
    EventLoopState events_;
    std::unique_ptr<SharedEvents<Real>> shared_;  // null where events take one thread
};

}  // namespace quadrille
