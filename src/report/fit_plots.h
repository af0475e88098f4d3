// The figures of one fit.
#pragma once

#include <string>
#include <vector>

#include "report/fit_report.h"

namespace drude {

struct FitFigure {
    std::string name;  // "psi": of the file without extension, and of the figure in a page
    std::string svg;
    std::string caption;
};

// Of the data and the model, each against wavelength: psi, delta, and the residuals in units of the
// standard deviations (residuals_psi and residuals_delta; of the estimator rho2 residuals_tan2psi).
std::vector<FitFigure> data_figures(const FitReport& report);

// n and k with bands of one and two standard deviations, over the published sets of
// report.literature and their envelope.
std::vector<FitFigure> constants_figures(const FitReport& report);

}  // namespace drude
