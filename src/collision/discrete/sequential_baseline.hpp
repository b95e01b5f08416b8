#pragma once

#include <vector>

#include "collision/resolver.hpp"

namespace quadrille {

/// The law `baseline` on one core, as the report's program does it: cell by cell, pair by pair,
/// with its flaws. A pair is resolved once in each cell that it shares, whether it approaches or
/// not, and of several contacts of a body the last decides its velocity.
template <class Real>
class SequentialBaseline final : public Resolver<Real> {
  public:
    ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                          const StepParameters<Real>& step,
                          std::vector<ContactRecord>* records) override;

    std::size_t bytes() const override {
        return (futureX_.capacity() + futureY_.capacity()) * sizeof(Real) +
               hit_.capacity() * sizeof(std::uint32_t);
    }

  private:
    std::vector<Real> futureX_, futureY_;  // velocities after the step, of bodies in hit_
    std::vector<std::uint32_t> hit_;       // a row for each contact, repeated where hit again
};

}  // namespace quadrille
