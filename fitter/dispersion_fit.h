// n and k of all wavelengths by one formula.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit_result.h"
#include "fitter/point_data.h"
#include "fitter/point_fit.h"

namespace drude {

struct DispersionFit {
    std::string name;                 // of the formula: that of DispersionModel
    std::vector<FittedPoint> points;  // n and k of the formula, with its standard deviations
    std::vector<FittedParameter> parameters;  // of the formula, then the offset if it is fitted
    std::vector<double> correlation;          // row-major, as `parameters`
    double condition = 0;
    double chi2 = 0;
    int data = 0;
    std::vector<double> values;  // of all parameters of the formula, determined or not
    StartCount starts;
    std::vector<LadderRung> ladder;  // of "compact" and "spline": the formulas that were tried
};

// `name`: what DispersionModel takes; or "compact", the smallest of drude, drude+cp and drude+2cp,
// or "spline", with as many intervals, that the Bayesian information criterion asks for (a larger
// formula is taken where it falls by more than ladder_bic_gain). `estimator`: psi_delta or rho2.
// `unweighted`: the criterion for weights that say nothing of the noise. With `fit_offset` an error
// in the angles of incidence that all share is one more parameter. `start`: parameters of that
// formula to start from instead; empty for the search.
//
// Starts are found without literature: random nonlinear parameters, linear ones by least squares,
// both refined on the permittivities of the point by point fit where there is one; the best are
// refined on the data themselves. The same bits for any number of threads.
//
// Throws Error (user) for an unknown name, Error (answer_is_no) where nothing converges or there
// are fewer data than parameters.
DispersionFit fit_dispersion(const std::vector<WavelengthData>& groups, Estimator estimator,
                             const std::string& name, const std::vector<double>& start,
                             bool fit_offset, bool unweighted, int threads);

}  // namespace drude
