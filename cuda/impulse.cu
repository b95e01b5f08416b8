#include <cuda/atomic>

#include "cuda/launch.cuh"

// The law `impulse` in parallel with the result of one contact after the other. What a contact does
// depends only on the contacts of its two bodies that come before it in the canonical order. So
// each contact has a turn in either body's order, and is resolved when both turns have come: the
// dependence graph of deterministic reservations (Blelloch, Fineman, Gibbons & Shun 2012), walked
// without rounds.

namespace quadrille::cuda {

namespace {

/// Calls `function(number, contact)` for each contact in the list of a body.
template <class Real, class Function>
__device__ void forEachContact(const ContactList<Real>& list, std::uint32_t body,
                               Function&& function) {
    for (std::uint32_t i = list.heads[body]; i != none;) {
        const PendingContact<Real>& c = list.contacts[i];
        function(i, c);
        i = c.a == body ? list.nextA[i] : list.nextB[i];
    }
}

/// Calls `function(number)` for the contacts of this thread, unless there was no room for all.
template <class Real, class Function>
__device__ void forOwnContacts(const ContactList<Real>& list, Function&& function) {
    const unsigned long long count = list.counts->contacts;
    if (count > list.capacity) return;
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) function(i);
}

/// A contact without axes is one that was dropped.
template <class Real>
__global__ void dropRepeatsKernel(ContactList<Real> list) {
    forOwnContacts(list, [&](std::uint32_t i) {
        PendingContact<Real>& c = list.contacts[i];
        bool repeat = false;
        forEachContact(list, c.a, [&](std::uint32_t j, const PendingContact<Real>& d) {
            repeat |= j < i && d.a == c.a && d.b == c.b;
        });
        if (!repeat) return;
        c.axes = 0;
        countUp(&list.counts->repeats);
    });
}

/// The place of contact c among those of a body, and whether it is the last.
template <class Real>
__device__ std::uint32_t turnOf(const ContactList<Real>& list, const PendingContact<Real>& c,
                                std::uint32_t body) {
    std::uint32_t earlier = 0;
    std::uint32_t last = Turn::last;
    forEachContact(list, body, [&](std::uint32_t, const PendingContact<Real>& d) {
        if (d.axes == 0) return;
        if (before(d, c)) ++earlier;
        if (before(c, d)) last = 0;
    });
    return earlier | last;
}

template <class Real>
__global__ void findTurnsKernel(ContactList<Real> list) {
    forOwnContacts(list, [&](std::uint32_t i) {
        const PendingContact<Real> c = list.contacts[i];
        const bool moving = (c.b & PendingContact<Real>::staticBit) == 0;
        list.turns[i] = {turnOf(list, c, c.a), moving ? turnOf(list, c, c.b) : 0};
    });
}

/// One of the two bodies of a contact, seen from all threads of `Scope`.
template <::cuda::thread_scope Scope>
struct BodyTurn {
    ::cuda::atomic_ref<std::uint32_t, Scope> done;
    std::uint32_t turn;

