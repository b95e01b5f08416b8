#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <quadrille/quadrille.hpp>

namespace quadrille::app {

/// The past of a run, to be looked at again while the run itself stays where it is.
///
/// States are kept now and then, in bounded memory, and a second simulation makes the steps after
/// one of them once more, with the same bits. Steps that depend on more than the state (the law
/// `baseline`, trees that miss pairs) cannot be made again: their states are all kept, and the
/// oldest go where memory ends.
class Timeline {
  public:
    using Clock = std::chrono::steady_clock;

    /// Bytes that kept states may take.
    explicit Timeline(std::size_t memory) : memory_(memory) {}

    /// A run begins. `run` must live until the next one begins.
    void begin(const Simulation& run);
    /// The run has made a step.
    void record();
    /// What a step of the run is made with has changed.
    void change();

    /// The steps that can be shown: after so many of them.
    std::uint64_t first() const { return kept_.empty() ? 0 : kept_.begin()->first; }
    std::uint64_t last() const { return run_->stepsDone(); }

    /// Makes the second simulation go to a step, from first() to last(), until then at the latest;
    /// whether it is there.
    bool goTo(std::uint64_t step, Clock::time_point until);
    /// The run as it was at a step; the one that goTo() has come to.
    const Simulation& past() const { return *past_; }

    /// A run with the law `continuous` as it was between the step that goTo() has come to and the
    /// next, the part `share` of a step after it. Its clock does not say so.
    const Simulation& between(double share);

    /// The hash that the run had at a step, from its first to its last.
    std::uint64_t hashAt(std::uint64_t step) const { return hashes_[step - firstHash_]; }

    /// What the kept states take.
    std::size_t bytes() const;

  private:
    using States = std::map<std::uint64_t, Snapshot>;

    /// Steps that are made with the same law and partitioner.
    struct Part {
        std::uint64_t from;
        SimulationConfig config;
        bool repeats() const;
    };

    std::size_t partOf(std::uint64_t step) const;
    void keep();
    void makeRoom();
    void restore(const Snapshot& state, std::size_t part);
    void keepNearby();
    const Snapshot* lastUpTo(std::uint64_t step) const;

    std::size_t memory_;
    const Simulation* run_ = nullptr;
    std::size_t stateBytes_ = 1;
    std::uint64_t stride_ = 1;           // steps from one kept state to the next
    States kept_;                        // of the run, from its first step on
    std::vector<Part> parts_;            // states at the start of each stay as long as others
    std::vector<std::uint64_t> hashes_;  // of all steps, from firstHash_ on
    std::uint64_t firstHash_ = 0;

    std::optional<Simulation> past_, between_;
    std::size_t pastPart_ = 0;  // of whose configuration past_ is
    States nearby_;  // of the past, between two kept ones, so that going back a step is cheap
};

}  // namespace quadrille::app
