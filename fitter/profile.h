// Profile likelihood: how far each parameter can go while the others make up for it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fitter/fit.h"
#include "fitter/profile_interval.h"

namespace drude {

struct ProfiledParameter {
    std::string name, unit;    // as FittedParameter; "n" and "k" of one wavelength
    double wavelength_nm = 0;  // 0 for a parameter that all wavelengths share
    double value = 0, sigma = 0;
    std::array<ProfileInterval, 2> intervals;  // at profile_rises
};

struct ProfileResult {
    // The common ones, then n and k by wavelength. One along whose profile chi-square falls below
    // that of the fit is left out and named in the warnings.
    std::vector<ProfiledParameter> parameters;
    std::vector<std::string> warnings;
};

// For every common parameter, and for n and k at every fitted wavelength (of those nearest to
// `only_nm`, where it is not empty): the interval within which chi-square, smallest over all other
// parameters, rises by less than profile_rises. Unlike a standard deviation it shows skewness, and
// a side on which the data set no limit before the bound of the search is open. Bounds: n from
// 1e-6, k from 0, both to 1000, an angle offset of 2 degrees, porosity 0 to 0.95, thickness from 0
// to the largest that was searched; around a film's thickness the interference order stays the
// same as long as chi-square rises monotonically. n and k of a film follow from its porosity and
// have no profile. Of an unweighted fit chi-square is taken in units of the reduced one.
//
// `options`: those that `fit` came from. Throws Error (user) for the estimator inversion, robust
// losses, models other than bulk, overlayer and film, and wavelengths outside those fitted.
ProfileResult profile_likelihood(const Measurement& measurement, const FitOptions& options,
                                 const FitResult& fit, const std::vector<double>& only_nm = {});

}  // namespace drude