    __device__ BodyTurn(std::uint32_t& done, std::uint32_t turn) : done(done), turn(turn) {}
    /// What the contacts before did to the body is then there to be read.
    __device__ bool hasCome() const {
        return done.load(::cuda::memory_order_acquire) == (turn & ~Turn::last);
    }
    __device__ void pass() { done.store((turn & ~Turn::last) + 1, ::cuda::memory_order_release); }
};

/// Goes through the thread's contacts again and again until all are resolved. All threads must run
/// at the same time: the earliest contact that is left can always be resolved, by whichever thread
/// has it.
template <class Real, ::cuda::thread_scope Scope>
__global__ void __launch_bounds__(1024)
    resolveImpulseKernel(ImpulseBodies<Real> bodies, ContactList<Real> list,
                         StepParameters<Real> step, TouchedBodies touched) {
    constexpr std::uint32_t staticBit = PendingContact<Real>::staticBit;
    constexpr Turn resolved = {none, none};
    std::uint32_t left = 0;
    forOwnContacts(list, [&](std::uint32_t i) {
        if (list.contacts[i].axes == 0) {
            list.turns[i] = resolved;
        } else {
            ++left;
        }
    });
    unsigned long long collisions = 0;
    while (left > 0) {
        forOwnContacts(list, [&](std::uint32_t i) {
            const Turn turn = list.turns[i];
            if (turn.a == none) return;
            const PendingContact<Real> c = list.contacts[i];
            const bool moving = (c.b & staticBit) == 0;
            BodyTurn<Scope> a(list.done[c.a], turn.a);
            BodyTurn<Scope> b(list.done[moving ? c.b : c.a], turn.b);
            if (!a.hasCome() || (moving && !b.hasCome())) return;
            const bool collided = resolveContact(bodies, c, step);
            list.collided[i] = collided;
            collisions += collided;
            a.pass();
            if ((turn.a & Turn::last) != 0) touched.rows[countUp(&touched.counts->touched)] = c.a;
            if (moving) {
                b.pass();
                if ((turn.b & Turn::last) != 0) {
                    touched.rows[countUp(&touched.counts->touched)] = c.b;
                }
            }
            list.turns[i] = resolved;
            --left;
        });
    }
    addFromBlock(&list.counts->collisions, collisions);
}

template <class Real>
__global__ void clearListsKernel(ContactList<Real> list, TouchedBodies touched) {
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        const std::uint32_t row = touched.rows[i];
        list.heads[row] = none;
        list.done[row] = 0;
    }
}

}  // namespace

template <class Real>
void dropRepeats(const Launch& launch, const ContactList<Real>& contacts, std::uint32_t expected) {
    dropRepeatsKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                        launch.stream>>>(contacts);
    checkLaunch("dropRepeatsKernel");
}

template <class Real>
void findTurns(const Launch& launch, const ContactList<Real>& contacts, std::uint32_t expected) {
    findTurnsKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0, launch.stream>>>(
        contacts);
    checkLaunch("findTurnsKernel");
}

template <class Real>
void resolveImpulse(const Launch& launch, const ImpulseBodies<Real>& bodies,
                    const ContactList<Real>& contacts, const StepParameters<Real>& step,
                    const TouchedBodies& touched, std::uint32_t expected) {
    // Threads of one block see each other's writes much sooner than those of others, which is worth
    // more than their number until a thread has many contacts.
    constexpr std::uint32_t mostForOneBlock = 4096;
    constexpr int blockSize = 1024;
    if (expected <= mostForOneBlock) {
        resolveImpulseKernel<Real, ::cuda::thread_scope_block>
            <<<1, blockSize, 0, launch.stream>>>(bodies, contacts, step, touched);
        checkLaunch("resolveImpulseKernel");
    } else {
        launchTogether(launch, "resolveImpulseKernel",
                       resolveImpulseKernel<Real, ::cuda::thread_scope_device>, expected,
                       launch.options.blockSize, bodies, contacts, step, touched);
    }
}

template <class Real>
void clearLists(const Launch& launch, const ContactList<Real>& contacts,
                const TouchedBodies& touched, std::uint32_t expected) {
    clearListsKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                       launch.stream>>>(contacts, touched);
    checkLaunch("clearListsKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                         \
    template void dropRepeats(const Launch&, const ContactList<Real>&, std::uint32_t);      \
    template void findTurns(const Launch&, const ContactList<Real>&, std::uint32_t);        \
    template void resolveImpulse(const Launch&, const ImpulseBodies<Real>&,                 \
                                 const ContactList<Real>&, const StepParameters<Real>&,     \
                                 const TouchedBodies&, std::uint32_t);                      \
    template void clearLists(const Launch&, const ContactList<Real>&, const TouchedBodies&, \
                             std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
