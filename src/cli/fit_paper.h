// `drude fit --like-the-paper`: what it runs and prints.
#pragma once

#include <string>

#include "cli/command.h"

namespace drude {

struct PaperCommandOptions {
    bool wanted = false;
    double wavelength_nm = 0;  // 0: the paper's
    std::string literature;    // MATERIAL, or empty: chosen by the sample's name
};

void declare_paper_options(OptionSet& options, PaperCommandOptions& values);

// That nothing was given which the procedure has no use for, and nothing of it without it.
void check_paper_options(const PaperCommandOptions& options, const OptionSet& given);

// Without a measurement (`file` is empty) the paper's own table is put to the test. The exit
// status: 1 where its constants do not come back.
int run_like_the_paper(const PaperCommandOptions& options, const std::string& file,
                       const std::string& format, const CommonOptions& common);

}  // namespace drude
