#include "base/interrupt.h"

#include <atomic>
#include <csignal>

namespace drude {

namespace {

static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch these");
std::atomic<int> caught{0};

extern "C" void on_signal(int signal) {
    caught = signal;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    for (const int signal : {SIGINT, SIGTERM}) {
        // Whoever started this in the background asked that the signal be ignored.
        if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

void let_interrupts_end() {
    for (const int signal : {SIGINT, SIGTERM}) {
        if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

int interrupted() {
    return caught;
}

}  // namespace drude
