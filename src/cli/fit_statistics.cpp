#include "cli/fit_statistics.h"

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "fitter/robust_fit.h"
#include "report/fit_plots.h"

namespace drude {

void declare_fit_statistics(OptionSet& options, FitStatisticsOptions* values) {
    options.choice("--robust", values->robust, robust_names(),
                   "loss that lets rows far from the model count less");
    options.option("--literature", values->literature,
                   "MATERIAL or set to compare n and k with; or none");
    options.flag("--profile", values->profile, "profile likelihood of every parameter");
    options.option("--profile-at", values->profile_at, "NM: of n and k only at these wavelengths");
    options.option("--bootstrap", values->bootstrap, "N: draw and refit so many measurements");
    options.option("--seed", values->seed, "of the bootstrap");
    options.option("--plots", values->plots, "FOLDER for the figures (SVG)");
    options.option("--html", values->html, "FILE: a self-contained page of the fit");
}

void check_fit_statistics(const FitStatisticsOptions& options, const OptionSet& given,
                          bool measurement) {
    if (!measurement) {
        refuse_options(given,
                       {"--robust", "--literature", "--profile", "--profile-at", "--bootstrap",
                        "--plots", "--html"},
                       "belongs to a fit of n and k to a measurement");
    }
    if (given.given("--seed") && !given.given("--bootstrap")) {
        user_error("found --seed without --bootstrap: nothing else is drawn");
    }
    if (given.given("--bootstrap") && (options.bootstrap < 20 || options.bootstrap > 1'000'000)) {
        user_error("--bootstrap: found {} draws, expected 20 to 1000000", options.bootstrap);
    }
}

void run_fit_statistics(const FitStatisticsOptions& options, FitReport* report) {
    if (options.literature != "none") {
        report->literature = compare_with_literature(
            report->fit, report->measurement.header_value("sample"), options.literature);
        report->substrates = other_substrates(report->measurement, report->options, report->fit);
    }
    if (options.profile || !options.profile_at.empty()) {
        std::vector<double> only_nm;
        if (!options.profile_at.empty()) only_nm = parse_grid(options.profile_at, "--profile-at");
        report->profile =
            profile_likelihood(report->measurement, report->options, report->fit, only_nm);
        for (const std::string& warning : report->profile->warnings) {
            report->fit.warnings.push_back(warning);
        }
    }
    if (options.bootstrap > 0) {
        report->bootstrap = bootstrap(report->measurement, report->options, report->fit,
                                      {options.bootstrap, options.seed});
    }
}

void write_fit_figures(const FitStatisticsOptions& options, const FitReport& report) {
    if (!options.plots.empty()) {
        make_folder(options.plots);
        std::vector<FitFigure> figures = data_figures(report);
        for (FitFigure& figure : constants_figures(report)) figures.push_back(std::move(figure));
        for (const FitFigure& figure : figures) {
            write_file(options.plots + "/" + figure.name + ".svg", figure.svg);
        }
    }
    if (!options.html.empty()) write_file(options.html, fit_page(report));
}

}  // namespace drude
