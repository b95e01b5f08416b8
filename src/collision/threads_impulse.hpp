#pragma once

#include <vector>

#include "collision/canonical_sort.hpp"
#include "collision/contact_graph.hpp"
#include "collision/resolver.hpp"
#include "collision/threads_narrow_phase.hpp"

namespace quadrille {

/// The law `impulse` on several threads, bit for bit what SequentialImpulse does.
template <class Real>
class ThreadsImpulse final : public Resolver<Real> {
  public:
    /// `team` must outlive the resolver.
    explicit ThreadsImpulse(const ThreadTeam& team)
        : narrowPhase_(team), found_(team.size()), graph_(team) {}

    ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                          const StepParameters<Real>& step,
                          std::vector<ContactRecord>* records) override;

    std::size_t bytes() const override;

  private:
    ThreadsNarrowPhase<Real> narrowPhase_;
    std::vector<ContactList<Real>> found_;  // one a worker
    ContactList<Real> ordered_;             // of all workers, if contacts are to be recorded
    CanonicalSort<Real> sort_;
    ContactGraph<Real> graph_;
};

}  // namespace quadrille
