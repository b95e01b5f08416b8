#pragma once

#include <vector>

#include "collision/discrete/discrete_law.hpp"

namespace quadrille {

/// The law `baseline` on one core, as the report's program does it: cell by cell, pair by pair,
/// with its flaws. A pair is resolved once in each cell that it shares, whether it approaches or
/// not, and of several contacts of a body the last decides its velocity.
template <class Real>
class SequentialBaseline final : public DiscreteLaw<Real> {
  public:
    explicit SequentialBaseline(const ThreadTeam& team) : DiscreteLaw<Real>(team) {}

    std::span<const ContactRecord> contacts() override { return records_; }

    std::size_t bytes() const override {
        return (futureX_.capacity() + futureY_.capacity()) * sizeof(Real) +
               hit_.capacity() * sizeof(std::uint32_t) +
               records_.capacity() * sizeof(ContactRecord);
    }

  private:
    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;

    std::vector<Real> futureX_, futureY_;  // velocities after the step, of bodies in hit_
    std::vector<std::uint32_t> hit_;       // a row for each contact, repeated where hit again
    std::vector<ContactRecord> records_;
};

}  // namespace quadrille
