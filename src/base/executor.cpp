#include "base/executor.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#ifdef DRUDE_JTHREAD_EXECUTOR
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace drude {

int available_threads() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    return 1;
}

void parallel_for(size_t count, int threads, const std::function<void(size_t)>& body) {
    if (threads <= 0) threads = available_threads();
    threads = static_cast<int>(std::min<size_t>(static_cast<size_t>(threads), count));
    if (threads <= 1) {
        for (size_t i = 0; i < count; ++i) body(i);
        return;
    }
    // One shared counter hands out the work, so that a slow index does not hold up the rest of a
    // pre-cut range; each worker pulls until the counter or an exception says stop.
    std::atomic<size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&] {
        for (;;) {
            const size_t i = next.fetch_add(1, std::memory_order_relaxed);
            if (i >= count || failed.load(std::memory_order_relaxed)) return;
            try {
                body(i);
            } catch (...) {
                const std::lock_guard<std::mutex> lock(error_mutex);
                if (!error) error = std::current_exception();
                failed = true;
            }
        }
    };
#ifdef DRUDE_JTHREAD_EXECUTOR
    {
        std::vector<std::jthread> pool;
        for (int t = 0; t < threads; ++t) pool.emplace_back(work);
    }
#else
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(
            0, threads, [&](int) { work(); }, tbb::simple_partitioner());
    });
#endif
    if (error) std::rethrow_exception(error);
}

}  // namespace drude
