// A program on a terminal of its own, and what a person would see there.
#pragma once

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

namespace drude {

struct TerminalRun {
    int status = -1;     // exit status, or 128 + signal; -1 where it was ended for taking too long
    std::string screen;  // all bytes that it wrote to the terminal
};

// A shell's `command` with stdin, stdout and stderr on a terminal of `columns` by 24. After each
// appearance of `prompt` the next of `replies` is typed.
inline TerminalRun run_on_terminal(const std::string& command, const std::string& prompt = "",
                                   std::vector<std::string> replies = {},
                                   unsigned short columns = 80, double seconds = 60) {
    winsize size{24, columns, 0, 0};
    int master = -1;
    const pid_t pid = forkpty(&master, nullptr, nullptr, &size);
    if (pid == 0) {
        execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    TerminalRun run;
    size_t seen = 0, replied = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < deadline) {
        pollfd input{master, POLLIN, 0};
        if (poll(&input, 1, 100) <= 0) continue;
        char buffer[4096];
        const ssize_t count = read(master, buffer, sizeof buffer);
        if (count <= 0) break;  // EIO: nobody has the other side open any more
        run.screen.append(buffer, static_cast<size_t>(count));
        while (!prompt.empty() && replied < replies.size()) {
            const size_t at = run.screen.find(prompt, seen);
            if (at == std::string::npos) break;
            seen = at + prompt.size();
            const std::string& reply = replies[replied++];
            if (write(master, reply.data(), reply.size()) < 0) break;
        }
    }
    int status = 0;
    const bool late = std::chrono::steady_clock::now() >= deadline;
    if (late) kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    close(master);
    if (!late) run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return run;
}

}  // namespace drude
