#include "base/executor.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#ifdef DRUDE_JTHREAD_EXECUTOR
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace drude {

namespace {

// More than any machine has; a typing error in --threads must not exhaust the system.
constexpr int most_threads = 256;

}  // namespace

int available_threads() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    // The fixed-size set is too small for machines of more than 1024 processors.
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(size_t count, int threads, const std::function<void(size_t)>& body) {
    if (threads <= 0) threads = available_threads();
    threads = std::min(threads, most_threads);
    threads = static_cast<int>(std::min<size_t>(static_cast<size_t>(threads), count));
    if (threads <= 1) {
        for (size_t i = 0; i < count; ++i) body(i);
        return;
    }
    // One shared counter hands out the work, so that a slow index does not hold up the rest of a
    // pre-cut range. Once an index has failed only those below it still run: they may fail too,
    // and the lowest failure is the one that is reported, whatever the number of threads.
    std::atomic<size_t> next{0};
    std::atomic<size_t> lowest_failure{count};
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&] {
        for (;;) {
            const size_t i = next.fetch_add(1, std::memory_order_relaxed);
            if (i >= lowest_failure.load(std::memory_order_relaxed)) return;
            try {
                body(i);
            } catch (...) {
                const std::lock_guard<std::mutex> lock(error_mutex);
                if (i < lowest_failure) {
                    lowest_failure = i;
                    error = std::current_exception();
                }
            }
        }
    };
#ifdef DRUDE_JTHREAD_EXECUTOR
    {
        std::vector<std::jthread> pool;
        for (int t = 0; t < threads; ++t) pool.emplace_back(work);
    }
#else
    // TBB keeps to the processors there are; more threads are worked with where they are asked for.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(std::max(threads, available_threads())));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(
            0, threads, [&](int) { work(); }, tbb::simple_partitioner());
    });
#endif
    if (error) std::rethrow_exception(error);
}

#ifdef DRUDE_JTHREAD_EXECUTOR
void on_one_pool_thread(const std::function<void()>& body) {
    body();
}
bool uses_tbb_pool() {
    return false;
}
#else
void on_one_pool_thread(const std::function<void()>& body) {
    tbb::task_arena(1).execute(body);
}
bool uses_tbb_pool() {
    return true;
}
#endif

}  // namespace drude
