#include "accuracy/run_comparison.hpp"

#include <algorithm>

#include <quadrille/error.hpp>
#include <quadrille/measure.hpp>

#include "accuracy/body_states.hpp"

namespace quadrille::accuracy {

namespace {

Event eventOf(const Contact& contact, double begin) {
    return {contact.time - begin, contact.numberA, contact.numberB, static_cast<int>(contact.axis)};
}

Precision lessPrecise(Precision a, Precision b) { return a == Precision::Float ? a : b; }

}  // namespace

RunComparison::RunComparison(Simulation& first, Simulation& second)
    : first_(first),
      second_(second),
      exchanged_(onlyExchanges(first) && onlyExchanges(second)),
      precision_(lessPrecise(first.config().precision, second.config().precision)),
      length_(meanSide(second.world())),
      firstBegin_(first.time()),
      secondBegin_(second.time()),
      matcher_(2 * std::max(first.config().step.dt, second.config().step.dt)) {
    const std::vector<BodyState> states = statesOf(second.world());
    if (first.world().movingCount() != states.size()) {
        throw Error("two runs with different bodies cannot be compared");
    }
    fastestAtStart_ = fastestComponent(states);
    wrong_.resize(states.size());
    first.onContact([this](const Contact& contact) {
        if (contact.collided) matcher_.addMeasured(eventOf(contact, firstBegin_));
    });
    second.onContact([this](const Contact& contact) {
        if (contact.collided) matcher_.addExact(eventOf(contact, secondBegin_));
    });
}

Divergence RunComparison::measure() {
    const std::vector<BodyState> measured = statesOf(first_.world());
    const std::vector<BodyState> exact = statesOf(second_.world());
    if (measured.size() != wrong_.size() || exact.size() != wrong_.size()) {
        throw Error("comparison: bodies were added or removed");
    }
    Divergence result{.time = second_.time() - secondBegin_,
                      .bodies = exact.size(),
                      .positionError = positionErrors(exact, measured, length_),
                      .length = length_,
                      .events = {}};
    result.velocityTolerance = velocityTolerance(
        exchanged_, precision_, std::max(fastestAtStart_, fastestComponent(exact)));
    const double apartFrom = Divergence::apartFrom * length_;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        wrong_[i] =
            velocityDiffers(exact[i].velocity, measured[i].velocity, result.velocityTolerance);
        result.wrongBodies += wrong_[i];
        // Written so that NaN counts as apart.
        result.apart += !((measured[i].position - exact[i].position).norm() <= apartFrom);
    }
    matcher_.advance(result.time);
    result.events = matcher_.match();
    result.overlapMax = {overlap(first_.world()).max / length_,
                         overlap(second_.world()).max / length_};
    return result;
}

}  // namespace quadrille::accuracy
