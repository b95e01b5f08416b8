#include "reference/lattice_oracle.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "reference/boxes.hpp"
#include "reference/lattice_model.hpp"
#include "reference/scheduler.hpp"

namespace quadrille::reference {

struct LatticeOracle::Impl {
    explicit Impl(std::vector<Box> given)
        : boxes(std::move(given)), model(boxes), scheduler(model, Rational()) {}

    std::vector<Box> boxes;
    LatticeModel model;
    Scheduler<LatticeModel> scheduler;  // refers to the model
    double now = 0;
};

LatticeOracle::LatticeOracle(std::vector<Box> boxes) {
    validate(boxes);
    impl_ = std::make_unique<Impl>(std::move(boxes));
}
LatticeOracle::~LatticeOracle() = default;
LatticeOracle::LatticeOracle(LatticeOracle&&) noexcept = default;
LatticeOracle& LatticeOracle::operator=(LatticeOracle&&) noexcept = default;

void LatticeOracle::runUntil(double time) {
    if (!(time >= impl_->now) || !std::isfinite(time)) {
        throw std::invalid_argument("time to run to is not finite or in the past");
    }
    impl_->scheduler.runUntil(impl_->model.timeOf(time));
    impl_->now = time;
}

double LatticeOracle::time() const { return impl_->now; }

std::vector<Box> LatticeOracle::state() const {
    std::vector<Box> boxes = impl_->boxes;
    std::int64_t i = 0;
    for (Box& box : boxes) {
        if (box.isStatic) continue;
        for (int k = 0; k < 2; ++k) {
            box.position[k] = impl_->model.position(i, k, impl_->now);
            box.velocity[k] = impl_->model.velocity(i, k);
        }
        ++i;
    }
    return boxes;
}

const std::vector<Event>& LatticeOracle::events() const { return impl_->scheduler.events(); }

}  // namespace quadrille::reference
