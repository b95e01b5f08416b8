#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "collision/rules/contact_order.hpp"

namespace quadrille {

/// Sorts contacts into canonical order by bucket sort. Times of impact, and the priorities that
/// order contacts of time zero, spread evenly, so that with a bucket per contact most buckets hold
/// one; a crowded bucket costs what any sort would.
template <class Real>
class CanonicalSort {
  public:
    void operator()(std::vector<PendingContact<Real>>& contacts, const CanonicalOrder& order,
                    Real dt) {
        if (contacts.size() < 2) return;
        const auto atStart = static_cast<std::uint64_t>(std::count_if(
            contacts.begin(), contacts.end(), [](const auto& c) { return c.sinceStart == 0; }));
        const std::uint64_t later = contacts.size() - atStart;
        const Real perSecond = static_cast<Real>(later) / dt;
        const auto bucketOf = [&](const PendingContact<Real>& c) -> std::size_t {
            if (c.sinceStart == 0) return static_cast<std::size_t>(c.priority * atStart >> 32);
            const Real bucket = c.sinceStart * perSecond;
            const bool inside = bucket < static_cast<Real>(later - 1);
            return static_cast<std::size_t>(
                atStart + (inside ? static_cast<std::uint64_t>(bucket) : later - 1));
        };

        if (contacts.size() > ends_.capacity()) ends_.reserve(2 * contacts.size());
        ends_.assign(contacts.size(), 0);
        for (const auto& c : contacts) ++ends_[bucketOf(c)];
        std::uint32_t end = 0;
        for (std::uint32_t& bucket : ends_) bucket = end += bucket;
        sorted_.resize(contacts.size());
        // From the last down, so that a bucket's end becomes its start.
        for (std::size_t i = contacts.size(); i-- > 0;) {
            sorted_[--ends_[bucketOf(contacts[i])]] = contacts[i];
        }
        std::swap(contacts, sorted_);

        for (std::size_t b = 0; b < ends_.size(); ++b) {
            const auto first = contacts.begin() + ends_[b];
            const auto last =
                b + 1 < ends_.size() ? contacts.begin() + ends_[b + 1] : contacts.end();
            if (last - first > 1) std::sort(first, last, order);
        }
    }

    std::size_t bytes() const {
        return sorted_.capacity() * sizeof(PendingContact<Real>) +
               ends_.capacity() * sizeof(std::uint32_t);
    }

  private:
    std::vector<PendingContact<Real>> sorted_;
    std::vector<std::uint32_t> ends_;
};

}  // namespace quadrille
