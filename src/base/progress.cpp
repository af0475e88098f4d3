#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace drude {

bool can_redraw_stderr() {
    const char* kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::strcmp(kind, "dumb") != 0;
}

using Clock = std::chrono::steady_clock;

std::string format_duration(double seconds) {
    const long long whole = std::llround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Progress::Progress(std::string title, size_t total, bool quiet, std::chrono::milliseconds period)
    : title_(std::move(title)),
      total_(total),
      quiet_(quiet),
      terminal_(can_redraw_stderr()),
      period_(terminal_ ? std::chrono::milliseconds(100) : period),
      start_(Clock::now()),
      printed_(start_) {}

Progress::~Progress() {
    const std::lock_guard<std::mutex> lock(mutex_);
    // Off a terminal a short job has printed nothing and need not start now.
    if (!quiet_ && (terminal_ || printed_ != start_)) print(true);
}

void Progress::step(size_t count) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += count;
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    if (now - printed_ < period_) return;
    printed_ = now;
    print(false);
}

void Progress::print(bool last) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    const double fraction =
        total_ > 0 ? std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)) : 1;
    const std::string left =
        last || done_ >= total_ || done_ == 0
            ? fmt::format("{} taken", format_duration(elapsed))
            : fmt::format("{} left", format_duration(elapsed * (1 - fraction) / fraction));
    std::string line;
    if (terminal_) {
        constexpr int width = 30;
        const int filled = static_cast<int>(fraction * width);
        line = fmt::format("\r{} [{:=<{}}{: <{}}] {:3.0f} % {}\033[K{}", title_, "", filled, "",
                           width - filled, 100 * fraction, left, last ? "\n" : "");
    } else {
        line = fmt::format("{}: {:.0f} %, {}\n", title_, 100 * fraction, left);
    }
    // Not fmt::print, which throws where stderr cannot be written: nobody watches, the work goes
    // on.
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace drude
