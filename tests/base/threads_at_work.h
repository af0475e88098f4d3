#pragma once

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "base/executor.h"

namespace drude {

// How many threads of one parallel_for are at work at the same time: each waits until all that were
// asked for have come, on a busy machine for as long as it takes, up to ten seconds.
inline size_t threads_at_work(int threads) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const auto all_seen = [&] {
        const std::lock_guard<std::mutex> lock(mutex);
        seen.insert(std::this_thread::get_id());
        return seen.size() >= static_cast<size_t>(threads);
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    parallel_for(100, threads, [&](size_t) {
        while (!all_seen() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        }
    });
    return seen.size();
}

}  // namespace drude
