#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/contact_record.hpp"
#include "collision/rules/baseline_contact.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/impulse_contact.hpp"
#include "collision/rules/step_parameters.hpp"

namespace quadrille {

/// A contact of the law `impulse` that has been resolved.
template <class Real>
struct ResolvedContact {
    PendingContact<Real> contact;
    ContactOutcome<Real> outcome;
};

/// What observers are told about a contact; `stepStart` is in s since the start of the run.
template <class Real>
ContactRecord makeRecord(const ResolvedContact<Real>& resolved, double stepStart) {
    const PendingContact<Real>& c = resolved.contact;
    const auto& [x, y] = resolved.outcome;
    return {.time = stepStart + static_cast<double>(c.sinceStart),
            .a = c.a,
            .b = c.b,
            .axes = c.axes,
            .senseX = c.senseX,
            .senseY = c.senseY,
            .collided = resolved.outcome.collided(),
            .impulseX = static_cast<double>(x.impulse),
            .impulseY = static_cast<double>(y.impulse),
            .approachX = static_cast<double>(x.approach),
            .approachY = static_cast<double>(y.approach)};
}

/// The same for a contact of the law `baseline`, which knows no times within a step.
template <class Real>
ContactRecord makeRecord(std::uint32_t a, BodyRef b, const BaselineOutcome<Real>& outcome,
                         const StepParameters<Real>& step) {
    const auto sense = static_cast<std::int8_t>(outcome.penetration.sense);
    const bool alongX = outcome.penetration.axis == axisX;
    const auto impulse = static_cast<double>(outcome.impulse);
    const auto approach = static_cast<double>(outcome.approach);
    return {.time = step.start + static_cast<double>(step.dt),
            .a = a,
            .b = b,
            .axes = outcome.penetration.axis,
            .senseX = sense,
            .senseY = sense,
            .collided = true,
            .impulseX = alongX ? impulse : 0,
            .impulseY = alongX ? 0 : impulse,
            .approachX = alongX ? approach : 0,
            .approachY = alongX ? 0 : approach};
}

/// The same for an event of the law `continuous`.
QUADRILLE_HD inline ContactRecord makeRecord(const PairEvent& event, const EventContact& contact,
                                             const EventOutcomes& done) {
    return {.time = event.time,
            .a = event.a,
            .b = event.b,
            .axes = done.collided(),
            .senseX = contact.senseX,
            .senseY = contact.senseY,
            .collided = true,
            .impulseX = done.x.impulse,
            .impulseY = done.y.impulse,
            .approachX = done.x.approach,
            .approachY = done.y.approach};
}

}  // namespace quadrille
