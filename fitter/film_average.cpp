#include "fitter/film_average.h"

#include <algorithm>
#include <cmath>

namespace drude {

// The trapezoidal rule for a Gaussian of standard deviation 1: with steps h the average of
// exp(i phase x) is wrong by exp(-(2 pi/h - phase)^2/2), which is spectrally small. Multiple
// reflections turn twice as fast.
GaussianNodes gaussian_nodes(double phase) {
    constexpr double reach = 4.5;  // 7e-6 of it lies beyond
    const int half = static_cast<int>(std::ceil(reach * (2 * phase + 5) / (2 * pi)));
    GaussianNodes nodes;
    double sum = 0;
    for (int i = -half; i <= half; ++i) {
        const double x = reach * i / half;
        nodes.x.push_back(x);
        nodes.weight.push_back(std::exp(-0.5 * x * x));
        sum += nodes.weight.back();
    }
    for (double& weight : nodes.weight) weight /= sum;
    return nodes;
}

double gaussian_sigma(double full_width) {
    return full_width / std::sqrt(8 * std::log(2.0));
}

void set_bands(const FilmModel& film, double bandwidth_nm, FilmProblem* problem) {
    const double sigma = gaussian_sigma(bandwidth_nm);
    for (std::vector<BandNode>& band : problem->bands) {
        const BandNode centre = band[band.size() / 2];
        // d phase / d lambda = phase / lambda, a fifth more by dispersion.
        const double phase = 4 * pi * centre.material.n * film.largest_thickness_nm * 1.2 * sigma /
                             (centre.wavelength_nm * centre.wavelength_nm);
        const GaussianNodes nodes = gaussian_nodes(phase);
        band.clear();
        for (size_t i = 0; i < nodes.x.size(); ++i) {
            const double nm = centre.wavelength_nm + sigma * nodes.x[i];
            band.push_back({nm, nodes.weight[i], film.substrate.at(nm), film.material.at(nm)});
        }
    }
}

void set_spread_nodes(FilmProblem* problem) {
    const GaussianNodes nodes = gaussian_nodes(largest_phase_spread);
    problem->spread_nodes = nodes.x;
    problem->spread_weights = nodes.weight;
}

double largest_spread(const FilmProblem& problem) {
    const BandNode& shortest = problem.centre(0);
    return largest_phase_spread * shortest.wavelength_nm / (4 * pi * shortest.material.n);
}

}  // namespace drude
