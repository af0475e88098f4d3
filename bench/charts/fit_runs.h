// The settings of the fit chart, run, and what is read from the outcomes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/charts/chart.h"
#include "bench/charts/fit_experiment.h"

namespace drude {

struct FitRuns {
    FitSetting setting;
    std::string varied;  // "angles", "wavelengths", "noise"; "" is the setting that all share
    std::vector<std::vector<FitOutcome>> outcomes;  // by seed, metal
};

struct FitProcedure {
    std::string name, estimator, dispersion;
    bool is_of(const FitSetting& setting) const {
        return setting.estimator == estimator && setting.dispersion == dispersion;
    }
};
const std::vector<FitProcedure>& fit_procedures();

// All settings with `seeds` measurements each of the five metals, in shuffled order. `quick` leaves
// the dispersion formulas out, `quiet` the progress.
std::vector<FitRuns> run_fits(bool quick, int seeds, bool quiet);

using FitFigure = std::function<double(const FitOutcome&)>;
double fit_constants_error(const FitOutcome& outcome);
FitFigure fit_delta_e(size_t scene);

// Mean over the metals and seeds with the standard deviation of the seeds' mean; not a number where
// one metal has no answer. The cost is the median time of a fit.
ChartPoint fit_point_of(const FitRuns& runs, const FitFigure& figure);

// "3 angles", "41 wavelengths", "0.05 deg of Psi".
std::string fit_setting_name(const FitSetting& setting, const std::string& varied);

// A curve a procedure over what varies; the cost is the noise of Psi, otherwise the number of data.
std::vector<ChartCurve> fit_curves(const std::vector<FitRuns>& all, const std::string& varied,
                                   const FitFigure& figure);

}  // namespace drude
