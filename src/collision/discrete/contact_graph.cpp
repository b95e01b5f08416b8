#include "collision/discrete/contact_graph.hpp"

#include <algorithm>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

/// Contacts that a thread takes at once: enough to keep the threads apart in memory, few enough to
/// spread what is found in one corner of the world.
constexpr std::size_t contactBlock = 64;

}  // namespace

template <class Real>
void ContactGraph<Real>::reserve(std::size_t contacts, std::size_t movingCount) {
    if (contacts >= none / 2) {
        throw Error("threads: " + std::to_string(contacts) + " contacts do not fit 31 bits");
    }
    if (contacts > nodeCapacity_) {
        nodeCapacity_ = std::max(contacts, nodeCapacity_ + nodeCapacity_ / 2);
        nodes_ = std::make_unique_for_overwrite<Node[]>(nodeCapacity_);
    }
    if (movingCount > headCapacity_) {
        headCapacity_ = movingCount;
        heads_ = std::make_unique_for_overwrite<std::atomic<Slot>[]>(headCapacity_);
        clean_ = false;
    }
    if (!clean_) {
        team_.shares(headCapacity_, &Thresholds::streamed,
                     [&](std::size_t begin, std::size_t end, unsigned) {
                         for (std::size_t i = begin; i < end; ++i) {
                             heads_[i].store(none, std::memory_order_relaxed);
                         }
                     });
    }
}

template <class Real>
void ContactGraph<Real>::link(std::span<const ContactList<Real>> lists, std::size_t movingCount) {
    count_ = 0;
    for (const auto& list : lists) count_ += list.contacts.size();
    reserve(count_, movingCount);
    clean_ = false;
    team_.shares(count_, &Thresholds::linked, [&](std::size_t begin, std::size_t end, unsigned) {
        std::size_t start = 0;
        for (const auto& [list] : lists) {
            const std::size_t from = std::clamp(begin, start, start + list.size());
            const std::size_t to = std::clamp(end, start, start + list.size());
            for (std::size_t i = from; i < to; ++i) {
                const PendingContact<Real>& c = list[i - start];
                const bool two = !c.b.isStatic();
                nodes_[i].contact = c;
                nodes_[i].waiting.store(two ? 2 : 1, std::memory_order_relaxed);
                nodes_[i].next[1] = none;
                enter(c.a, static_cast<Slot>(2 * i));
                if (two) enter(c.b.row(), static_cast<Slot>(2 * i + 1));
            }
            start += list.size();
        }
    });
}

/// The lists are not in order yet, and begin with whatever came last.
template <class Real>
void ContactGraph<Real>::enter(std::uint32_t body, Slot slot) {
    nodes_[slot / 2].next[slot % 2] = heads_[body].exchange(slot, std::memory_order_relaxed);
}

/// Puts a list in canonical order and takes out duplicates. Returns its first slot.
template <class Real>
auto ContactGraph<Real>::sorted(Slot first, const CanonicalOrder& before, std::vector<Entry>& list)
    -> Slot {
    if (nodes_[first / 2].next[first % 2] == none) return first;
    list.clear();
    for (Slot slot = first; slot != none; slot = nodes_[slot / 2].next[slot % 2]) {
        list.push_back({nodes_[slot / 2].contact, slot});
    }
    // Duplicates in the order of their slots, so that both bodies keep the same one.
    std::sort(list.begin(), list.end(), [&](const Entry& p, const Entry& q) {
        return before(p.contact, q.contact) || (!before(q.contact, p.contact) && p.slot < q.slot);
    });
    list.erase(
        std::unique(list.begin(), list.end(),
                    [](const Entry& p, const Entry& q) { return samePair(p.contact, q.contact); }),
        list.end());
    Slot behind = none;
    for (std::size_t i = list.size(); i-- > 0;) {
        const Slot slot = list[i].slot;
        nodes_[slot / 2].next[slot % 2] = behind;
        behind = slot;
    }
    return behind;
}

/// The contact has become the first pending one of one of its bodies. Whoever says so last runs it,
/// and sees what all contacts before it have written.
template <class Real>
void ContactGraph<Real>::release(Slot slot, Worker& worker) {
    if (nodes_[slot / 2].waiting.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        worker.ready.push_back(slot / 2);
    }
}

template <class Real>
void ContactGraph<Real>::run(const Bodies<Real>& bodies, const Step<Real>& step, Worker& worker) {
    while (!worker.ready.empty()) {
        Node& node = nodes_[worker.ready.back()];
        worker.ready.pop_back();
        ++worker.contacts;
        const auto outcome = resolveContact(bodies, node.contact, step.parameters);
        worker.collisions += outcome.collided();
        if (step.keepContacts) worker.log.add(node.contact, outcome);
        for (const Slot next : node.next) {
            if (next != none) release(next, worker);
        }
    }
}

template <class Real>
void ContactGraph<Real>::resolve(const Bodies<Real>& bodies, Step<Real>& step,
                                 ContactLog<Real>& log) {
    const CanonicalOrder order = canonicalOrder(bodies);
    for (Worker& worker : workers_) {
        worker.ready.clear();
        worker.contacts = worker.collisions = 0;
    }
    const auto runListFrom = [&](std::uint32_t body, Slot slot, Worker& worker) {
        // The contact that stands first in a list sees to the list.
        if (heads_[body].load(std::memory_order_relaxed) != slot) return;
        heads_[body].store(none, std::memory_order_relaxed);
        release(sorted(slot, order, worker.list), worker);
        run(bodies, step, worker);
    };
    team_.blocks(team_.workersFor(count_, &Thresholds::resolved), count_, contactBlock,
                 [&](std::size_t begin, std::size_t end, unsigned w) {
                     for (std::size_t i = begin; i < end; ++i) {
                         const PendingContact<Real>& c = nodes_[i].contact;
                         const auto slot = static_cast<Slot>(2 * i);
                         runListFrom(c.a, slot, workers_[w]);
                         if (c.b.isStatic()) continue;
                         runListFrom(c.b.row(), slot + 1, workers_[w]);
                     }
                 });
    clean_ = true;
    for (Worker& worker : workers_) {
        step.counts.contacts += worker.contacts;
        step.counts.collisions += worker.collisions;
        log.take(worker.log);
    }
}

template <class Real>
std::size_t ContactGraph<Real>::bytes() const {
    std::size_t sum = nodeCapacity_ * sizeof(Node) + headCapacity_ * sizeof(Slot) +
                      workers_.capacity() * sizeof(Worker);
    for (const Worker& worker : workers_) {
        sum += worker.log.bytes() + worker.list.capacity() * sizeof(Entry) +
               worker.ready.capacity() * sizeof(std::uint32_t);
    }
    return sum;
}

template class ContactGraph<double>;
template class ContactGraph<float>;

}  // namespace quadrille
