// The one executor behind every parallel loop.
//
// TBB in production; std::jthread where DRUDE_JTHREAD_EXECUTOR is defined (the ThreadSanitizer
// preset), since TBB's synchronisation is invisible to that tool. The result of a loop must not
// depend on the order or the thread in which its indices run.
#pragma once

#include <cstddef>
#include <functional>

namespace drude {

// Hardware threads this process may use, at least 1.
int available_threads();

// Runs body(i) for i in [0, count), on `threads` threads (0: all available; at most 256). Indices
// are handed out singly in ascending order, so a body should be worth a microsecond at least. A
// body that throws ends the loop; what the lowest failing index threw is rethrown here, the same
// for any number of threads.
void parallel_for(size_t count, int threads, const std::function<void(size_t)>& body);

// Runs the body where a library that works with TBB finds one thread, so that what it makes does
// not depend on timing. Limiting such a library by a setting of its own would limit the pool of the
// whole process, and with it parallel_for, for as long as the library keeps that setting.
void on_one_pool_thread(const std::function<void()>& body);

// Whether parallel_for itself works with TBB's pool.
bool uses_tbb_pool();

}  // namespace drude
