// How often do lobe scans tell which lobe they come from?
//
//     lobe_ties [DRAWS [WAVELENGTHS [BETA]]]
//
// Scans of tests/fitter/lobe_cases.h: 60 degrees, the detector from 30 to 85 by 1, s and p with 2 %
// noise, a free scale for every wavelength; seeds 1 to DRAWS (1000) for every lobe and beta (0.15,
// 0.2, 0.3, 0.5), one wavelength or several from 400 nm by 5 nm. Prints
//   D: chi-square of the nearest wrong lobe fitted to the scan without noise;
//   in which fraction the true lobe is in the tie, stands alone, or a wrong one stands alone:
//   within 6 of the best chi-square, and within lobe_tie of it, which is what the program says; how
//   the scatter of beta compares with its sigma.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/executor.h"
#include "base/numbers.h"
#include "fitter/lobe_cases.h"

namespace {

using namespace drude;

// Of one draw 0 or 1 each; of many their sums.
struct Verdict {
    double tied = 0, alone = 0, wrong = 0;
    void add(const Verdict& other) {
        tied += other.tied;
        alone += other.alone;
        wrong += other.wrong;
    }
};

Verdict verdict_of(const LobeFitResult& fit, const FittedLobe& own, double tie) {
    const double best = fit.lobes[0].chi2;
    const bool tied = own.chi2 - best <= tie, single = fit.lobes[1].chi2 - best > tie;
    return {tied ? 1.0 : 0.0, tied && single ? 1.0 : 0.0, !tied && single ? 1.0 : 0.0};
}

struct Draw {
    Verdict narrow, said;
    double beta = 0, sigma = 0;
};

}  // namespace

int main(int argc, char** argv) {
    uint64_t numbers[] = {1000, 1};
    std::vector<double> betas = {0.15, 0.2, 0.3, 0.5};
    bool understood = argc <= 4;
    for (int i = 1; i < argc && understood; ++i) {
        if (i == 3) {
            const auto beta = parse_double(argv[i]);
            understood = beta && *beta >= 0.01 && *beta <= largest_beta;
            if (understood) betas = {*beta};
        } else {
            const auto number = parse_unsigned(argv[i]);
            understood = number && *number >= 1 && *number <= 100000;
            if (understood) numbers[i - 1] = *number;
        }
    }
    if (!understood) {
        fmt::print(stderr,
                   "expected lobe_ties [DRAWS [WAVELENGTHS [BETA]]], BETA from 0.01 to {}\n",
                   largest_beta);
        return 2;
    }
    const size_t draws = numbers[0];
    std::vector<double> wavelengths;
    for (uint64_t i = 0; i < numbers[1]; ++i) {
        wavelengths.push_back(400 + 5 * static_cast<double>(i));
    }
    const Material metal = find_material("Cu-McPeak");
    fmt::print(
        "{:<18}{:>6}{:>10}  within 6:{:>7}{:>7}{:>7}  within {:g}:{:>7}{:>7}{:>7}{:>11}{:>9}\n",
        "lobe", "beta", "D", "tie", "alone", "wrong", lobe_tie, "tie", "alone", "wrong", "sigma",
        "scatter");
    for (const double beta : betas) {
        for (const Lobe lobe : all_lobes) {
            std::vector<Draw> results(draws);
            parallel_for(draws, 0, [&](size_t i) {
                const LobeFitResult fit = fit_lobes(scan_of(lobe, beta, wavelengths, i + 1), metal);
                const FittedLobe& own = result_for(fit, lobe);
                results[i].narrow = verdict_of(fit, own, 6);
                results[i].said = verdict_of(fit, own, lobe_tie);
                results[i].beta = own.beta;
                results[i].sigma = own.sigma_beta;
            });
            const LobeFitResult clean = fit_lobes(scan_of(lobe, beta, wavelengths, 0), metal);
            Verdict narrow, said;
            double sigma = 0, square = 0;
            for (const Draw& draw : results) {
                narrow.add(draw.narrow);
                said.add(draw.said);
                sigma += draw.sigma;
                square += (draw.beta - beta) * (draw.beta - beta);
            }
            const double count = static_cast<double>(draws);
            fmt::print(
                "{:<18}{:>6}{:>10.3g}           {:>7.3f}{:>7.3f}{:>7.3f}            "
                "{:>7.3f}{:>7.3f}"
                "{:>7.3f}{:>11.6f}{:>9.3f}\n",
                lobe_name(lobe), beta, clean.lobes[1].chi2, narrow.tied / count,
                narrow.alone / count, narrow.wrong / count, said.tied / count, said.alone / count,
                said.wrong / count, sigma / count, std::sqrt(square / count) / (sigma / count));
        }
    }
    return 0;
}
