// How often do lobe scans tell which lobe they come from?
//
//     lobe_ties [DRAWS [WAVELENGTHS]]
//
// Scans of tests/fitter/lobe_cases.h: 60 degrees, the detector from 30 to 85 by 1, s and p with 2 %
// noise, a free scale for every wavelength; seeds 1 to DRAWS (1000) for every lobe and beta, one
// wavelength or several from 400 nm by 5 nm. Prints in which fraction the true lobe is in the tie,
// stands alone, or a wrong one stands alone, and how the scatter of beta compares with its sigma.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/executor.h"
#include "base/numbers.h"
#include "fitter/lobe_cases.h"

int main(int argc, char** argv) {
    using namespace drude;
    uint64_t numbers[] = {1000, 1};
    for (int i = 1; i < argc; ++i) {
        const auto number = parse_unsigned(argv[i]);
        if (i > 2 || !number || *number < 1 || *number > 100000) {
            fmt::print(stderr, "expected lobe_ties [DRAWS [WAVELENGTHS]]\n");
            return 2;
        }
        numbers[i - 1] = *number;
    }
    const size_t draws = numbers[0];
    std::vector<double> wavelengths;
    for (uint64_t i = 0; i < numbers[1]; ++i) {
        wavelengths.push_back(400 + 5 * static_cast<double>(i));
    }
    const Material metal = find_material("Cu-McPeak");
    fmt::print("{:<18}{:>6}{:>9}{:>9}{:>13}{:>12}{:>9}\n", "lobe", "beta", "in tie", "alone",
               "wrong alone", "sigma", "scatter");
    for (const double beta : {0.15, 0.2, 0.3, 0.5}) {
        for (const Lobe lobe : all_lobes) {
            struct Draw {
                bool tied = false, alone = false, wrong = false;
                double beta = 0, sigma = 0;
            };
            std::vector<Draw> results(draws);
            parallel_for(draws, 0, [&](size_t i) {
                const LobeFitResult fit = fit_lobes(scan_of(lobe, beta, wavelengths, i + 1), metal);
                const FittedLobe& own = result_for(fit, lobe);
                const bool single = !fit.lobes[1].tied;
                results[i] = {own.tied, own.tied && single, !own.tied && single, own.beta,
                              own.sigma_beta};
            });
            double tied = 0, alone = 0, wrong = 0, sigma = 0, square = 0;
            for (const Draw& draw : results) {
                tied += draw.tied;
                alone += draw.alone;
                wrong += draw.wrong;
                sigma += draw.sigma;
                square += (draw.beta - beta) * (draw.beta - beta);
            }
            const double count = static_cast<double>(draws);
            fmt::print("{:<18}{:>6}{:>9.3f}{:>9.3f}{:>13.3f}{:>12.6f}{:>9.3f}\n", lobe_name(lobe),
                       beta, tied / count, alone / count, wrong / count, sigma / count,
                       std::sqrt(square / count) / (sigma / count));
        }
    }
    return 0;
}
