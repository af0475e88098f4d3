// Running the program itself, as people do.
#pragma once

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace drude {

struct ProgramRun {
    int status = -1;  // exit status, or 128 + signal
    std::string out, err;
};

// A folder of its own that goes with the object.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "drude-test-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp");
        path_ = name;
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

inline std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// `drude ARGUMENTS` in `folder`, through a shell; `before` is put before it ("ulimit -f 8; ").
inline ProgramRun run_drude(const ScratchFolder& folder, const std::string& arguments,
                            const std::string& before = "") {
    const std::string command = "cd '" + folder.path() + "' && { " + before + "'" +
                                DRUDE_BINARY_DIR "/drude' " + arguments +
                                "; } > .out 2> .err < /dev/null";
    const int raw = std::system(command.c_str());
    ProgramRun run;
    run.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    run.out = read_text(folder / ".out");
    run.err = read_text(folder / ".err");
    return run;
}

}  // namespace drude
