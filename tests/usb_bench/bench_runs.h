// usb-bench, run with a program in a folder of the test's own.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.h"

namespace drude {

struct BenchRun {
    int status = -1;
    std::string out, err;
    nlohmann::json report;  // as usb-bench wrote it; null where it did not
};

// `options` are usb-bench's, `program` what it runs, with its arguments; names of this build's
// programs stand in them as {drude} and {client}.
inline BenchRun run_on_bench(const TemporaryFolder& folder, const std::string& options,
                             std::string program) {
    const auto name = [&](const std::string& mark, const std::string& path) {
        for (size_t at; (at = program.find(mark)) != std::string::npos;) {
            program.replace(at, mark.size(), path);
        }
    };
    name("{drude}", DRUDE_BINARY_DIR "/drude");
    name("{client}", DRUDE_BINARY_DIR "/instrument-client");
#if defined(DRUDE_SANITIZED)
    // LeakSanitizer traces its program, which only one can do.
    const std::string more = " --no-inspect ";
#else
    const std::string more = " ";
#endif
    const std::string command = "cd '" + folder.path().string() +
                                "' && rm -f .report && '" DRUDE_BINARY_DIR
                                "/usb-bench' --report .report" +
                                more + options + " -- " + program + " > .out 2> .err < /dev/null";
    const int raw = std::system(command.c_str());
    BenchRun run;
    run.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    run.out = read_text(folder.file(".out"));
    run.err = read_text(folder.file(".err"));
    const std::string report = read_text(folder.file(".report"));
    if (!report.empty()) run.report = nlohmann::json::parse(report);
    return run;
}

}  // namespace drude
