#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <boost/version.hpp>

#include "bench/broad_phase.hpp"

namespace quadrille::bench {

namespace {

namespace bg = boost::geometry;

/// A tree of the moving boxes, packed anew in each frame, and a query for each of all boxes.
class BoostTree final : public BroadPhase {
  public:
    void find(const Boxes& boxes, Pairs& pairs) override {
        entries_.clear();
        for (std::uint32_t i = 0; i < boxes.moving; ++i) entries_.emplace_back(boxOf(boxes, i), i);
        const bg::index::rtree<Entry, bg::index::rstar<16>> tree(entries_);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const auto found = [&](const Entry& other) {
                const std::uint32_t j = other.second;
                if (j < i && boxes.overlap(i, j)) pairs.emplace_back(j, i);
            };
            tree.query(bg::index::intersects(boxOf(boxes, i)),
                       boost::make_function_output_iterator(found));
        }
    }

  private:
    using Point = bg::model::point<double, 2, bg::cs::cartesian>;
    using Box = bg::model::box<Point>;
    using Entry = std::pair<Box, std::uint32_t>;

    static Box boxOf(const Boxes& b, std::uint32_t i) {
        return {Point(b.x[i] - b.halfWidth[i], b.y[i] - b.halfHeight[i]),
                Point(b.x[i] + b.halfWidth[i], b.y[i] + b.halfHeight[i])};
    }

    std::vector<Entry> entries_;
};

}  // namespace

BroadPhaseKind boostBroadPhase() {
    const auto part = [](int value) { return std::to_string(value); };
    return {"Boost " + part(BOOST_VERSION / 100000) + "." + part(BOOST_VERSION / 100 % 1000) +
                " R-tree",
            [](const Setting&, const Boxes&) { return std::make_unique<BoostTree>(); }};
}

}  // namespace quadrille::bench
