#include "parallel/thread_team.hpp"

#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace quadrille {

namespace {

/// Keeps the first exception of several threads.
class Failure {
  public:
    template <class Function>
    void guard(Function&& function) noexcept {
        try {
            function();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!first_) first_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (first_) std::rethrow_exception(first_);
    }

  private:
    std::mutex mutex_;
    std::exception_ptr first_;
};

/// How often a thread that waits looks again before it sleeps. Waking it takes as long as a short
/// loop, so where each thread has a core it stays awake for about 0.5 ms: longer than a device
/// needs for its part of a step. Where threads share cores, for about 50 us, longer than the pauses
/// between the loops of a step.
constexpr int patienceWithACore = 1500;
constexpr int patienceWithout = 150;

/// Leaves the core to a thread that needs it, and else, for a moment, to its other hardware thread.
void pause() {
    std::this_thread::yield();
#if defined(__x86_64__) && defined(__GNUC__)
    for (int i = 0; i < 4; ++i) __builtin_ia32_pause();
#endif
}

/// Waits until `done()`; `word` changes when it may have become true.
template <class Word, class Done>
void waitUntil(const std::atomic<Word>& word, int patience, Done&& done) {
    for (int i = 0; i < patience; ++i) {
        if (done()) return;
        pause();
    }
    for (;;) {
        const Word seen = word.load(std::memory_order_acquire);
        if (done()) return;
        word.wait(seen, std::memory_order_acquire);
    }
}

}  // namespace

/// What the caller, who is thread 0, shares with the other threads.
///
/// A thread takes its own workers of a loop first, so that it finds in its cache what it left
/// there, and then any that nobody has begun. The caller does the same, and waits for those only
/// that others have begun: a thread that does not get a core holds nobody up.
struct ThreadTeam::Shared {
    /// How many of a thread's workers have been begun, by whomever.
    struct alignas(64) Begun {
        std::atomic<std::uint32_t> count{workersPerThread};
    };

    explicit Shared(unsigned size)
        : begun(size), patience(size <= cores() ? patienceWithACore : patienceWithout) {
        try {
            for (unsigned i = 1; i < size; ++i) threads.emplace_back([this, i] { serve(i); });
        } catch (const std::system_error& error) {
            const std::size_t started = 1 + threads.size();
            finish();
            throw std::system_error(error.code(), std::to_string(size) +
                                                      " threads cannot be started, only " +
                                                      std::to_string(started));
        } catch (...) {
            finish();
            throw;
        }
    }
    ~Shared() { finish(); }

    void finish() {
        stop.store(true, std::memory_order_relaxed);
        round.fetch_add(1, std::memory_order_release);
        round.notify_all();
        for (std::thread& thread : threads) thread.join();
        threads.clear();
    }

    void serve(unsigned thread) {
        std::uint32_t seen = 0;
        while (!stop.load(std::memory_order_relaxed)) {
            waitUntil(round, patience,
                      [&] { return round.load(std::memory_order_acquire) != seen; });
            seen = round.load(std::memory_order_acquire);
            takeWorkers(thread);
        }
    }

    void takeWorkers(unsigned thread) {
        const auto threadCount = static_cast<unsigned>(begun.size());
        for (unsigned i = 0; i < threadCount; ++i) {
            const unsigned owner = (thread + i) % threadCount;
            auto& count = begun[owner].count;
            // Reading first leaves the line where it is. A worker that nobody has begun belongs to
            // the loop that `call` and `context` describe, even if this thread woke up for an
            // earlier one.
            while (count.load(std::memory_order_relaxed) < workersPerThread) {
                const unsigned next = count.fetch_add(1, std::memory_order_acq_rel);
                if (next >= workersPerThread) break;
                failure->guard([&] { call(context, owner * workersPerThread + next); });
                if (pending.fetch_sub(1, std::memory_order_acq_rel) == 1) pending.notify_one();
            }
        }
    }

    void run(void (*function)(const void*, unsigned), const void* argument) {
        Failure first;
        call = function;
        context = argument;
        failure = &first;
        pending.store(static_cast<std::uint32_t>(begun.size()) * workersPerThread,
                      std::memory_order_relaxed);
        for (Begun& thread : begun) thread.count.store(0, std::memory_order_release);
        round.fetch_add(1, std::memory_order_release);
        round.notify_all();
        takeWorkers(0);
        waitUntil(pending, patience, [&] { return pending.load(std::memory_order_acquire) == 0; });
        first.rethrow();
    }

    std::vector<Begun> begun;  // one a thread
    const int patience;
    void (*call)(const void*, unsigned) = nullptr;
    const void* context = nullptr;
    Failure* failure = nullptr;
    alignas(64) std::atomic<std::uint32_t> round{0};    ///< counts the loops
    alignas(64) std::atomic<std::uint32_t> pending{0};  ///< workers that are not done
    std::atomic<bool> stop{false};
    std::vector<std::thread> threads;
};

ThreadTeam::ThreadTeam(unsigned threads, const Thresholds& thresholds)
    : threads_(std::max(1u, threads)), thresholds_(thresholds) {
    if (threads_ > 1) shared_ = std::make_unique<Shared>(threads_);
}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::fork(void (*call)(const void*, unsigned), const void* context) const {
    shared_->run(call, context);
}

const ThreadTeam& ThreadTeam::serial() {
    static const ThreadTeam team;
    return team;
}

unsigned ThreadTeam::cores() { return std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace quadrille
