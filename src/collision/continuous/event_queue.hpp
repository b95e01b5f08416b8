#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "collision/rules/event_order.hpp"

namespace quadrille {

/// Events to come, the earliest first in an order that is complete, so that the one in which they
/// are pushed does not matter. Those of the present step lie in a heap, which stays small that way;
/// later ones in no order.
class EventQueue {
  public:
    /// Goes on to the step that ends at `to`, in s.
    void begin(double to, const EventOrder& order) {
        end_ = to;
        order_ = order;
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

    /// Forgets what is later than a time.
    void forgetAfter(double time) {
        const auto later = [time](const PairEvent& event) { return event.time > time; };
        std::erase_if(heap_, later);
        std::erase_if(later_, later);
    }

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
    EventOrder order_;
    double end_ = -1;  // s
    std::vector<PairEvent> heap_;
    std::vector<PairEvent> later_;
};

}  // namespace quadrille
