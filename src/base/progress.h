// Progress with time left: a bar on a terminal, otherwise a line every few seconds, on stderr.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace drude {

class Progress {
  public:
    // `quiet` prints nothing. `total` counts the steps of step(). `period` is the time between two
    // lines off a terminal; a bar moves ten times a second.
    Progress(std::string title, size_t total, bool quiet,
             std::chrono::milliseconds period = std::chrono::seconds(5));
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // From any thread.
    void step(size_t count = 1);

  private:
    void print(bool last);

    std::string title_;
    size_t total_;
    bool quiet_;
    bool terminal_;
    std::chrono::milliseconds period_;
    std::mutex mutex_;
    size_t done_ = 0;
    std::chrono::steady_clock::time_point start_, printed_;
};

// Whether stderr is a terminal that can go back over what it shows: on anything else ("dumb"
// terminals included) escape sequences are litter.
bool can_redraw_stderr();

// "1:02:03", "2:03", "4 s".
std::string format_duration(double seconds);

}  // namespace drude
