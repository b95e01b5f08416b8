#pragma once

#include <vector>

#include "collision/broad/quadtree.hpp"

namespace quadrille {

/// A quadtree that is kept for several steps: with a skin until a body may have left its inflated
/// box, or by the report's policy for a fixed number of steps.
template <class Real>
class SemiStaticQuadtreePartitioner final : public Partitioner<Real> {
  public:
    SemiStaticQuadtreePartitioner(const SemiStaticQuadtree& config, const Vec2& worldSize,
                                  const ThreadTeam& team);

    bool update(const BodyView<Real>& bodies, Real dt, const Reach<Real>& reach) override;

    std::size_t bytes() const override;

  private:
    void rebuild(const BodyView<Real>& bodies, const Reach<Real>& reach, Real skin);
    void rememberPositions(const BodyView<Real>& bodies);
    bool anyLeft(const BodyView<Real>& bodies) const;
    double walked(const BodyView<Real>& bodies) const;
    Real chooseSkin(const BodyView<Real>& bodies, Real dt) const;

    SemiStaticQuadtree config_;
    const ThreadTeam& team_;
    QuadtreeBuilder<Real> builder_;
    std::vector<Real> builtX_, builtY_;  // positions at the last build, where a skin is watched
    std::uint64_t builtRevision_ = 0, builtLayout_ = 0;
    std::uint32_t age_ = 0;  // steps since the last build
};

}  // namespace quadrille
