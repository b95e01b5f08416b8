#include <algorithm>
#include <numeric>

#include "bench/broad_phase.hpp"

namespace quadrille::bench {

namespace {

class AllWithAll final : public BroadPhase {
  public:
    void find(const Boxes& boxes, Pairs& pairs) override {
        for (std::uint32_t i = 0; i < boxes.moving; ++i) {
            for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
                if (boxes.overlap(i, j)) pairs.emplace_back(i, j);
            }
        }
    }
};

/// Sort and sweep (sweep and prune) along x.
class Sweep final : public BroadPhase {
  public:
    explicit Sweep(bool keepOrder) : keepOrder_(keepOrder) {}

    void find(const Boxes& boxes, Pairs& pairs) override {
        if (intervals_.size() != boxes.size()) {
            intervals_.resize(boxes.size());
            for (std::uint32_t i = 0; i < boxes.size(); ++i) intervals_[i].body = i;
        }
        for (Interval& v : intervals_) {
            const std::uint32_t i = v.body;
            v = {boxes.x[i] - boxes.halfWidth[i], boxes.x[i] + boxes.halfWidth[i],
                 boxes.y[i] - boxes.halfHeight[i], boxes.y[i] + boxes.halfHeight[i], i};
        }
        keepOrder_&& sorted_ ? insertionSort()
                             : std::sort(intervals_.begin(), intervals_.end(), before);
        sorted_ = true;
        for (auto a = intervals_.begin(); a != intervals_.end(); ++a) {
            for (auto b = a + 1; b != intervals_.end() && b->left < a->right; ++b) {
                const bool meet = a->bottom < b->top && b->bottom < a->top && a->left < b->right;
                if (meet && std::min(a->body, b->body) < boxes.moving) {
                    pairs.emplace_back(a->body, b->body);
                }
            }
        }
    }

  private:
    struct Interval {
        double left, right, bottom, top;
        std::uint32_t body;
    };
    static bool before(const Interval& a, const Interval& b) { return a.left < b.left; }

    /// Bodies hardly pass each other in a step.
    void insertionSort() {
        for (auto next = intervals_.begin() + 1; next != intervals_.end(); ++next) {
            const Interval v = *next;
            auto hole = next;
            for (; hole != intervals_.begin() && before(v, hole[-1]); --hole) *hole = hole[-1];
            *hole = v;
        }
    }

    bool keepOrder_;
    bool sorted_ = false;
    std::vector<Interval> intervals_;
};

}  // namespace

std::vector<BroadPhaseKind> plainBroadPhases() {
    return {{"all with all",
             [](const Setting&, const Boxes&) { return std::make_unique<AllWithAll>(); }},
            {"sort and sweep",
             [](const Setting&, const Boxes&) { return std::make_unique<Sweep>(false); }},
            {"sort and sweep, order kept",
             [](const Setting&, const Boxes&) { return std::make_unique<Sweep>(true); }}};
}

}  // namespace quadrille::bench
