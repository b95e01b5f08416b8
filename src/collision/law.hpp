#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <quadrille/config.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/contact_record.hpp"
#include "collision/law_bodies.hpp"
#include "collision/phase_clock.hpp"
#include "collision/rules/step_parameters.hpp"

namespace quadrille {

struct ResolveCounts {
    std::uint64_t events = 0;  ///< of an exact law, whether bodies touched in them or not
    std::uint64_t contacts = 0;
    std::uint64_t collisions = 0;
    std::uint64_t pairsTested = 0;
};

template <class Real>
StepParameters<Real> parametersOf(const StepSettings& settings, double start) {
    return {.start = start,
            .dt = static_cast<Real>(settings.dt),
            .gravityX = static_cast<Real>(settings.gravity.x()),
            .gravityY = static_cast<Real>(settings.gravity.y()),
            .restitution = static_cast<Real>(settings.restitution)};
}

/// The step that a law carries out, and what it reports of it.
template <class Real>
struct Step {
    StepParameters<Real> parameters;
    double from, to;       ///< s since the start of the run
    bool keepContacts;     ///< somebody wants to see them afterwards
    bool audited = false;  ///< somebody looks at the bodies whenever the law takes over
    PhaseClock& clock;
    ResolveCounts counts{};
    bool rebuilt = false;  ///< by who makes cells of its own: it has made them anew
};

/// What moves bodies and resolves their contacts. A discrete law is an exact one whose reach is 0
/// and whose window is the whole step, so that one loop serves both (HostEngine::step).
template <class Real>
class ContactLaw {
  public:
    virtual ~ContactLaw() = default;

    /// The columns of state that the law keeps in the BodyStore.
    KeptColumns kept() const { return kept_; }

    /// Begins a step, with the bodies as they are at its start: a discrete law moves them to its
    /// end, an exact one takes over what was edited. Throws DeviceError, and has then moved
    /// nothing.
    virtual void begin(const LawBodies<Real>& bodies, Step<Real>& step) = 0;

    /// How far bodies may get until the law asks for another partition, unless an event makes one
    /// faster than it is now; nothing if the last partition still covers what is to come. `now` and
    /// `to` are the rest of the step, but the law may look beyond it, or not as far.
    virtual std::optional<Reach<Real>> reach(const LawBodies<Real>& bodies, double now,
                                             double to) = 0;

    /// Resolves what happens from `now` on, the partition covering the reach. Returns the time up
    /// to which that is done: the end of the step, or earlier, where the partition covers no more.
    /// Throws DeviceError, and has then changed nothing.
    virtual double advance(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                           double now, Step<Real>& step) = 0;

    /// Whether positions and velocities are those of the time up to which all is done; else they
    /// follow from the anchors.
    virtual bool placed() const { return true; }

    /// The contacts of the last step, if it was to keep them, in the order in which they count:
    /// canonical, or of `baseline` that of the cells. Valid until the next one.
    virtual std::span<const ContactRecord> contacts() = 0;

    /// Bytes of work space.
    virtual std::size_t bytes() const = 0;

  protected:
    explicit ContactLaw(KeptColumns kept = {}) : kept_(kept) {}

  private:
    KeptColumns kept_;
};

}  // namespace quadrille
