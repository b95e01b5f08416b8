#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "collision/continuous/event_lists.hpp"
#include "collision/rules/event_order.hpp"

namespace quadrille {

/// Events to come, the earliest first in an order that is complete, so that the one in which they
/// are pushed does not matter.
///
/// A calendar (Brown 1988, "Calendar queues"): time is cut into spans of one length. The events of
/// the present span lie in a heap, which stays so small that it costs the same however many bodies
/// there are; those of later spans lie in no order.
class EventQueue {
  public:
    /// Goes on to the step that ends at `to`, in s. The order must be the same as long as there are
    /// events.
    void begin(double to, const EventOrder& order) {
        end_ = to;
        order_ = order;
    }

    /// From here on events are only pushed, until spread().
    void collect() {
        const auto set = [&](const PairEvent& event) { later_.push(0, event); };
        later_.reserve(1);
        for (std::size_t span = present_ + 1; span < later_.size(); ++span) later_.drain(span, set);
        std::for_each(heap_.begin(), heap_.end(), set);
        heap_.clear();
        collecting_ = true;
    }

    /// Cuts the time from `from` to `to`, in s, into spans that have a few of the events each.
    void spread(double from, double to) {
        collect();
        collecting_ = false;
        count_ = std::clamp<std::size_t>(later_.count(0) / eventsOfSpan, 1, mostSpans);
        later_.reserve(count_ + 1);
        from_ = from;
        to_ = to;
        const double perSecond = static_cast<double>(count_) / (to - from);
        perSecond_ = perSecond <= std::numeric_limits<double>::max() ? perSecond : 0;
        present_ = 0;
        later_.drain(0, [&](const PairEvent& event) {
            const std::size_t span = spanOf(event.time);
            span == 0 ? heap_.push_back(ranked(event)) : later_.push(span, event);
        });
        std::make_heap(heap_.begin(), heap_.end(), isAfter());
    }

    void push(const PairEvent& event) {
        const std::size_t span = collecting_ ? 0 : spanOf(event.time);
        if (collecting_ || span > present_) {
            later_.push(span, event);
            return;
        }
        heap_.push_back(ranked(event));
        std::push_heap(heap_.begin(), heap_.end(), isAfter());
    }

    /// Whether anything more happens in the present step. Calls `begun()` where a span with events
    /// begins.
    template <class Begun>
    bool more(Begun&& begun) {
        while (heap_.empty() && present_ < lastSpan()) {
            ++present_;
            if (later_.empty(present_)) continue;
            later_.drain(present_, [&](const PairEvent& event) { heap_.push_back(ranked(event)); });
            std::make_heap(heap_.begin(), heap_.end(), isAfter());
            begun();
        }
        return !heap_.empty() && heap_.front().time <= end_;
    }
    bool empty() {
        return !more([] {});
    }

    /// The first event; there must be more().
    PairEvent pop() {
        std::pop_heap(heap_.begin(), heap_.end(), isAfter());
        const PairEvent event = heap_.back();
        heap_.pop_back();
        return event;
    }

    /// Calls `function(event)` for the events of the present span, in no order.
    template <class Function>
    void forEachPresent(Function&& function) const {
        std::for_each(heap_.begin(), heap_.end(), function);
    }

    /// Calls `function(event)` for the events known for the present step, in no order.
    template <class Function>
    void forEachDue(Function&& function) const {
        const auto call = [&](const PairEvent& event) {
            if (event.time <= end_) function(event);
        };
        std::for_each(heap_.begin(), heap_.end(), call);
        for (std::size_t span = present_ + 1; span <= lastSpan(); ++span)
            later_.forEach(span, call);
    }
    std::size_t dueCount() const {
        std::size_t count = 0;
        forEachDue([&](const PairEvent&) { ++count; });
        return count;
    }

    /// Forgets what is later than a time.
    void forgetAfter(double time) {
        forget(later_.size(), [time](const PairEvent& event) { return event.time > time; });
    }

    void clear() {
        heap_.clear();
        for (std::size_t span = 0; span < later_.size(); ++span) later_.drain(span, ignore);
        collecting_ = false;
    }

    // ---- or, where several queues share a step, each with some of its events

    /// Goes on to the step of another queue, with these of its events.
    void beginShare(const EventQueue& whole, std::span<const PairEvent> events) {
        clear();
        begin(whole.end_, whole.order_);
        double first = end_;
        collect();
        for (const PairEvent& event : events) {
            first = std::min(first, event.time);
            push(event);
        }
        spread(first, end_);
    }

    /// Forgets the events of the present step.
    void dropDue() {
        forget(lastSpan() + 1, [this](const PairEvent& event) { return event.time <= end_; });
    }

    /// Takes all events of a queue that shared the step.
    void take(EventQueue& share) {
        const auto get = [&](const PairEvent& event) { push(event); };
        std::for_each(share.heap_.begin(), share.heap_.end(), get);
        for (std::size_t span = 0; span < share.later_.size(); ++span)
            share.later_.drain(span, get);
        share.clear();
    }

    /// Whether p comes after q.
    bool isLater(const PairEvent& p, const PairEvent& q) const { return order_(p, q); }

    std::size_t bytes() const { return heap_.capacity() * sizeof(Ranked) + later_.bytes(); }

  private:
    static constexpr std::size_t eventsOfSpan = 32;
    static constexpr std::size_t mostSpans = 1 << 20;

    /// An event with its place among those of its time, which otherwise each comparison of two
    /// would have to look up: where bodies set out from a lattice, hundreds meet at the same
    /// instant.
    struct Ranked : PairEvent {
        std::uint32_t priority;
    };
    Ranked ranked(const PairEvent& event) const { return {event, order_.priority(event)}; }
    struct IsAfter {
        const EventOrder& order;
        bool operator()(const Ranked& p, const Ranked& q) const {
            if (p.time != q.time) return p.time > q.time;
            if (p.priority != q.priority) return p.priority > q.priority;
            return order.tieIsLater(p, q);
        }
    };
    IsAfter isAfter() const { return {order_}; }

    /// Later times have no lower span, whatever is rounded. What is beyond the calendar has one of
    /// its own behind it.
    std::size_t spanOf(double time) const {
        if (time > to_) return count_;
        const double span = (time - from_) * perSecond_;
        if (!(span > 0)) return 0;
        return std::min(static_cast<std::size_t>(span), count_ - 1);
    }
    /// In which the present step ends.
    std::size_t lastSpan() const { return spanOf(end_); }

    static void ignore(const PairEvent&) {}
    /// Forgets events of the spans before `last` that satisfy `gone`.
    template <class Gone>
    void forget(std::size_t last, Gone&& gone) {
        for (std::size_t span = present_ + 1; span < std::min(last, later_.size()); ++span) {
            later_.drain(span, [&](const PairEvent& event) {
                if (!gone(event)) later_.push(span, event);
            });
        }
        std::erase_if(heap_, gone);
        std::make_heap(heap_.begin(), heap_.end(), isAfter());
    }

    EventOrder order_;
    double end_ = -1;  // s, of the present step

    // The calendar: without one, all time is one span.
    double from_ = 0;  // s
    double to_ = std::numeric_limits<double>::infinity();
    double perSecond_ = 0;     // spans
    std::size_t count_ = 1;    // spans up to to_
    std::size_t present_ = 0;  // the span whose events lie in the heap
    std::vector<Ranked> heap_;
    EventLists later_;         // of each span behind it
    bool collecting_ = false;  // all events lie in list 0, which is free otherwise
};

}  // namespace quadrille
