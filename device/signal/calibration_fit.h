// A model of alpha and beta against the analyser, fitted to the scans of a calibration.
#pragma once

#include <functional>
#include <vector>

#include "device/signal/wavelength_bins.h"

namespace drude {

// What a model says alpha and beta of a scan are; the parameters are at most 4.
using Model =
    std::function<void(const double* parameters, double analyser_rad, double* alpha, double* beta)>;

struct Fitted {
    bool good = false;
    double value[4] = {};
    double covariance[16] = {};  // of the scans' noise
    double chi2 = 0;
    int freedom = 0;
};

// Gauss-Newton on alpha and beta of all scans of a bin; the derivatives by central differences of
// functions that are smooth and of order 1.
Fitted fit_model(const Model& model, int parameters, const double* start,
                 const std::vector<BinnedFit>& points, const std::vector<double>& analyser_rad);

// The weighted mean of angles that lie near each other, with its sigma from their own and, where
// they scatter more than these say, from the scatter.
struct WeightedMean {
    double weight = 0, sum = 0, squares = 0;
    int count = 0;

    void add(double value, double variance) {
        const double w = 1 / (variance + 1e-24);
        weight += w;
        sum += w * value;
        squares += w * value * value;
        ++count;
    }
    double mean() const { return sum / weight; }  // count > 0, as for sigma()
    double sigma() const;
};

// The scans' coefficients in one bin; empty where one of them has none.
std::vector<BinnedFit> bin_of(const std::vector<std::vector<BinnedFit>>& scans, size_t bin);

}  // namespace drude
