#include "base/executor.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/threads_at_work.h"

namespace drude {
namespace {

TEST(Executor, RunsEveryIndexOnce) {
    for (const int threads : {0, 1, 2, 7, 64}) {
        std::vector<std::atomic<int>> runs(1000);
        parallel_for(runs.size(), threads, [&](size_t i) { ++runs[i]; });
        for (const auto& run : runs) ASSERT_EQ(run, 1) << threads << " threads";
    }
}

TEST(Executor, SameResultForAnyNumberOfThreads) {
    const auto run = [](int threads) {
        std::vector<double> result(5000);
        parallel_for(result.size(), threads,
                     [&](size_t i) { result[i] = std::sin(static_cast<double>(i)) / 3; });
        return result;
    };
    const std::vector<double> expected = run(1);
    for (const int threads : {0, 2, 3, 16}) EXPECT_EQ(run(threads), expected);
}

TEST(Executor, TakesEmptyAndShortLoops) {
    parallel_for(0, 4, [](size_t) { FAIL(); });
    int runs = 0;
    parallel_for(1, 4, [&](size_t i) { runs += i == 0 ? 1 : 100; });
    EXPECT_EQ(runs, 1);
}

// Also more than there are processors: the number of threads must not depend on the machine.
TEST(Executor, UsesAsManyThreadsAsAsked) {
    for (const int threads : {1, 2, 6}) {
        EXPECT_EQ(threads_at_work(threads), static_cast<size_t>(threads));
    }
}

TEST(Executor, ATypingErrorInTheNumberOfThreadsDoesNoHarm) {
    std::atomic<int> runs{0};
    parallel_for(2000, 2000000000, [&](size_t) { ++runs; });
    EXPECT_EQ(runs, 2000);
}

TEST(Executor, RethrowsTheLowestFailureWhateverTheThreads) {
    for (const int threads : {1, 2, 8}) {
        for (int repeat = 0; repeat < 20; ++repeat) {
            std::atomic<size_t> runs{0};
            try {
                parallel_for(100000, threads, [&](size_t i) {
                    ++runs;
                    // The lowest is also the slowest to fail.
                    if (i == 40) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                    if (i >= 40 && i % 10 == 0) throw std::runtime_error(std::to_string(i));
                });
                FAIL() << "nothing was thrown";
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), "40") << threads << " threads";
            }
            EXPECT_LT(runs, 100000U) << "the loop went on after a failure";
        }
    }
}

TEST(Executor, LoopsNest) {
    std::atomic<int> runs{0};
    parallel_for(8, 4, [&](size_t) { parallel_for(8, 4, [&](size_t) { ++runs; }); });
    EXPECT_EQ(runs, 64);
}

TEST(Executor, KnowsWhatItMayUse) {
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    EXPECT_EQ(available_threads(), CPU_COUNT(&before));
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu) {
        if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
    }
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(available_threads(), 1);
    sched_setaffinity(0, sizeof before, &before);
}

}  // namespace
}  // namespace drude
