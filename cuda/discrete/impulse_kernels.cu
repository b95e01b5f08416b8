#include <cuda/atomic>

#include "cuda/bodies/publish.cuh"
#include "cuda/discrete/impulse_kernels.hpp"

// The law `impulse` in parallel with the result of one contact after the other. What a contact does
// depends only on the contacts of its two bodies that come before it in the canonical order, so it
// waits for at most two others: the one before it in either body's order. This is the dependence
// graph of deterministic reservations (Blelloch, Fineman, Gibbons & Shun 2012), walked without a
// sort and without rounds.

namespace quadrille::cuda {

namespace {

/// Calls `function(number, contact)` for each contact in the list of a body.
template <class Real, class Function>
__device__ void forEachContact(const DeviceContacts<Real>& list, std::uint32_t body,
                               Function&& function) {
    for (std::uint32_t i = list.heads[body]; i != none;) {
        const PendingContact<Real>& c = list.contacts[i];
        function(i, c);
        i = c.a == body ? list.nextA[i] : list.nextB[i];
    }
}

/// Calls `function(number)` for the contacts of this thread, unless there was no room for all.
template <class Real, class Function>
__device__ void forOwnContacts(const DeviceContacts<Real>& list, Function&& function) {
    const unsigned long long count = list.counts->contacts;
    if (count > list.capacity) return;
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) function(i);
}

/// Finds what follows contact c among those of a body. Returns 1 if another one comes before it.
template <class Real>
__device__ std::uint32_t placeAmong(const DeviceContacts<Real>& list, const CanonicalOrder& before,
                                    const PendingContact<Real>& c, std::uint32_t body,
                                    std::uint32_t& successor) {
    std::uint32_t waits = 0;
    PendingContact<Real> nearest;
    successor = none;
    forEachContact(list, body, [&](std::uint32_t i, const PendingContact<Real>& other) {
        const PendingContact<Real> d = other;
        if (before(d, c)) {
            waits = 1;
        } else if (before(c, d) && (successor == none || before(d, nearest))) {
            successor = i;
            nearest = d;
        }
    });
    return waits;
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    findSuccessorsKernel(DeviceContacts<Real> list, CanonicalOrder order) {
    forOwnContacts(list, [&](std::uint32_t i) {
        const PendingContact<Real> c = list.contacts[i];
        Successors successors{none, none};
        std::uint32_t waiting = placeAmong(list, order, c, c.a, successors.a);
        if (!c.b.isStatic()) {
            waiting += placeAmong(list, order, c, c.b.row(), successors.b);
        }
        list.successors[i] = successors;
        list.waiting[i] = waiting;
    });
}

/// Threads of one block see each other's writes much sooner than those of others, which is worth
/// more than their number until a thread has many contacts.
constexpr std::uint32_t mostForOneBlock = 4096;

/// Goes through the thread's contacts again and again until all are resolved. All threads must run
/// at the same time: the earliest contact that is left can always be resolved, by whichever thread
/// has it. What contacts exchange takes registers, so it is left out unless the step `Keeps` it.
template <class Real, ::cuda::thread_scope Scope, bool Keeps>
__global__ void __launch_bounds__(largestBlock)
    resolveImpulseKernel(Bodies<Real> bodies, DeviceContacts<Real> list, StepParameters<Real> step,
                         TouchedBodies touched) {
    using Waiting = ::cuda::atomic_ref<std::uint32_t, Scope>;
    constexpr std::uint32_t resolved = none;

    std::uint32_t* waiting = list.waiting;
    if constexpr (Scope == ::cuda::thread_scope_block) {
        __shared__ std::uint32_t nearby[mostForOneBlock];
        if (list.counts->contacts <= mostForOneBlock) waiting = nearby;
    }
    std::uint32_t left = 0;
    forOwnContacts(list, [&](std::uint32_t i) {
        ++left;
        if (waiting != list.waiting) waiting[i] = list.waiting[i];
    });
    if constexpr (Scope == ::cuda::thread_scope_block) __syncthreads();

    const auto pass = [&](std::uint32_t successor, std::uint32_t body) {
        if (successor != none) {
            Waiting(waiting[successor]).fetch_sub(1, ::cuda::memory_order_release);
        } else {
            touched.rows[countUp(&touched.counts->touched)] = body;
        }
    };
    unsigned long long collisions = 0;
    while (left > 0) {
        forOwnContacts(list, [&](std::uint32_t i) {
            // What the contacts before did to the bodies is then there to be read.
            if (Waiting(waiting[i]).load(::cuda::memory_order_acquire) != 0) return;
            const PendingContact<Real> c = list.contacts[i];
            const Successors successors = list.successors[i];
            const ContactOutcome<Real> outcome = resolveContact(bodies, c, step);
            if constexpr (Keeps) list.outcomes[i] = outcome;
            collisions += outcome.collided();
            pass(successors.a, c.a);
            if (!c.b.isStatic()) pass(successors.b, c.b.row());
            Waiting(waiting[i]).store(resolved, ::cuda::memory_order_relaxed);
            --left;
        });
    }
    addFromBlock(&list.counts->collisions, collisions);
}

/// A body without contacts, as between steps.
struct ClearList {
    std::uint32_t* heads;

    __device__ void operator()(std::uint32_t row) const { heads[row] = none; }
};

}  // namespace

template <class Real>
void findSuccessors(const Launch& launch, const DeviceContacts<Real>& contacts,
                    const CanonicalOrder& order, std::uint32_t expected) {
    findSuccessorsKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                           launch.stream>>>(contacts, order);
    checkLaunch("findSuccessorsKernel");
}

template <class Real, bool Keeps>
void launchKeeping(const Launch& launch, const Bodies<Real>& bodies,
                   const DeviceContacts<Real>& contacts, const StepParameters<Real>& step,
                   const TouchedBodies& touched, std::uint32_t expected) {
    if (expected <= mostForOneBlock) {
        resolveImpulseKernel<Real, ::cuda::thread_scope_block, Keeps>
            <<<1, largestBlock, 0, launch.stream>>>(bodies, contacts, step, touched);
        checkLaunch("resolveImpulseKernel");
    } else {
        launchTogether(launch, "resolveImpulseKernel",
                       resolveImpulseKernel<Real, ::cuda::thread_scope_device, Keeps>, expected,
                       launch.options.blockSize, bodies, contacts, step, touched);
    }
}

template <class Real>
void launchImpulse(const Launch& launch, const Bodies<Real>& bodies,
                   const DeviceContacts<Real>& contacts, const StepParameters<Real>& step,
                   const TouchedBodies& touched, std::uint32_t expected) {
    if (contacts.outcomes != nullptr) {
        launchKeeping<Real, true>(launch, bodies, contacts, step, touched, expected);
    } else {
        launchKeeping<Real, false>(launch, bodies, contacts, step, touched, expected);
    }
}

template <class Real>
void publishImpulse(const Launch& launch, const Bodies<Real>& bodies,
                    const DeviceContacts<Real>& contacts, const TouchedBodies& touched,
                    const HostResult<Real>& result, std::uint32_t expected) {
    publish(launch, bodies, touched, result, expected, ClearList{contacts.heads});
}

#define QUADRILLE_INSTANTIATE(Real)                                                                \
    template void findSuccessors(const Launch&, const DeviceContacts<Real>&,                       \
                                 const CanonicalOrder&, std::uint32_t);                            \
    template void launchImpulse(const Launch&, const Bodies<Real>&, const DeviceContacts<Real>&,   \
                                const StepParameters<Real>&, const TouchedBodies&, std::uint32_t); \
    template void publishImpulse(const Launch&, const Bodies<Real>&, const DeviceContacts<Real>&,  \
                                 const TouchedBodies&, const HostResult<Real>&, std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
