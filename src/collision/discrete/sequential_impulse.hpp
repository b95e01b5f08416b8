#pragma once

#include <vector>

#include "collision/discrete/canonical_sort.hpp"
#include "collision/discrete/discrete_law.hpp"
#include "collision/pairs/narrow_phase.hpp"
#include "collision/rules/canonical_order.hpp"

namespace quadrille {

/// The law `impulse` on one core: find all contacts, sort them canonically, resolve them one by
/// one. What every other resolver must reproduce bit for bit.
template <class Real>
class SequentialImpulse final : public DiscreteLaw<Real> {
  public:
    explicit SequentialImpulse(const ThreadTeam& team) : DiscreteLaw<Real>(team) {}

    std::span<const ContactRecord> contacts() override { return records_; }

    std::size_t bytes() const override {
        return narrowPhase_.bytes() + sort_.bytes() +
               contacts_.capacity() * sizeof(PendingContact<Real>) +
               records_.capacity() * sizeof(ContactRecord);
    }

  private:
    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;

    NarrowPhase<Real> narrowPhase_;
    std::vector<PendingContact<Real>> contacts_;
    CanonicalSort<Real> sort_;
    std::vector<ContactRecord> records_;
};

}  // namespace quadrille
