#include "parallel/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <quadrille/random.hpp>

namespace quadrille {
namespace {

constexpr std::size_t always = 0;  // items from which on a loop is shared out

class Team : public testing::TestWithParam<unsigned> {
  protected:
    ThreadTeam team{GetParam(), Thresholds::none()};
};

INSTANTIATE_TEST_SUITE_P(Threads, Team, testing::Values(1u, 2u, 3u, 7u, 16u));

TEST_P(Team, RunsEveryWorkerOnceInEveryLoop) {
    std::vector<int> calls(team.size());
    for (int loop = 1; loop <= 2000; ++loop) {
        team.run(team.size(), [&](unsigned worker) { ++calls[worker]; });
        ASSERT_EQ(std::count(calls.begin(), calls.end(), loop), std::ptrdiff_t(team.size()));
    }
}

TEST_P(Team, SharesAndBlocksCoverEverythingOnce) {
    for (const std::size_t count : {0, 1, 5, 16, 17, 1000}) {
        std::vector<int> shared(count), taken(count);
        team.shares(count, always, [&](std::size_t begin, std::size_t end, unsigned worker) {
            EXPECT_LT(worker, team.size());
            for (std::size_t i = begin; i < end; ++i) ++shared[i];
        });
        team.blocks(team.size(), count, 3, [&](std::size_t begin, std::size_t end, unsigned) {
            for (std::size_t i = begin; i < end; ++i) ++taken[i];
        });
        EXPECT_EQ(std::count(shared.begin(), shared.end(), 1), std::ptrdiff_t(count));
        EXPECT_EQ(std::count(taken.begin(), taken.end(), 1), std::ptrdiff_t(count));
    }
}

TEST_P(Team, WhatOneLoopWritesTheNextOneReads) {
    std::vector<std::size_t> numbers(1000, 0);
    for (std::size_t loop = 0; loop < 500; ++loop) {
        // Read by other workers than those that wrote it.
        std::atomic<int> wrong{0};
        team.shares(numbers.size(), always, [&](std::size_t begin, std::size_t end, unsigned) {
            for (std::size_t i = begin; i < end; ++i) {
                wrong += numbers[numbers.size() - 1 - i] != loop;
            }
        });
        ASSERT_EQ(wrong, 0) << loop;
        team.shares(numbers.size(), always, [&](std::size_t begin, std::size_t end, unsigned) {
            for (std::size_t i = begin; i < end; ++i) ++numbers[i];
        });
    }
}

TEST_P(Team, PassesAnExceptionOnAndGoesOn) {
    for (int loop = 0; loop < 50; ++loop) {
        std::atomic<unsigned> calls{0};
        EXPECT_THROW(team.run(team.size(),
                              [&](unsigned worker) {
                                  ++calls;
                                  if (worker == team.size() - 1) throw std::runtime_error("here");
                              }),
                     std::runtime_error);
        EXPECT_EQ(calls, team.size());
        calls = 0;
        team.run(team.size(), [&](unsigned) { ++calls; });
        EXPECT_EQ(calls, team.size());
    }
}

TEST_P(Team, ReductionsHaveTheBitsOfOneThread) {
    Random random(5);
    for (const std::size_t count : {0, 1, 255, 256, 257, 10'000}) {
        std::vector<double> values(count);
        for (double& value : values) value = std::exp(random.uniform(-20, 20));
        const auto sum = [&](std::size_t begin, std::size_t end) {
            double part = 0;
            for (std::size_t i = begin; i < end; ++i) part += values[i];
            return part;
        };
        const auto most = [&](std::size_t begin, std::size_t end) {
            double part = 0;
            for (std::size_t i = begin; i < end; ++i) part = std::max(part, values[i]);
            return part;
        };
        EXPECT_EQ(team.sum(count, always, sum), ThreadTeam::serial().sum(count, always, sum));
        EXPECT_NEAR(team.sum(count, always, sum), sum(0, count), 1e-12 * sum(0, count));
        EXPECT_EQ(team.maximum<double>(count, always, most), most(0, count));
        for (const std::size_t wanted : {std::size_t(0), count / 2, count}) {
            const auto holds = [&](std::size_t begin, std::size_t end) {
                return begin <= wanted && wanted < end;
            };
            EXPECT_EQ(team.any(count, always, holds), wanted < count);
        }
    }
}

TEST(ThreadTeam, ShortLoopsStayOnTheCallersThread) {
    const ThreadTeam team(4);
    constexpr std::size_t hundred = 100;
    EXPECT_EQ(team.workersFor(99, hundred), 1u);
    EXPECT_EQ(team.workersFor(100, hundred), team.size());
    const auto caller = std::this_thread::get_id();
    team.shares(99, hundred, [&](std::size_t begin, std::size_t end, unsigned worker) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_EQ(worker, 0u);
        EXPECT_EQ(end - begin, 99u);
    });
}

TEST(ThreadTeam, HasAtLeastOneThread) {
    EXPECT_EQ(ThreadTeam(0).threads(), 1u);
    EXPECT_EQ(ThreadTeam(0).size(), 1u);
    EXPECT_GE(ThreadTeam::cores(), 1u);
}

/// Several workers to a thread: one that is held up loses only the one it has begun.
TEST(ThreadTeam, ASlowThreadLeavesItsWorkersToOthers) {
    const ThreadTeam team(2, Thresholds::none());
    ASSERT_GT(team.size(), 2u);
    std::atomic<unsigned> others{0};
    std::atomic<bool> waited{false};
    team.run(team.size(), [&](unsigned) {
        if (waited.exchange(true)) {
            ++others;
            return;
        }
        // The first to begin waits until all others have been done, whoever's they were.
        while (others < team.size() - 1) std::this_thread::yield();
    });
    EXPECT_EQ(others, team.size() - 1);
}

TEST(ThreadTeam, SleepingThreadsWakeUp) {
    const ThreadTeam team(4, Thresholds::none());
    for (int loop = 0; loop < 20; ++loop) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        std::atomic<unsigned> calls{0};
        team.run(team.size(), [&](unsigned) { ++calls; });
        ASSERT_EQ(calls, team.size());
    }
}

}  // namespace
}  // namespace quadrille
