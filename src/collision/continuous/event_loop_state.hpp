#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <quadrille/body_ref.hpp>

#include "collision/continuous/bursts.hpp"
#include "collision/continuous/event_queue.hpp"

namespace quadrille {

/// Bodies that are pushed together.
struct PushedGroup {
    std::vector<std::uint32_t> rows;
    double mass = 0;    ///< kg
    bool held = false;  ///< by something that does not move; then `rows` may not be all

    std::size_t bytes() const { return rows.capacity() * sizeof(std::uint32_t); }
};

/// What a loop of events keeps from step to step.
struct EventLoopState {
    EventQueue queue;
    std::vector<std::uint32_t> changed;  ///< bodies whose events are to be found again
    bool mayRest = false;                ///< whether anything may rest; false only if nothing does

    /// Overlapping pairs that collided at the present instant.
    double instant = -1;  ///< s
    std::vector<std::pair<std::uint32_t, BodyRef>> separated;

    Bursts bursts;

    PushedGroup groupA, groupB;
    std::vector<std::uint32_t> groupChanged;
    /// By which gathering each body was gathered last. Loops that share out a step have one list:
    /// each looks at its own bodies.
    std::shared_ptr<std::vector<std::uint64_t>> gathered =
        std::make_shared<std::vector<std::uint64_t>>();
    std::uint64_t gathering = 0;

    std::vector<BodyRef> supports;

    /// Without what several loops have together.
    std::size_t bytes() const {
        return queue.bytes() + bursts.bytes() + groupA.bytes() + groupB.bytes() +
               (changed.capacity() + 2 * separated.capacity() + groupChanged.capacity() +
                supports.capacity()) *
                   sizeof(std::uint32_t);
    }
};

}  // namespace quadrille
