#include "collision/discrete/threads_impulse.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace quadrille {

template <class Real>
ThreadsImpulse<Real>::ThreadsImpulse(const ThreadTeam& team)
    : DiscreteLaw<Real>(team),
      team_(team),
      narrowPhase_(team),
      found_(team.size()),
      workers_(team.size()),
      graph_(team) {}

template <class Real>
void ThreadsImpulse<Real>::resolve(const LawBodies<Real>& view, const Partition<Real>& partition,
                                   Step<Real>& step) {
    const Bodies<Real> bodies = view.plain();
    const Real dt = step.parameters.dt;
    barrier_.update(view);
    startMarks(view.moving.size());
    for (auto& list : found_) list.contacts.clear();
    for (Worker& worker : workers_) {
        worker.counts = {};
        worker.touched.clear();
    }
    step.counts.pairsTested += narrowPhase_.find(
        view.read(), partition,
        [&](unsigned worker, MovingPair p) {
            found_[worker].contacts.push_back(movingContact(bodies, p.a, p.b, dt));
            touch(bodies, p.a, dt, worker);
            touch(bodies, p.b, dt, worker);
        },
        [&](unsigned worker, StaticPair p) {
            found_[worker].contacts.push_back(staticContact(bodies, p.a, p.fixed, dt));
            touch(bodies, p.a, dt, worker);
        });

    const bool shared = pending() > found_.front().contacts.size();
    if (shared && team_.workersFor(pending(), &Thresholds::resolved) > 1) {
        team_.run(team_.size(), [&](unsigned worker) { resolveOwn(bodies, step, worker); });
        for (Worker& worker : workers_) {
            step.counts.contacts += worker.counts.contacts;
            step.counts.collisions += worker.counts.collisions;
            log_.take(worker.log);
        }
    }
    const bool several = team_.workersFor(pending(), &Thresholds::linked) > 1;
    if (several && team_.threads() >= team_.thresholds().graphThreads) {
        graph_.link(found_, view.moving.size());
        graph_.resolve(bodies, step, log_);
    } else {
        resolveRest(bodies, step, partition.complete);
    }
    makeRecords(bodies, step.from);
    keepOut(bodies);
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
        team_.shares(markCount_, &Thresholds::streamed,
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

/// Says that the worker has a contact with the body; a second one makes that contacts wait. Returns
/// whether it is the first contact of the body in this step.
template <class Real>
bool ThreadsImpulse<Real>::claim(std::uint32_t body, unsigned worker) {
    Mark mark = marks_[body].load(std::memory_order_relaxed);
    while (mark != markOf(worker) && mark != held_) {
        const Mark next = mark < held_ ? markOf(worker) : held_;
        const bool first = mark < held_;
        if (marks_[body].compare_exchange_weak(mark, next, std::memory_order_relaxed)) return first;
    }
    return false;
}

/// Claims the body, and notes where it stood when the step began.
template <class Real>
void ThreadsImpulse<Real>::touch(const Bodies<Real>& bodies, std::uint32_t row, Real dt,
                                 unsigned worker) {
    if (!claim(row, worker) || !barrier_.any()) return;
    workers_[worker].touched.push_back({row, placeBefore<Real>(bodies.moving, row, dt)});
}

template <class Real>
void ThreadsImpulse<Real>::keepOut(const Bodies<Real>& bodies) {
    std::size_t touched = 0;
    for (const Worker& worker : workers_) touched += worker.touched.size();
    const auto keepOutOwn = [&](unsigned worker) {
        for (const Touched& t : workers_[worker].touched) {
            barrier_.keepOut(bodies, t.row, t.start);
        }
    };
    if (team_.workersFor(touched, &Thresholds::scattered) > 1) {
        team_.run(team_.size(), keepOutOwn);
    } else {
        for (unsigned w = 0; w < workers_.size(); ++w) keepOutOwn(w);
    }
}

template <class Real>
bool ThreadsImpulse<Real>::free(const PendingContact<Real>& c, unsigned worker) const {
    const Mark own = markOf(worker);
    return marks_[c.a].load(std::memory_order_relaxed) == own &&
           (c.b.isStatic() || marks_[c.b.row()].load(std::memory_order_relaxed) == own);
}

/// Makes later contacts of both bodies wait.
template <class Real>
void ThreadsImpulse<Real>::hold(const PendingContact<Real>& c) {
    marks_[c.a].store(held_, std::memory_order_relaxed);
    if (!c.b.isStatic()) marks_[c.b.row()].store(held_, std::memory_order_relaxed);
}

template <class Real>
void ThreadsImpulse<Real>::resolveOwn(const Bodies<Real>& bodies, const Step<Real>& step,
                                      unsigned worker) {
    Worker& own = workers_[worker];
    Contacts& contacts = found_[worker].contacts;
    own.sort(contacts, canonicalOrder(bodies), step.parameters.dt);
    std::size_t waiting = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const PendingContact<Real> c = contacts[i];
        if (!free(c, worker)) {
            hold(c);
            contacts[waiting++] = c;
        } else if (i + 1 == contacts.size() || !samePair(c, contacts[i + 1])) {
            const auto outcome = resolveContact(bodies, c, step.parameters);
            own.counts.collisions += outcome.collided();
            ++own.counts.contacts;
            if (step.keepContacts) own.log.add(c, outcome);
        }
    }
    contacts.resize(waiting);
}

template <class Real>
void ThreadsImpulse<Real>::resolveRest(const Bodies<Real>& bodies, Step<Real>& step,
                                       bool complete) {
    std::swap(rest_, found_.front().contacts);
    for (std::size_t w = 1; w < found_.size(); ++w) {
        rest_.insert(rest_.end(), found_[w].contacts.begin(), found_[w].contacts.end());
    }
    sortRest_(rest_, canonicalOrder(bodies), step.parameters.dt);
    if (!complete) {
        rest_.erase(std::unique(rest_.begin(), rest_.end(), samePair<Real>), rest_.end());
    }
    for (const PendingContact<Real>& c : rest_) {
        const auto outcome = resolveContact(bodies, c, step.parameters);
        step.counts.collisions += outcome.collided();
        if (step.keepContacts) log_.add(c, outcome);
    }
    step.counts.contacts += rest_.size();
}

/// Whoever looks at the contacts wants them in their order, which has nothing to do with who
/// resolved them when.
template <class Real>
void ThreadsImpulse<Real>::makeRecords(const Bodies<Real>& bodies, double stepStart) {
    records_.clear();
    log_.sort(canonicalOrder(bodies));
    log_.appendTo(records_, stepStart);
    log_.clear();
}

template <class Real>
std::size_t ThreadsImpulse<Real>::bytes() const {
    std::size_t sum = barrier_.bytes() + narrowPhase_.bytes() + graph_.bytes() + sortRest_.bytes() +
                      log_.bytes() + records_.capacity() * sizeof(ContactRecord) +
                      markCount_ * sizeof(Mark) + rest_.capacity() * sizeof(PendingContact<Real>) +
                      found_.capacity() * sizeof(ContactList<Real>) +
                      workers_.capacity() * sizeof(Worker);
    for (const auto& list : found_) {
        sum += list.contacts.capacity() * sizeof(PendingContact<Real>);
    }
    for (const Worker& worker : workers_) {
        sum +=
            worker.sort.bytes() + worker.log.bytes() + worker.touched.capacity() * sizeof(Touched);
    }
    return sum;
}

template class ThreadsImpulse<double>;
template class ThreadsImpulse<float>;

}  // namespace quadrille
