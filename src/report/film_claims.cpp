// The claims of section 4.2, about anodised aluminium.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fitter/common_error.h"
#include "report/claim_figures.h"
#include "report/claims.h"

namespace drude {

namespace {

Claim substrate_claim() {
    Claim c{"aluminium-index",
            "4.2",
            "At 550 nm aluminium has n = 0.11945, k = 2.26534 (the substrate below the film).",
            "",
            Verdict::not_tested,
            ""};
    double low_n = 1e9, high_n = 0, low_k = 1e9, high_k = 0;
    int sets = 0;
    for (const OpticalConstants& set : published_sets()) {
        if (set.material != "Al" || !set.covers(550, 550)) continue;
        ++sets;
        const Index at = set.at(550);
        low_n = std::min(low_n, at.n), high_n = std::max(high_n, at.n);
        low_k = std::min(low_k, at.k), high_k = std::max(high_k, at.k);
    }
    constexpr double n = 0.11945, k = 2.26534;
    const bool n_inside = n >= low_n && n <= high_n, k_inside = k >= low_k && k <= high_k;
    c.finding = fmt::format("{} published sets at 550 nm: n {:.3g} to {:.3g}, k {:.3g} to {:.3g}.",
                            sets, low_n, high_n, low_k, high_k);
    c.verdict = n_inside && k_inside   ? Verdict::holds
                : n_inside || k_inside ? Verdict::partly
                                       : Verdict::does_not_hold;
    c.why =
        "Holds inside these ranges. The printed pair is near that of aluminium in the ultraviolet, "
        "or of silver near 420 nm.";
    return c;
}

}  // namespace

std::vector<Claim> film_claims(const Study& study) {
    Claim swings{"film-oscillates",
                 "4.2",
                 "Ψ and Δ of anodised aluminium oscillate over the visible range; aluminium "
                 "without the thick film does not.",
                 "",
                 Verdict::not_tested,
                 ""};
    Claim layer{"film-explains",
                "4.2",
                "A bare surface cannot be fitted to it; a film of about 3 µm on aluminium can.",
                "",
                Verdict::not_tested,
                ""};
    Claim plain{"foil-follows",
                "4.2",
                "Aluminium with a much thinner oxide follows the predicted ratio.",
                "",
                Verdict::not_tested,
                ""};
    const StudyMetal* aluminium = find_metal(study, "aluminium");
    if (study.film && aluminium) {
        const StudyFilm& film = *study.film;
        // Five standard deviations of the noisiest reading apart, an extreme is no noise.
        double noisiest = 0;
        for (const Measurement* measurement : {&film.measurement, &aluminium->measurement}) {
            for (const MeasurementRow& row : measurement->rows) {
                noisiest = std::max(noisiest, row.sigma_psi_deg);
            }
        }
        const double least = 5 * noisiest;
        const int with = turning_points(psi_at(film.measurement, 60), least);
        const int without = turning_points(psi_at(aluminium->measurement, 60), least);
        swings.finding =
            fmt::format("Turning points of Ψ at 60°: {} with the film, {} without.", with, without);
        swings.verdict = with >= 6 && without <= 2 ? Verdict::holds
                         : with > without          ? Verdict::partly
                                                   : Verdict::does_not_hold;
        swings.why =
            "Counted where Ψ turns by more than five standard deviations of the noisiest reading; "
            "holds from six with and "
            "at most two without. Light reflected at the film's two faces interferes: the fringes "
            "are as many as the film is optical half-waves thick.";

        const double slack = chi2_slack(film.measurement, film.capture.common, film.film_dof);
        std::string found;
        for (const StudyParameter& p : film.parameters) {
            found += fmt::format("; {} {:.6g}{}{}, made with {:g}", p.name, p.value,
                                 std::isfinite(p.sigma) ? fmt::format(" ± {:.2g}", p.sigma) : "",
                                 p.unit.empty() ? "" : " " + p.unit, p.truth);
        }
        layer.finding = fmt::format("Reduced χ² of the bare surface {:.4g}, of the film {:.4g}{}.",
                                    film.bare_chi2, film.film_chi2, found);
        const bool explained = std::abs(film.film_chi2 - 1) < slack;
        layer.verdict = film.bare_chi2 > 10 && explained ? Verdict::holds
                        : explained                      ? Verdict::partly
                                                         : Verdict::does_not_hold;
        const size_t angles = film.measurement.angles().size();
        layer.why = fmt::format(
            "Holds where the film's χ² is 1 within four times its scatter and the bare surface's "
            "beyond 10. A fit point by point has two numbers a wavelength for {} readings, which "
            "a fringe pattern at {} angles contradicts.",
            2 * angles, angles);

        const double ours = ratio_deviation(aluminium->measurement, aluminium->literature);
        const double theirs = ratio_deviation(film.measurement, published_set(film.substrate_set));
        plain.finding = fmt::format(
            "|ρ|² differs from bare aluminium's by {} (rms) without the film, by {} with it.",
            percent_text(ours), percent_text(theirs));
        plain.verdict = ours < 0.05 && ours < theirs / 3 ? Verdict::holds
                        : ours < theirs                  ? Verdict::partly
                                                         : Verdict::does_not_hold;
        plain.why =
            "Holds below 5 % and a third of the film's. The sample has no oxide at all: one of "
            "3 nm is tested with the claim of section 1.";
    }
    return {swings, layer, plain, substrate_claim()};
}

}  // namespace drude
