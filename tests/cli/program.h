// Running the program itself, as people do.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

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

}  // namespace drude
