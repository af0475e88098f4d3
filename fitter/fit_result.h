// What a fit of optical constants returns: values, standard deviations, and what the data cannot
// say.
#pragma once

#include <string>
#include <vector>

namespace drude {

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
};

struct FitResult {
    std::string estimator;            // "psi-delta", "rho2", "inversion"
    std::string model;                // "bulk"
    std::vector<FittedPoint> points;  // ascending in wavelength
    double chi2 = 0;                  // summed over the identifiable points
    int data = 0;                     // residuals in that sum
    int parameters = 0;               // fitted to them
    std::vector<std::string> warnings;

    int dof() const { return data - parameters; }
    // NaN where there are no more data than parameters.
    double chi2_reduced() const;
};

}  // namespace drude
