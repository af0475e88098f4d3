// `drude reduce`: a journal to its measurement, again.
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "cli/capture_output.h"
#include "cli/command_list.h"
#include "cli/warnings.h"

namespace drude {

namespace {

int run_reduce(const CaptureOutput& options, const CommonOptions& common) {
    if (options.output.empty()) user_error("reduce: no output; name the file with -o M.csv");
    CaptureOutput what = options;
    const Journal journal = read_journal(what.journal);
    if (journal.torn_bytes > 0) {
        print_warning(fmt::format("{}: the last {} bytes are of a record that was cut short",
                                  what.journal, journal.torn_bytes));
    }
    what.resumed = !journal.resumes.empty();
    write_reduction(journal, what, common);
    return 0;
}

}  // namespace

Command reduce_command() {
    Command command;
    command.name = "reduce";
    command.summary = "Derive a measurement again from the journal of its sweep";
    command.description =
        "Reads the raw frames that `drude capture` kept and derives Psi and Delta, the lobe scan "
        "or the calibration from them, with the calibration and the bins that are given. A "
        "journal of a sweep that was not finished gives the angles that are complete.";
    command.example =
        "$ drude capture --instrument virtual:Cu-McPeak --angles 70 -o cu.csv\n"
        "$ drude reduce cu.journal --calibration calibration.json --wavelengths 400:700:10 \\\n"
        "      -o cu-calibrated.csv\n";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<CaptureOutput>();
        set.positional("JOURNAL", options->journal, "what `drude capture` kept", true);
        set.option("-o,--output", options->output, "the file to write");
        set.option("--calibration", options->calibration, "of the bench (JSON)");
        set.option("--wavelengths", options->wavelengths, "bins, nm (default: the recipe's)");
        return [options, &common] { return run_reduce(*options, common); };
    };
    return command;
}

}  // namespace drude
