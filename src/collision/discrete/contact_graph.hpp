#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collision/discrete/contact_log.hpp"
#include "collision/law.hpp"
#include "collision/rules/impulse_contact.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Contacts that one worker found; on cache lines of its own, since others are filled meanwhile.
template <class Real>
struct alignas(64) ContactList {
    std::vector<PendingContact<Real>> contacts;
};

/// Carries out contacts on several threads, with the result of carrying them out one by one in
/// canonical order: a contact runs when it is the first pending one of both its bodies, which is
/// the rule of deterministic reservations (Blelloch, Fineman, Gibbons & Shun, "Internally
/// deterministic parallel algorithms can be fast", 2012).
///
/// There it is applied in rounds. Here every body has the list of its contacts in order, and a
/// contact that has run releases the next one of each of its two bodies; so no thread waits for a
/// round to end, and contacts need no order beyond that within the lists. Static bodies do not
/// change and have no list.
template <class Real>
class ContactGraph {
  public:
    explicit ContactGraph(const ThreadTeam& team) : team_(team), workers_(team.size()) {}

    /// Takes in the contacts of the step. A contact that comes more than once counts once. Throws
    /// Error if there are more than 31 bits can count.
    void link(std::span<const ContactList<Real>> lists, std::size_t movingCount);

    /// Carries them out, and adds to the step's counts how many there were and how many exchanged
    /// an impulse. They go to `log` in no order if the step keeps them.
    void resolve(const Bodies<Real>& bodies, Step<Real>& step, ContactLog<Real>& log);

    std::size_t bytes() const;

  private:
    /// A place in a list: contact times two, plus which of its bodies the list is of.
    using Slot = std::uint32_t;
    static constexpr Slot none = 0xffff'ffffu;

    struct Node {
        PendingContact<Real> contact;
        Slot next[2];                        ///< behind it in the lists of its two bodies
        std::atomic<std::uint32_t> waiting;  ///< for so many of its bodies
    };
    struct Entry {
        PendingContact<Real> contact;
        Slot slot;
    };
    struct alignas(64) Worker {
        std::vector<Entry> list;           ///< being sorted
        std::vector<std::uint32_t> ready;  ///< contacts to be run
        ContactLog<Real> log;
        std::uint64_t contacts, collisions;
    };

    void reserve(std::size_t contacts, std::size_t movingCount);
    void enter(std::uint32_t body, Slot slot);
    Slot sorted(Slot first, const CanonicalOrder& before, std::vector<Entry>& list);
    void release(Slot slot, Worker& worker);
    void run(const Bodies<Real>& bodies, const Step<Real>& step, Worker& worker);

    const ThreadTeam& team_;
    std::vector<Worker> workers_;
    std::unique_ptr<Node[]> nodes_;
    std::unique_ptr<std::atomic<Slot>[]> heads_;  ///< of the bodies' lists; none between two steps
    std::size_t count_ = 0, nodeCapacity_ = 0, headCapacity_ = 0;
    bool clean_ = false;  ///< the heads are as they should be between two steps
};

}  // namespace quadrille
