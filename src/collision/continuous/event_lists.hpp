#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/rules/event_order.hpp"

namespace quadrille {

/// Many lists of events, in no order, that share their memory: together they take what their events
/// take, whichever of them are long.
class EventLists {
  public:
    /// Makes sure that there are so many lists; none goes.
    void reserve(std::size_t lists) {
        if (lists_.size() < lists) lists_.resize(lists);
    }
    std::size_t size() const { return lists_.size(); }
    /// Events of a list.
    std::size_t count(std::size_t list) const { return lists_[list].size; }
    bool empty(std::size_t list) const { return count(list) == 0; }

    void push(std::size_t list, const PairEvent& event) {
        List& to = lists_[list];
        const std::uint32_t used = to.size % chunkSize;
        if (used == 0) to.last = newChunk(to.last);
        events_[to.last * chunkSize + used] = event;
        ++to.size;
    }

    template <class Function>
    void forEach(std::size_t list, Function&& function) const {
        std::uint32_t chunk = lists_[list].last;
        for (std::size_t left = lists_[list].size; left > 0; chunk = previous_[chunk]) {
            const std::size_t used = lastOf(left);
            for (std::size_t i = 0; i < used; ++i) function(events_[chunk * chunkSize + i]);
            left -= used;
        }
    }

    /// Takes all events out and calls `function(event)` for each, which may push.
    template <class Function>
    void drain(std::size_t list, Function&& function) {
        List from = lists_[list];
        lists_[list] = {};
        while (from.size > 0) {
            const std::size_t used = lastOf(from.size);
            PairEvent events[chunkSize];
            std::copy_n(events_.begin() + from.last * chunkSize, used, events);
            const std::uint32_t chunk = from.last;
            from.last = previous_[chunk];
            from.size -= static_cast<std::uint32_t>(used);
            previous_[chunk] = free_;
            free_ = chunk;
            for (std::size_t i = 0; i < used; ++i) function(events[i]);
        }
    }

    std::size_t bytes() const {
        return events_.capacity() * sizeof(PairEvent) + lists_.capacity() * sizeof(List) +
               previous_.capacity() * sizeof(std::uint32_t);
    }

  private:
    static constexpr std::size_t chunkSize = 8;
    static constexpr std::uint32_t none = 0xffff'ffffu;

    struct List {
        std::uint32_t last = none;  // chunk; only this one may have room
        std::uint32_t size = 0;     // events
    };

    static std::size_t lastOf(std::size_t size) { return (size - 1) % chunkSize + 1; }

    std::uint32_t newChunk(std::uint32_t previous) {
        std::uint32_t chunk = free_;
        if (chunk != none) {
            free_ = previous_[chunk];
        } else {
            chunk = static_cast<std::uint32_t>(previous_.size());
            previous_.push_back(none);
            events_.resize(events_.size() + chunkSize);
        }
        previous_[chunk] = previous;
        return chunk;
    }

    std::vector<List> lists_;
    std::vector<PairEvent> events_;        // in chunks
    std::vector<std::uint32_t> previous_;  // chunk of the same list, or free one, for each chunk
    std::uint32_t free_ = none;
};

}  // namespace quadrille
