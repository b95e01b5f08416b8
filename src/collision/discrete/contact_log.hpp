#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "collision/contact_record.hpp"
#include "collision/make_record.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/impulse_contact.hpp"

namespace quadrille {

/// The contacts of a step by the law `impulse`, in the order in which whoever resolved them came
/// across them.
template <class Real>
class ContactLog {
  public:
    void clear() { resolved_.clear(); }
    void add(const PendingContact<Real>& contact, const ContactOutcome<Real>& outcome) {
        resolved_.push_back({contact, outcome});
    }
    void take(ContactLog& other) {
        resolved_.insert(resolved_.end(), other.resolved_.begin(), other.resolved_.end());
        other.clear();
    }
    void sort(const CanonicalOrder& order) {
        std::sort(resolved_.begin(), resolved_.end(),
                  [&](const auto& p, const auto& q) { return order(p.contact, q.contact); });
    }
    void appendTo(std::vector<ContactRecord>& records, double stepStart) const {
        for (const auto& resolved : resolved_) records.push_back(makeRecord(resolved, stepStart));
    }
    std::size_t bytes() const { return resolved_.capacity() * sizeof(ResolvedContact<Real>); }

  private:
    std::vector<ResolvedContact<Real>> resolved_;
};

}  // namespace quadrille
