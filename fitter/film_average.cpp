#include "fitter/film_average.h"

#include <cmath>

namespace drude {

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
        const AverageNodes nodes = gaussian_nodes(phase);
        band.clear();
        for (size_t i = 0; i < nodes.x.size(); ++i) {
            const double nm = centre.wavelength_nm + sigma * nodes.x[i];
            band.push_back({nm, nodes.weight[i], film.substrate.at(nm), film.material.at(nm)});
        }
    }
}

void set_spread_nodes(FilmProblem* problem) {
    const AverageNodes nodes = gaussian_nodes(largest_phase_spread);
    problem->spread_nodes = nodes.x;
    problem->spread_weights = nodes.weight;
}

double largest_spread(const FilmProblem& problem) {
    const BandNode& shortest = problem.centre(0);
    return largest_phase_spread * shortest.wavelength_nm / (4 * pi * shortest.material.n);
}

}  // namespace drude
