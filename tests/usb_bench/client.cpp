#include "usb_bench/client.h"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <linux/capability.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"

namespace drude::usb_bench {

namespace {

// From here on exit_group() stops for the tracer. A thread of this filter that has no tracer could
// not end, so children are traced too.
bool stop_at_exit() {
    std::array<sock_filter, 4> code{{
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, SYS_exit_group},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_TRACE},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
    }};
    const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// What a file permission forbids is forbidden to root as well, after the next exec().
bool drop_override() {
    return geteuid() != 0 || (prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0) == 0 &&
                              prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH, 0, 0, 0) == 0);
}

std::vector<std::string> descriptors_below(pid_t pid, const std::string& root) {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry :
         std::filesystem::directory_iterator(fmt::format("/proc/{}/fd", pid), error)) {
        const std::string target = std::filesystem::read_symlink(entry.path(), error).string();
        if (target.rfind(root, 0) == 0 || target.rfind("socket:", 0) == 0) {
            found.push_back(
                fmt::format("descriptor {} of {}", entry.path().filename().string(),
                            target.rfind(root, 0) == 0 ? target.substr(root.size()) : target));
        }
    }
    return found;
}

// Names of libusb's own threads that live; pools for parallel loops live as long as their program.
std::vector<std::string> libusb_threads(pid_t pid) {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry :
         std::filesystem::directory_iterator(fmt::format("/proc/{}/task", pid), error)) {
        std::ifstream file(entry.path() / "stat");
        std::string stat;
        std::getline(file, stat);
        // "1234 (name) S ...": a thread that ended is a zombie until its tracer has waited for it.
        const size_t end = stat.rfind(')');
        if (stat.find("libusb") >= end || stat.compare(end, 3, ") Z") == 0) continue;
        found.push_back("thread " + stat.substr(stat.find('(') + 1, end - stat.find('(') - 1));
    }
    return found;
}

// A thread that was joined may be listed for another moment.
std::vector<std::string> lasting_threads(pid_t pid) {
    std::vector<std::string> threads = libusb_threads(pid);
    for (int i = 0; i < 100 && !threads.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        threads = libusb_threads(pid);
    }
    return threads;
}

[[noreturn]] void become(const std::vector<std::string>& command, const ClientOptions& options,
                         int go) {
    char byte = 0;
    // The tracer attaches before the filter could stop anything.
    if (read(go, &byte, 1) != 1) _exit(127);
    close(go);
    if (options.drop_override && !drop_override()) _exit(127);
    if (options.inspect && !stop_at_exit()) _exit(127);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    fmt::print(stderr, "usb-bench: cannot run {}: {}\n", command[0], std::strerror(errno));
    _exit(127);
}

}  // namespace

ClientRun run_client(const std::vector<std::string>& command, const ClientOptions& options) {
    int go[2];
    if (pipe2(go, O_CLOEXEC) != 0) outside_error("cannot make a pipe: {}", std::strerror(errno));
    const pid_t pid = fork();
    if (pid < 0) outside_error("cannot fork: {}", std::strerror(errno));
    if (pid == 0) become(command, options, go[0]);
    close(go[0]);
    constexpr long trace_options = PTRACE_O_TRACESECCOMP | PTRACE_O_TRACEFORK |
                                   PTRACE_O_TRACEVFORK | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL;
    if (options.inspect && ptrace(PTRACE_SEIZE, pid, nullptr, trace_options) != 0) {
        kill(pid, SIGKILL);
        waitpid(pid, nullptr, 0);
        outside_error("cannot trace the program: {}", std::strerror(errno));
    }
    if (options.on_start) options.on_start(pid);
    if (write(go[1], "x", 1) != 1) kill(pid, SIGKILL);
    close(go[1]);

    ClientRun run;
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds_allowed);
    while (true) {
        int status = 0;
        const pid_t who = waitpid(-1, &status, WNOHANG | __WALL);
        if (who < 0 && errno != EINTR) break;
        if (who <= 0) {
            if (!run.hung && std::chrono::steady_clock::now() > deadline) {
                run.hung = true;
                kill(pid, SIGKILL);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            continue;
        }
        if (WIFSTOPPED(status)) {
            const int event = status >> 16;
            if (event == PTRACE_EVENT_SECCOMP && who == pid) {
                run.left_over = descriptors_below(pid, options.device_root);
                for (std::string& thread : lasting_threads(pid)) run.left_over.push_back(thread);
                if (options.at_exit) options.at_exit();
            }
            const long signal = event != 0 ? 0 : WSTOPSIG(status);
            ptrace(PTRACE_CONT, who, nullptr, signal);
            continue;
        }
        if (who != pid) continue;
        run.exited = WIFEXITED(status);
        run.status = run.exited ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        break;
    }
    if (!options.inspect && run.exited && options.at_exit) options.at_exit();
    return run;
}

}  // namespace drude::usb_bench
