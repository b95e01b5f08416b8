#include "collision/discrete/threads_impulse.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "collision/discrete/impulse_bodies.hpp"

namespace quadrille {

namespace {

/// The graph costs about three times what it costs one thread to resolve the same contacts, so it
/// takes more threads than that to gain something.
constexpr unsigned graphThreads = 5;

}  // namespace

template <class Real>
ThreadsImpulse<Real>::ThreadsImpulse(const ThreadTeam& team)
    : team_(team), narrowPhase_(team), found_(team.size()), workers_(team.size()), graph_(team) {}

template <class Real>
ResolveCounts ThreadsImpulse<Real>::resolve(const BodyView<Real>& view,
                                            const Partition<Real>& partition,
                                            const StepParameters<Real>& step,
                                            std::vector<ContactRecord>* records) {
    const Bodies<Real> bodies = makeBodies(view);
    if (team_.size() > 1) startMarks(view.moving.size());
    for (auto& list : found_) list.contacts.clear();
    for (Worker& worker : workers_) worker.counts = {};
    ResolveCounts counts;
    counts.pairsTested = narrowPhase_.find(
        view, partition,
        [&](unsigned worker, MovingPair p) {
            found_[worker].contacts.push_back(movingContact(bodies, p.a, p.b, step.dt));
            claim(p.a, worker);
            claim(p.b, worker);
        },
        [&](unsigned worker, StaticPair p) {
            found_[worker].contacts.push_back(staticContact(bodies, p.a, p.fixed, step.dt));
            claim(p.a, worker);
        });

    // Observers want the contacts in their order, one after the other.
    const bool parallel = records == nullptr;
    const bool shared = pending() > found_.front().contacts.size();
    if (parallel && shared && team_.workersFor(pending(), worthwhile::resolved) > 1) {
        team_.run(team_.size(), [&](unsigned worker) { resolveOwn(bodies, step, worker); });
        for (const Worker& worker : workers_) {
            counts.contacts += worker.counts.contacts;
            counts.collisions += worker.counts.collisions;
        }
    }
    const bool several = team_.workersFor(pending(), 4 * worthwhile::resolved) > 1;
    if (parallel && several && (team_.threads() >= graphThreads || team_.eager())) {
        graph_.link(found_, view.moving.size());
        const ResolveCounts rest = graph_.resolve(bodies, step);
        counts.contacts += rest.contacts;
        counts.collisions += rest.collisions;
    } else {
        resolveRest(bodies, step, partition.complete, records, counts);
    }
    return counts;
}

template <class Real>
std::size_t ThreadsImpulse<Real>::pending() const {
    std::size_t sum = 0;
    for (const auto& list : found_) sum += list.contacts.size();
    return sum;
}

/// Makes the marks of the step before meaningless.
template <class Real>
void ThreadsImpulse<Real>::startMarks(std::size_t movingCount) {
    const Mark step = static_cast<Mark>(workers_.size()) + 1;
    const bool grown = movingCount > markCount_;
    if (grown) {
        markCount_ = std::max(movingCount, markCount_ + markCount_ / 2);
        marks_ = std::make_unique_for_overwrite<std::atomic<Mark>[]>(markCount_);
    }
    if (grown || held_ > std::numeric_limits<Mark>::max() - 2 * step) {
        team_.shares(markCount_, worthwhile::streamed,
                     [&](std::size_t begin, std::size_t end, unsigned) {
                         for (std::size_t i = begin; i < end; ++i) {
                             marks_[i].store(0, std::memory_order_relaxed);
                         }
                     });
        held_ = 1;
    } else {
        held_ += step;
    }
}

/// Says that the worker has a contact with the body; a second one makes that contacts wait.
template <class Real>
void ThreadsImpulse<Real>::claim(std::uint32_t body, unsigned worker) {
    if (team_.size() == 1) return;
    Mark mark = marks_[body].load(std::memory_order_relaxed);
    while (mark != markOf(worker) && mark != held_) {
        const Mark next = mark < held_ ? markOf(worker) : held_;
        if (marks_[body].compare_exchange_weak(mark, next, std::memory_order_relaxed)) return;
    }
}

template <class Real>
bool ThreadsImpulse<Real>::free(const PendingContact<Real>& c, unsigned worker) const {
    const Mark own = markOf(worker);
    return marks_[c.a].load(std::memory_order_relaxed) == own &&
           (isStatic(c) || marks_[c.b].load(std::memory_order_relaxed) == own);
}

/// Makes later contacts of both bodies wait.
template <class Real>
void ThreadsImpulse<Real>::hold(const PendingContact<Real>& c) {
    marks_[c.a].store(held_, std::memory_order_relaxed);
    if (!isStatic(c)) marks_[c.b].store(held_, std::memory_order_relaxed);
}

template <class Real>
void ThreadsImpulse<Real>::resolveOwn(const Bodies<Real>& bodies, const StepParameters<Real>& step,
                                      unsigned worker) {
    Worker& own = workers_[worker];
    Contacts& contacts = found_[worker].contacts;
    own.sort(contacts, step.dt);
    std::size_t waiting = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const PendingContact<Real> c = contacts[i];
        if (!free(c, worker)) {
            hold(c);
            contacts[waiting++] = c;
        } else if (i + 1 == contacts.size() || !samePair(c, contacts[i + 1])) {
            own.counts.collisions += resolveContact(bodies, c, step);
            ++own.counts.contacts;
        }
    }
    contacts.resize(waiting);
}

template <class Real>
void ThreadsImpulse<Real>::resolveRest(const Bodies<Real>& bodies, const StepParameters<Real>& step,
                                       bool complete, std::vector<ContactRecord>* records,
                                       ResolveCounts& counts) {
    std::swap(rest_, found_.front().contacts);
    for (std::size_t w = 1; w < found_.size(); ++w) {
        rest_.insert(rest_.end(), found_[w].contacts.begin(), found_[w].contacts.end());
    }
    sortRest_(rest_, step.dt);
    if (!complete) {
        rest_.erase(std::unique(rest_.begin(), rest_.end(), samePair<Real>), rest_.end());
    }
    for (const PendingContact<Real>& c : rest_) {
        const bool collided = resolveContact(bodies, c, step);
        counts.collisions += collided;
        if (records != nullptr) records->push_back(makeRecord(c, step.start, collided));
    }
    counts.contacts += rest_.size();
}

template <class Real>
std::size_t ThreadsImpulse<Real>::bytes() const {
    std::size_t sum = narrowPhase_.bytes() + graph_.bytes() + sortRest_.bytes() +
                      markCount_ * sizeof(Mark) + rest_.capacity() * sizeof(PendingContact<Real>) +
                      found_.capacity() * sizeof(ContactList<Real>) +
                      workers_.capacity() * sizeof(Worker);
    for (const auto& list : found_) {
        sum += list.contacts.capacity() * sizeof(PendingContact<Real>);
    }
    for (const Worker& worker : workers_) sum += worker.sort.bytes();
    return sum;
}

template class ThreadsImpulse<double>;
template class ThreadsImpulse<float>;

}  // namespace quadrille
