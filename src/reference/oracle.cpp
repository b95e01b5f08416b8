#include "reference/oracle.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "reference/boxes.hpp"
#include "reference/scheduler.hpp"
#include "reference/track_model.hpp"

namespace quadrille::reference {

struct Oracle::Impl {
    Impl(std::vector<Box> given, const Vec2& gravity, double restitution, Ties ties)
        : boxes(std::move(given)), model(boxes, gravity, restitution, ties), scheduler(model, 0) {}

    std::vector<Box> boxes;
    TrackModel model;
    Scheduler<TrackModel> scheduler;  // refers to the model
    double now = 0;
};

Oracle::Oracle(std::vector<Box> boxes, const Vec2& gravity, double restitution, Ties ties) {
    validate(boxes);
    if (!gravity.allFinite()) throw std::invalid_argument("gravity is not finite");
    if (!(restitution >= 0 && restitution <= 1)) {
        throw std::invalid_argument("restitution is not in [0, 1]");
    }
    impl_ = std::make_unique<Impl>(std::move(boxes), gravity, restitution, ties);
}
Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;

void Oracle::runUntil(double time) {
    if (!(time >= impl_->now) || !std::isfinite(time)) {
        throw std::invalid_argument("time to run to is not finite or in the past");
    }
    impl_->scheduler.runUntil(time);
    impl_->now = time;
}

double Oracle::time() const { return impl_->now; }

std::vector<Box> Oracle::state() const {
    std::vector<Box> boxes = impl_->boxes;
    std::int64_t i = 0;
    for (Box& box : boxes) {
        if (box.isStatic) continue;
        box.position = impl_->model.position(i, impl_->now);
        box.velocity = impl_->model.velocity(i, impl_->now);
        ++i;
    }
    return boxes;
}

const Oracle::Choices& Oracle::choices() const { return impl_->model.choices(); }

const std::vector<Event>& Oracle::events() const { return impl_->scheduler.events(); }

}  // namespace quadrille::reference
