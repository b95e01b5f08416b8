#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/version.h>

#include "bench/broad_phase.hpp"

namespace quadrille::bench {

namespace {

/// Zomorodian and Edelsbrunner 2002: streamed segment trees.
class Cgal final : public BroadPhase {
  public:
    void find(const Boxes& boxes, Pairs& pairs) override {
        boxes_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            double low[] = {boxes.x[i] - boxes.halfWidth[i], boxes.y[i] - boxes.halfHeight[i]};
            double high[] = {boxes.x[i] + boxes.halfWidth[i], boxes.y[i] + boxes.halfHeight[i]};
            boxes_.emplace_back(low, high, i);
        }
        CGAL::box_self_intersection_d(
            boxes_.begin(), boxes_.end(),
            [&](const Box& a, const Box& b) {
                if (std::min(a.info(), b.info()) < boxes.moving &&
                    boxes.overlap(a.info(), b.info())) {
                    pairs.emplace_back(a.info(), b.info());
                }
            },
            std::ptrdiff_t(10), CGAL::Box_intersection_d::HALF_OPEN);
    }

  private:
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::uint32_t>;
    std::vector<Box> boxes_;
};

}  // namespace

BroadPhaseKind cgalBroadPhase() {
    return {"CGAL " CGAL_VERSION_STR " box_self_intersection_d",
            [](const Setting&, const Boxes&) { return std::make_unique<Cgal>(); }};
}

}  // namespace quadrille::bench
