// How fitted values scatter over measurements like the one that was fitted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fitter/fit.h"

namespace drude {

struct BootstrapOptions {
    int draws = 1000;  // 20 to 1 000 000, and draws times fitted wavelengths at most 2e7
    uint64_t seed = 1;
};

inline constexpr std::array<double, 4> bootstrap_quantiles = {0.025, 0.16, 0.84, 0.975};

// Of the draws in which the value was determined; NaN where there were fewer than two.
struct Scatter {
    int draws = 0;
    double mean = 0, sigma = 0;
    std::array<double, 4> quantiles = {0, 0, 0, 0};  // at bootstrap_quantiles
};

struct BootstrapPoint {
    double wavelength_nm = 0;
    Scatter n, k;
};

struct BootstrapResult {
    int draws = 0;
    int failures = 0;  // draws that were refused as a whole; they are in no scatter
    uint64_t seed = 0;
    std::vector<BootstrapPoint> points;  // at the wavelengths that the fit determined
    std::vector<Scatter> common;         // as FitResult::common
};

// The parametric bootstrap (Efron 1979; Efron & Tibshirani 1993, section 6.5): Psi and Delta drawn
// from the fitted model, normal with the standard deviations that the fit took for the data (of an
// unweighted fit the scatter of its residuals), and each drawing fitted as the measurement was,
// from its own start and, for a film, with its own search. Quantiles are interpolated linearly
// between order statistics. Row i of draw j takes a pair of deviates that depends on the seed, i
// and j alone, so the result is the same on any number of threads.
//
// `options`: those that `fit` came from. Throws Error (user) for options out of range.
BootstrapResult bootstrap(const Measurement& measurement, const FitOptions& options,
                          const FitResult& fit, const BootstrapOptions& how);

}  // namespace drude
