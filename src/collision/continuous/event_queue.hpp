#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/rules/canonical_order.hpp"

namespace quadrille {

/// What is going to happen to a pair of bodies, unless something happens to one of them before.
struct PairEvent {
    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    double time;                   ///< s
    std::uint32_t a, b;            ///< rows; b with staticBit for a static body
    std::uint32_t stampA, stampB;  ///< of the trajectories that it was found from
    std::uint8_t axes;             ///< of the contact; 0 for a pair that overlaps already
    bool release;                  ///< the axes' support comes to its end

    bool withStatic() const { return (b & staticBit) != 0; }
};

/// Events to come, the earliest first; ties go by the hash of the pair's entities, then by its rows
/// and by what happens, so that the order in which they are pushed does not matter. Those of the
/// present step lie in a heap, which stays small that way; later ones in no order.
class EventQueue {
  public:
    /// Goes on to the step that ends at `to`. The entities are those of the rows of moving and of
    /// static bodies.
    void begin(double to, std::span<const std::uint32_t> moving,
               std::span<const std::uint32_t> fixed) {
        end_ = to;
        order_ = {moving.data(), fixed.data()};
        std::size_t kept = 0;
        for (const PairEvent& event : later_) {
            if (event.time > to) {
                later_[kept++] = event;
            } else {
                heap_.push_back(event);
            }
        }
        later_.resize(kept);
        std::make_heap(heap_.begin(), heap_.end(), order_);
    }

    void push(const PairEvent& event) {
        if (event.time > end_) {
            later_.push_back(event);
            return;
        }
        heap_.push_back(event);
        std::push_heap(heap_.begin(), heap_.end(), order_);
    }

    /// Whether nothing more happens in the present step.
    bool empty() const { return heap_.empty(); }

    PairEvent pop() {
        std::pop_heap(heap_.begin(), heap_.end(), order_);
        const PairEvent event = heap_.back();
        heap_.pop_back();
        return event;
    }

    /// The events known for the present step, in no order.
    std::span<const PairEvent> due() const { return heap_; }

    void clear() {
        heap_.clear();
        later_.clear();
    }

    // ---- or, where several queues share a step, each with some of its events

    /// Goes on to the step of another queue, with these of its events.
    void beginShare(const EventQueue& whole, std::span<const PairEvent> events) {
        end_ = whole.end_;
        order_ = whole.order_;
        heap_.assign(events.begin(), events.end());
        std::make_heap(heap_.begin(), heap_.end(), order_);
        later_.clear();
    }

    /// Forgets the events of the present step.
    void dropDue() { heap_.clear(); }

    /// Takes all events of a queue that shared the step.
    void take(EventQueue& share) {
        for (const PairEvent& event : share.heap_) push(event);
        later_.insert(later_.end(), share.later_.begin(), share.later_.end());
        share.clear();
    }

    /// Whether p comes after q.
    bool isLater(const PairEvent& p, const PairEvent& q) const { return order_(p, q); }

    std::size_t bytes() const { return (heap_.capacity() + later_.capacity()) * sizeof(PairEvent); }

  private:
    /// Whether p comes after q.
    struct Order {
        const std::uint32_t* moving = nullptr;
        const std::uint32_t* fixed = nullptr;

        std::uint32_t priority(const PairEvent& e) const {
            return pairPriority(moving[e.a],
                                e.withStatic() ? fixed[e.b & ~PairEvent::staticBit] : moving[e.b]);
        }
        bool operator()(const PairEvent& p, const PairEvent& q) const {
            if (p.time != q.time) return p.time > q.time;
            return tieIsLater(p, q);
        }
        bool tieIsLater(const PairEvent& p, const PairEvent& q) const {
            const std::uint32_t first = priority(p);
            const std::uint32_t second = priority(q);
            if (first != second) return first > second;
            if (p.a != q.a) return p.a > q.a;
            if (p.b != q.b) return p.b > q.b;
            if (p.axes != q.axes) return p.axes > q.axes;
            return p.release && !q.release;
        }
    };

    Order order_;
    double end_ = -1;  // s
    std::vector<PairEvent> heap_;
    std::vector<PairEvent> later_;
};

}  // namespace quadrille
