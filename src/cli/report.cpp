// drude report: the page and the figures of a study, from its folder.
#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/report_output.h"

namespace drude {

namespace {

void print(const ReportOptions& options, const ReportResult& result) {
    if (options.figure == 0) {
        print_claims(result.claims);
        fmt::print("{}/index.html: {:.1f} MB\n", options.folder,
                   static_cast<double>(result.page_bytes) * 1e-6);
    }
    for (const std::string& file : result.files) {
        if (file.rfind("figure-", 0) == 0 || file == "comparison.png") {
            fmt::print("{}/{}\n", options.folder, file);
        }
    }
}

}  // namespace

Command report_command() {
    Command command;
    command.name = "report";
    command.summary = "Make a study's page and figures again, without rendering";
    command.description =
        "Reads the folder that `drude reproduce` wrote (study.json, measurements, fits, EXRs) and "
        "writes its page index.html, tables and figures anew; nothing is measured or rendered.\n\n"
        "index.html is one self-contained file. It carries the pictures as numbers: their pairs "
        "can be zoomed, exposed, subtracted and read pixel by pixel, S0 to S3 and spectra. "
        "--figure N makes one figure of Berger, Weidlich, Wilkie & Magnor 2012 alone: 5 (copper), "
        "6 (anodised aluminium), 7 (gold), 8 (silver) as figure-N.svg; 9 (the pictures) as "
        "comparison.png.\n\n"
        "The page's table of the paper's claims is printed, and with --json given with its "
        "figures; its verdicts follow from the study's numbers.";
    command.example =
        "drude reproduce -o study\n"
        "drude report study\n"
        "drude report study --figure 5";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<ReportOptions>();
        set.positional("DIR", options->folder, "the study's folder", true);
        set.option("--figure", options->figure, "this figure of the paper alone, 5 to 9");
        return [options, &set, &common] {
            if (set.given("--figure") && options->figure == 0) {
                user_error("--figure: found 0, expected 5 to 9");
            }
            options->threads = common.threads;
            const ReportResult result = write_report(*options);
            if (common.json) {
                print_json_document(report_json(options->folder, result));
            } else {
                print(*options, result);
            }
            return 0;
        };
    };
    return command;
}

}  // namespace drude
