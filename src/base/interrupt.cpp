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
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

int interrupted() { return caught; }

}  // namespace drude
