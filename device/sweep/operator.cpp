#include "device/sweep/operator.h"

#include <poll.h>
#include <unistd.h>

#include <cstdio>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"

namespace drude {

void TerminalOperator::ask(const std::string& request) {
    if (confirmed_) return;
    if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) {
        user_error(
            "the bench needs somebody to {}, and there is no terminal to ask on; run this on a "
            "terminal, or add --yes where every such thing is seen to without being asked",
            request);
    }
    // Over the progress bar, where there is one.
    const char* const clear = can_redraw_stderr() ? "\r\033[K" : "";
    std::fputs(fmt::format("{}Please {}, then press Enter: ", clear, request).c_str(), stderr);
    std::fflush(stderr);
    for (;;) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        const int ready = poll(&input, 1, 100);
        if (interrupted() != 0) return;
        if (ready <= 0) continue;
        char buffer[256];
        const ssize_t count = read(STDIN_FILENO, buffer, sizeof buffer);
        if (count > 0 && buffer[count - 1] == '\n') return;
        if (count == 0) {
            user_error("the bench needs somebody to {}, and the input has ended", request);
        }
    }
}

}  // namespace drude
