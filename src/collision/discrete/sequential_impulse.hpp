#pragma once

#include <vector>

#include "collision/discrete/canonical_sort.hpp"
#include "collision/pairs/narrow_phase.hpp"
#include "collision/resolver.hpp"
#include "collision/rules/canonical_order.hpp"

namespace quadrille {

/// The law `impulse` on one core: find all contacts, sort them canonically, resolve them one by
/// one. What every other resolver must reproduce bit for bit.
template <class Real>
class SequentialImpulse final : public Resolver<Real> {
  public:
    ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                          const StepParameters<Real>& step,
                          std::vector<ContactRecord>* records) override;

    std::size_t bytes() const override {
        return narrowPhase_.bytes() + sort_.bytes() +
               contacts_.capacity() * sizeof(PendingContact<Real>);
    }

  private:
    NarrowPhase<Real> narrowPhase_;
    std::vector<PendingContact<Real>> contacts_;
    CanonicalSort<Real> sort_;
};

}  // namespace quadrille
