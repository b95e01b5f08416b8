#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/discrete/canonical_sort.hpp"
#include "collision/discrete/discrete_law.hpp"
#include "collision/pairs/narrow_phase.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/static_barrier.hpp"

namespace quadrille {

/// The law `impulse` on one core: find all contacts, sort them canonically, resolve them one by
/// one, and keep the bodies that had any out of static boxes. What every other resolver must
/// reproduce bit for bit.
template <class Real>
class SequentialImpulse final : public DiscreteLaw<Real> {
  public:
    explicit SequentialImpulse(const ThreadTeam& team) : DiscreteLaw<Real>(team) {}

    std::span<const ContactRecord> contacts() override { return records_; }

    std::size_t bytes() const override {
        return narrowPhase_.bytes() + sort_.bytes() +
               contacts_.capacity() * sizeof(PendingContact<Real>) +
               records_.capacity() * sizeof(ContactRecord) + barrier_.bytes() +
               starts_.capacity() * sizeof(Place<Real>) +
               (touched_.capacity() + marks_.capacity()) * sizeof(std::uint32_t);
    }

  private:
    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;

    void addStatic(const Bodies<Real>& bodies, StaticPair p, Real dt);
    void listTouched(const Bodies<Real>& bodies, std::size_t movingCount, Real dt);

    NarrowPhase<Real> narrowPhase_;
    std::vector<PendingContact<Real>> contacts_;
    CanonicalSort<Real> sort_;
    std::vector<ContactRecord> records_;
    StaticBarrier<Real> barrier_;
    std::vector<std::uint32_t> touched_;  // rows of bodies with contacts: the first touchedCount_
    std::vector<Place<Real>> starts_;     // of these
    std::size_t touchedCount_ = 0;
    std::vector<std::uint32_t> marks_;  // of a moving row: the last step in which it was listed
    std::uint32_t mark_ = 0;            // of this step
};

}  // namespace quadrille
