// How many of a thousand random anodised films does the fit find from no start value?
//
//     film_recovery [FIRST_SEED LAST_SEED]
//
// Thickness uniform in 0.6 to 6 um, porosity in 0.01 to 0.4, 380 to 750 nm by 2 nm at 60 and 70
// degrees, noise of 0.05 and 0.1 degrees: the cases of tests/fitter/film_test.cpp, seeds 1 to 1000.
// Prints the cases that were missed and the fraction that was found within 0.5 % in thickness.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "base/numbers.h"
#include "fitter/film_cases.h"
#include "fitter/fit.h"

int main(int argc, char** argv) {
    using namespace drude;
    uint64_t first = 1, last = 1000;
    if (argc == 3) {
        const auto from = parse_unsigned(argv[1]), to = parse_unsigned(argv[2]);
        if (!from || !to || *from < 1 || *to < *from) {
            fmt::print(stderr, "expected film_recovery FIRST_SEED LAST_SEED, both from 1\n");
            return 2;
        }
        first = *from;
        last = *to;
    } else if (argc != 1) {
        fmt::print(stderr, "expected film_recovery [FIRST_SEED LAST_SEED]\n");
        return 2;
    }
    FitOptions options = anodised_options();
    uint64_t found = 0, within_1 = 0;
    double seconds = 0;
    for (uint64_t seed = first; seed <= last; ++seed) {
        const FilmCase film = random_film_case(seed);
        const Measurement data = measured_film(film.thickness_nm, film.porosity, seed);
        const auto begin = std::chrono::steady_clock::now();
        const FitResult fit = fit_measurement(data, options);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        seconds += spent.count();
        const FittedParameter& thickness = fit.common[0];
        const double error = thickness.value - film.thickness_nm;
        if (std::abs(error) < thickness.sigma) ++within_1;
        if (std::abs(error) < 0.005 * film.thickness_nm) {
            ++found;
        } else {
            fmt::print(
                "seed {}: {:.2f} nm, porosity {:.4f}: found {:.2f} +- {:.2g} nm, {:.4f}, "
                "reduced chi-square {:.4g}\n",
                seed, film.thickness_nm, film.porosity, thickness.value, thickness.sigma,
                fit.common[1].value, fit.chi2_reduced());
        }
    }
    const double cases = static_cast<double>(last - first + 1);
    fmt::print(
        "{} of {} within 0.5 % ({:.4f}); {:.1f} % within one standard deviation; "
        "{:.1f} ms a fit\n",
        found, last - first + 1, static_cast<double>(found) / cases,
        100 * static_cast<double>(within_1) / cases, 1000 * seconds / cases);
    return 0;
}
