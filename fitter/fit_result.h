// What a fit of optical constants returns: values, standard deviations, and what the data cannot
// say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "materials/material.h"

namespace drude {

// Where least squares started: how many starts converged, and how many of these ended within 1e-6
// of the lowest chi-square, relatively. 0 and 0 where nothing is searched for. The lowest of
// the others is so much above; 0 where there is none, and in sums over wavelengths.
struct StartCount {
    int refined = 0, in_best = 0;
    double next_chi2_excess = 0;
};

// Of the chi-squares that starts ended with; one that is not finite did not converge.
StartCount count_starts(const std::vector<double>& chi2);

// n and k at one wavelength. Where `identifiable` is false the data do not determine them: both
// are NaN, so are the standard deviations, and `reason` says why.
struct FittedPoint {
    double wavelength_nm = 0;
    double n = 0, k = 0;
    double sigma_n = 0, sigma_k = 0;  // one standard deviation, from the data's sigmas alone
    double correlation = 0;           // of n and k, in [-1, 1]
    double chi2 = 0;
    int data = 0;          // residuals
    double condition = 0;  // of the weighted Jacobian: largest over smallest singular value
    // Standard deviation over the angles of n and k inverted angle by angle; 0 for a single angle.
    // Far above sigma_n and sigma_k it says that the sample is no bare surface.
    double spread_n = 0, spread_k = 0;
    bool at_bound = false;  // k = 0, or n at its lower bound
    bool identifiable = false;
    std::string reason;
    StartCount starts;  // of this wavelength alone; none where a formula shares the parameters
};

// A parameter that all wavelengths share.
struct FittedParameter {
    std::string name, unit;  // "thickness", "nm"; the unit of a pure number is ""
    double value = 0;
    double sigma = 0;       // NaN where not identifiable
    bool at_bound = false;  // of the range in which it is sought
    bool identifiable = false;
};

// A model that was tried on the way to the smallest one that the data need.
struct LadderRung {
    std::string model;
    int data = 0, parameters = 0;  // 0 where the model could not be fitted
    double chi2_reduced = 0, bic = 0;
    bool taken = false;     // better than what was taken before it
    std::string objection;  // why not
};

struct FitResult {
    std::string estimator;  // "psi-delta", "rho2", "inversion"
    std::string model;      // "bulk", "overlayer", "film"
    // The formula that n and k of `points` follow, its parameters in `common`; "" for none.
    std::string dispersion;
    std::vector<double> dispersion_parameters;  // all of them, whether they are determined or not
    // Ascending in wavelength: of the surface ("bulk"), of what lies below the layers
    // ("overlayer"), of the film itself ("film").
    std::vector<FittedPoint> points;
    std::vector<FittedParameter> common;
    std::vector<double> common_correlation;  // row-major, as `common`
    double condition = 0;                    // of the Jacobian of `common`; 0 where there is none
    // What lies on the surface, the first the outermost: the user's layers, or the fitted film.
    std::vector<FilmLayer> layers;
    OpticalConstants substrate;  // below a fitted film; otherwise without rows: `points` are it
    // Of a fitted film: standard deviation of its thickness over the beam, and full width at half
    // maximum of the slit; 0 for an even film and a narrow slit.
    double thickness_spread_nm = 0, bandwidth_nm = 0;
    // The next best thickness of a film that is a minimum by itself, and how much worse its
    // chi-square is; 0 and 0 where the search met none.
    double rival_thickness_nm = 0, rival_chi2_excess = 0;
    // Of the search over all wavelengths: of a formula, or of a film; otherwise summed over the
    // identifiable points, each with a search of its own.
    StartCount starts;
    double chi2 = 0;     // summed over the identifiable points
    int data = 0;        // residuals in that sum
    int parameters = 0;  // fitted to them
    // Of the model "auto", or of a dispersion that picks its size, in the order tried.
    std::vector<LadderRung> ladder;
    // The robust loss, "" without; then `chi2` is the sum of the losses, and so many rows of those
    // fitted count for less than half of what least squares would let them.
    std::string robust;
    int rows_down_weighted = 0;
    std::vector<std::string> warnings;

    int dof() const { return data - parameters; }
    // Of `common` by name, or null where there is none.
    const FittedParameter* find(std::string_view name) const;
    // n, k and their standard deviations where they are identifiable, as a table of kind "fitted"
    // without a name.
    OpticalConstants constants() const;
    // NaN where there are no more data than parameters.
    double chi2_reduced() const;
};

}  // namespace drude
