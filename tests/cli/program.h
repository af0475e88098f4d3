// Running the program itself, as people do.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "temporary_folder.h"

namespace drude {

struct ProgramRun {
    int status = -1;  // exit status, or 128 + signal
    std::string out, err;
};

inline std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// `drude ARGUMENTS` in `folder`, through a shell; `before` is put before it ("ulimit -f 8; ").
inline ProgramRun run_drude(const TemporaryFolder& folder, const std::string& arguments,
                            const std::string& before = "") {
    const std::string command = "cd '" + folder.path().string() + "' && { " + before + "'" +
                                DRUDE_BINARY_DIR "/drude' " + arguments +
                                "; } > .out 2> .err < /dev/null";
    const int raw = std::system(command.c_str());
    ProgramRun run;
    run.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    run.out = read_text(folder.file(".out"));
    run.err = read_text(folder.file(".err"));
    return run;
}

// Starts `drude ARGUMENTS` in `folder` and sends `signal` when `moment` returns; its exit status,
// 128 + signal where a signal ended it. What it prints is in .err.
inline int run_and_signal(const TemporaryFolder& folder, std::vector<std::string> arguments,
                          int signal, const std::function<void()>& moment) {
    arguments.insert(arguments.begin(), "drude");
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    const std::string errors = folder.file(".err"), path = folder.path().string();
    const pid_t child = fork();
    if (child == 0) {
        // What a test runner in the background may have left ignored.
        for (const int caught : {SIGINT, SIGTERM}) std::signal(caught, SIG_DFL);
        const int out = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (chdir(path.c_str()) != 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0) _exit(99);
        execv(DRUDE_BINARY_DIR "/drude", words.data());
        _exit(98);
    }
    moment();
    ::kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Looks every millisecond whether `condition` holds; false where it does not within two minutes.
inline bool wait_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace drude
