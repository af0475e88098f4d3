// The program that is driven against the virtual devices, watched while it runs.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace drude::usb_bench {

struct ClientRun {
    int status = 0;                      // exit status, or 128 + signal
    bool hung = false;                   // killed because it took longer than allowed
    bool exited = false;                 // by itself, so that what it still held is its own doing
    std::vector<std::string> left_over;  // descriptors and threads that it had when it exited
};

struct ClientOptions {
    double seconds_allowed = 60;
    // Stop the program at the last system call of its life, when nothing is torn down yet, and
    // look: needs ptrace and seccomp, and is not for programs under LeakSanitizer, which traces.
    bool inspect = true;
    std::string device_root;     // descriptors of files below it are the devices'
    bool drop_override = false;  // root may not open what its permissions forbid
    std::function<void(pid_t)> on_start;
    // Called while the program stands at its exit, inspected or not (then after it).
    std::function<void()> at_exit;
};

// Runs it with this process's environment and standard streams. Throws Error (outside) where it
// cannot be started.
ClientRun run_client(const std::vector<std::string>& command, const ClientOptions& options);

}  // namespace drude::usb_bench
