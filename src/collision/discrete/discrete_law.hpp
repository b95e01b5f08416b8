#pragma once

#include <optional>

#include "collision/integrate.hpp"
#include "collision/law.hpp"

namespace quadrille {

/// What the discrete laws have in common on the host: bodies move to the end of the step, and then
/// the contacts there are resolved.
template <class Real>
class DiscreteLaw : public ContactLaw<Real> {
  public:
    void begin(const LawBodies<Real>& bodies, Step<Real>& step) override {
        integrateAll(bodies, step.parameters, team_);
    }
    std::optional<Reach<Real>> reach(const LawBodies<Real>&, double, double) override {
        return Reach<Real>{};
    }
    double advance(const LawBodies<Real>& bodies, const Partition<Real>& partition, double,
                   Step<Real>& step) override {
        resolve(bodies, partition, step);
        return step.to;
    }

  protected:
    /// `team` must outlive the law.
    explicit DiscreteLaw(const ThreadTeam& team) : team_(team) {}
    virtual void resolve(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                         Step<Real>& step) = 0;

  private:
    const ThreadTeam& team_;
};

}  // namespace quadrille
