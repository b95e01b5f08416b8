#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace quadrille {

/// What is going to happen to a pair of bodies, unless something happens to one of them before.
struct PairEvent {
    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    double time;                   ///< s
    std::uint32_t priority;        ///< orders events of the same time
    std::uint32_t a, b;            ///< rows; b with staticBit for a static body
    std::uint32_t stampA, stampB;  ///< of the trajectories that it was found from
    std::uint8_t axes;             ///< of the contact; 0 for a pair that overlaps already
    bool release;                  ///< the axes' support comes to its end

    bool withStatic() const { return (b & staticBit) != 0; }
};

/// Events to come. Those of the present step lie in a heap, which stays small that way; later ones
/// in no order.
class EventQueue {
  public:
    /// Goes on to the step that ends at `to`.
    void begin(double to) {
        end_ = to;
        std::size_t kept = 0;
        for (const PairEvent& event : later_) {
            if (event.time > to) {
                later_[kept++] = event;
            } else {
                heap_.push_back(event);
            }
        }
        later_.resize(kept);
        std::make_heap(heap_.begin(), heap_.end(), isLater);
    }

    void push(const PairEvent& event) {
        if (event.time > end_) {
            later_.push_back(event);
            return;
        }
        heap_.push_back(event);
        std::push_heap(heap_.begin(), heap_.end(), isLater);
    }

    /// Whether nothing more happens in the present step.
    bool empty() const { return heap_.empty(); }

    /// The earliest event; ties go by priority, then by the rows.
    PairEvent pop() {
        std::pop_heap(heap_.begin(), heap_.end(), isLater);
        const PairEvent event = heap_.back();
        heap_.pop_back();
        return event;
    }

    void clear() {
        heap_.clear();
        later_.clear();
    }

    std::size_t bytes() const { return (heap_.capacity() + later_.capacity()) * sizeof(PairEvent); }

  private:
    static bool isLater(const PairEvent& p, const PairEvent& q) {
        if (p.time != q.time) return p.time > q.time;
        if (p.priority != q.priority) return p.priority > q.priority;
        if (p.a != q.a) return p.a > q.a;
        return p.b > q.b;
    }

    double end_ = -1;  // s
    std::vector<PairEvent> heap_;
    std::vector<PairEvent> later_;
};

}  // namespace quadrille
