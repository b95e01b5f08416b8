#include "engines/fallback.hpp"

#include <utility>

#include <quadrille/error.hpp>

namespace quadrille {

FallbackEngine::FallbackEngine(const Make& first, Make substitute)
    : substitute_(std::move(substitute)) {
    try {
        engine_ = first();
    } catch (const DeviceError& failure) {
        failure_ = failure.what();
        engine_ = substitute_();
    }
}

void FallbackEngine::step(BodyStore& store, StepWindow& window, StepReport& report) {
    if (failure_.empty()) {
        const StepReport before = report;
        try {
            engine_->step(store, window, report);
            return;
        } catch (const DeviceError& failure) {
            failure_ = failure.what();
            engine_ = substitute_();
            report = before;  // what it had counted is counted again
        }
    }
    // A step that has begun is gone on with: the window knows.
    engine_->step(store, window, report);
}

}  // namespace quadrille
