#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "collision/discrete/canonical_sort.hpp"
#include "collision/discrete/contact_graph.hpp"
#include "collision/discrete/contact_log.hpp"
#include "collision/discrete/discrete_law.hpp"
#include "collision/pairs/threads_narrow_phase.hpp"
#include "collision/rules/impulse_contact.hpp"
#include "collision/static_barrier.hpp"

namespace quadrille {

/// The law `impulse` on several threads, bit for bit what SequentialImpulse does.
///
/// A contact may be resolved as soon as it is the first pending one of both its bodies; any such
/// order gives the state that the canonical one gives (deterministic reservations: Blelloch,
/// Fineman, Gibbons & Shun, "Internally deterministic parallel algorithms can be fast", 2012).
/// Workers find contacts in regions of their own, so that nearly every body has contacts of one
/// worker only. Each worker goes through its contacts in canonical order and puts off those that
/// touch a body of several workers, or a body that an earlier contact was put off for. What is left
/// is little, and resolved one by one, unless bodies lie in piles; then a ContactGraph takes it.
template <class Real>
class ThreadsImpulse final : public DiscreteLaw<Real> {
  public:
    /// `team` must outlive the law.
    explicit ThreadsImpulse(const ThreadTeam& team);

    std::span<const ContactRecord> contacts() override { return records_; }

    std::size_t bytes() const override;

  private:
    using Contacts = std::vector<PendingContact<Real>>;
    using Mark = std::uint32_t;

    struct Touched {
        std::uint32_t row;
        Place<Real> start;  ///< where it stood when the step began
    };
    struct alignas(64) Worker {
        CanonicalSort<Real> sort;
        ContactLog<Real> log;
        std::vector<Touched> touched;  // that this worker was the first to find
        ResolveCounts counts;
    };

    void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                 Step<Real>& step) override;

    std::size_t pending() const;
    void startMarks(std::size_t movingCount);
    bool claim(std::uint32_t body, unsigned worker);
    void touch(const Bodies<Real>& bodies, std::uint32_t row, Real dt, unsigned worker);
    void keepOut(const Bodies<Real>& bodies);
    Mark markOf(unsigned worker) const { return held_ + 1 + worker; }
    bool free(const PendingContact<Real>& c, unsigned worker) const;
    void hold(const PendingContact<Real>& c);
    void resolveOwn(const Bodies<Real>& bodies, const Step<Real>& step, unsigned worker);
    void resolveRest(const Bodies<Real>& bodies, Step<Real>& step, bool complete);
    void makeRecords(const Bodies<Real>& bodies, double stepStart);

    const ThreadTeam& team_;
    StaticBarrier<Real> barrier_;
    ThreadsNarrowPhase<Real> narrowPhase_;
    std::vector<ContactList<Real>> found_;  // by each worker; in the end, what it put off
    std::vector<Worker> workers_;
    ContactGraph<Real> graph_;
    Contacts rest_;  // of all workers
    CanonicalSort<Real> sortRest_;
    ContactLog<Real> log_;
    std::vector<ContactRecord> records_;

    // A mark for each moving body: below held_ it is of an earlier step and means nothing; held_
    // says that contacts of this body must wait; more is the worker that has contacts with it.
    std::unique_ptr<std::atomic<Mark>[]> marks_;
    std::size_t markCount_ = 0;
    Mark held_ = 0;
};

}  // namespace quadrille
