// Options of `drude fit` that ask for more than n and k, and what they do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/command.h"
#include "report/fit_report.h"

namespace drude {

struct FitStatisticsOptions {
    std::string robust = "none";
    std::string literature;  // empty: chosen by sample or distance
    int bootstrap = 0;
    uint64_t seed = 1;
    bool profile = false;
    std::string profile_at;
    std::string plots, html;
};

void declare_fit_statistics(OptionSet& options, FitStatisticsOptions* values);

// Throws Error (user) for options that go with others, or with a measurement where there is none.
void check_fit_statistics(const FitStatisticsOptions& options, const OptionSet& given,
                          bool measurement);

// Fills in what is asked for; what profiles warn of joins the fit's warnings.
void run_fit_statistics(const FitStatisticsOptions& options, FitReport* report);

// The figures and the page.
void write_fit_figures(const FitStatisticsOptions& options, const FitReport& report);

}  // namespace drude
