#include "report/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/claim_figures.h"

namespace drude {

namespace {

std::string percent(double share) {
    return std::abs(share) < 0.1 && share != 0 ? fmt::format("{:.2g} %", 100 * share)
                                               : fmt::format("{:.0f} %", 100 * share);
}

Claim near_the_literature(const Study& study) {
    Claim c{"near-literature",
            "4",
            "The measured ratios, and n and k fitted to them, agree with the literature.",
            "",
            Verdict::not_tested,
            ""};
    std::vector<std::string> parts;
    int inside = 0, tested = 0;
    double largest = 0;
    for (const StudyMetal& metal : study.metals) {
        const EnvelopeShare envelope = envelope_share(metal);
        if (std::isnan(envelope.share)) continue;
        ++tested;
        inside += envelope.share >= 0.9;
        largest = std::max(largest, ratio_deviation(metal.measurement, metal.literature));
        parts.push_back(fmt::format("{} {} ({} {})", metal.name, percent(envelope.share),
                                    envelope.sets, envelope.sets == 1 ? "set" : "sets"));
    }
    if (tested == 0) return c;
    c.finding = fmt::format(
        "Share of wavelengths at which n and k lie within the other published sets: {}. |ρ|² "
        "differs from the set compared with by up to {} (rms).",
        fmt::join(parts, ", "), percent(largest));
    c.verdict = inside == tested ? Verdict::holds
                : inside > 0     ? Verdict::partly
                                 : Verdict::does_not_hold;
    c.why =
        "Holds for a metal where 90 % of the wavelengths are inside. Published sets of one metal "
        "lie further apart than the instrument's noise, so a sample may agree with one author and "
        "be many standard deviations from the next.";
    return c;
}

Claim sign_claim(const Study& study, const char* id, const char* section, const char* folder,
                 bool n, bool fitted_below, const char* text) {
    Claim c{id, section, text, "", Verdict::not_tested, ""};
    const StudyMetal* metal = find_metal(study, folder);
    if (!metal) return c;
    const SignedGap gap = signed_gap(*metal, n);
    c.finding = fmt::format(
        "Fitted {} is {} {} the literature's ({}) on average, and below it at {} of the "
        "wavelengths.",
        n ? "n" : "k", percent(std::abs(gap.relative)), gap.relative < 0 ? "below" : "above",
        metal->literature_set, percent(gap.below));
    const double agreed = fitted_below ? gap.below : 1 - gap.below;
    const bool sign = fitted_below == (gap.relative < 0);
    c.verdict = sign && agreed >= 0.5   ? Verdict::holds
                : sign || agreed >= 0.5 ? Verdict::partly
                                        : Verdict::does_not_hold;
    c.why = fmt::format(
        "Holds where the mean and most wavelengths have that sign. Here the sign is that between "
        "two publications, {} and {}: it says which two were compared, nothing of the metal.",
        metal->sample_set, metal->literature_set);
    return c;
}

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
        // Five standard deviations of a reading apart, an extreme is no noise.
        const double least = 5 * film.measurement.rows.front().sigma_psi_deg;
        const int with = turning_points(psi_at(film.measurement, 60), least);
        const int without = turning_points(psi_at(aluminium->measurement, 60), least);
        swings.finding =
            fmt::format("Turning points of Ψ at 60°: {} with the film, {} without.", with, without);
        swings.verdict = with >= 6 && without <= 2 ? Verdict::holds
                         : with > without          ? Verdict::partly
                                                   : Verdict::does_not_hold;
        swings.why =
            "Counted where Ψ turns by more than five standard deviations; holds from six with and "
            "at most two without. Light reflected at the film's two faces interferes: the fringes "
            "are as many as the film is optical half-waves thick.";

        const double slack = 5 * std::sqrt(2 / std::max(1.0, film.film_dof));
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
        layer.why =
            "Holds where the film's χ² is 1 within five times its scatter and the bare surface's "
            "beyond 10. A fit point by point has two numbers a wavelength for twelve readings, "
            "which six angles of a fringe pattern contradict.";

        const double ours = ratio_deviation(aluminium->measurement, aluminium->literature);
        const double theirs = ratio_deviation(film.measurement, published_set(film.substrate_set));
        plain.finding = fmt::format(
            "|ρ|² differs from bare aluminium's by {} (rms) without the film, by {} with it.",
            percent(ours), percent(theirs));
        plain.verdict = ours < 0.05 && ours < theirs / 3 ? Verdict::holds
                        : ours < theirs                  ? Verdict::partly
                                                         : Verdict::does_not_hold;
        plain.why =
            "Holds below 5 % and a third of the film's. The sample has no oxide at all: that a "
            "native oxide of 3 nm hides in wrong n and k instead is not tested here.";
    }
    return {swings, layer, plain};
}

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

Claim gold_fits(const Study& study) {
    Claim c{"gold-accurate",     "4.3", "Gold follows the literature very accurately.", "",
            Verdict::not_tested, ""};
    const StudyMetal* gold = find_metal(study, "gold");
    if (!gold) return c;
    std::vector<std::string> parts;
    bool best = true;
    const double ours = ratio_deviation(gold->measurement, gold->literature);
    for (const StudyMetal& metal : study.metals) {
        const double its = ratio_deviation(metal.measurement, metal.literature);
        parts.push_back(fmt::format("{} {}", metal.name, percent(its)));
        best = best && its >= ours;
    }
    c.finding = fmt::format("|ρ|² against the set compared with, rms: {}.", fmt::join(parts, ", "));
    c.verdict = best ? Verdict::holds : ours < 0.02 ? Verdict::partly : Verdict::does_not_hold;
    c.why = fmt::format(
        "Holds where gold is the closest, partly below 2 %. Gold does not tarnish, so real samples "
        "agree better than others; {} and {} differ as evaporated films of two laboratories do.",
        gold->sample_set, gold->literature_set);
    return c;
}

Claim proof_coins() {
    return {"proof-coin",
            "4.3",
            "A proof silver coin's ratio drops beyond 470 nm, which the literature does not "
            "explain.",
            "No sample of the study has a surface finish.",
            Verdict::not_tested,
            "Polish is not among what optical constants describe, and the samples are made of "
            "these."};
}

std::vector<Claim> picture_claims(const Study& study) {
    Claim gold{
        "picture-gold",      "4.4", "Of the five pairs of pictures, gold's differs least.", "",
        Verdict::not_tested, ""};
    Claim most{"picture-most",      "4.4", "Aluminium's and silver's differ most.", "",
               Verdict::not_tested, ""};
    Claim subtle{"picture-subtle",    "4.4", "All differences remain subtle.", "",
                 Verdict::not_tested, ""};
    std::vector<const StudyMetal*> order;
    for (const StudyMetal& metal : study.metals) {
        if (metal.pair && metal.pair->pixels > 0) order.push_back(&metal);
    }
    if (order.size() < 3 || order.size() != study.metals.size()) return {gold, most, subtle};
    std::sort(order.begin(), order.end(), [](const StudyMetal* a, const StudyMetal* b) {
        return a->pair->mean_absolute < b->pair->mean_absolute;
    });
    std::vector<std::string> by_difference, by_eye;
    bool all_below = true, some_below = false;
    for (const StudyMetal* metal : order) {
        const PairStatistics& s = *metal->pair;
        by_difference.push_back(fmt::format("{} {:.4f}", metal->name, s.mean_absolute));
        by_eye.push_back(fmt::format("{} ΔE {:.1f} ({} of its pixels noticeable)", metal->name,
                                     s.mean_delta_e, percent(s.noticeable)));
        all_below = all_below && s.mean_delta_e < 2.3;
        some_below = some_below || s.mean_delta_e < 2.3;
    }
    gold.finding = fmt::format("Mean absolute difference of linear R, G, B on the metal: {}.",
                               fmt::join(by_difference, " < "));
    const auto rank = [&](const char* folder) {
        return std::find_if(order.begin(), order.end(),
                            [&](const StudyMetal* m) { return m->folder == folder; }) -
               order.begin();
    };
    const auto last = static_cast<std::ptrdiff_t>(order.size()) - 1;
    gold.verdict = rank("gold") == 0   ? Verdict::holds
                   : rank("gold") == 1 ? Verdict::partly
                                       : Verdict::does_not_hold;
    gold.why =
        "Holds where gold comes first, partly second. The order is that of how far the two "
        "publications of each metal are apart: with other pairs of sets it changes.";
    const bool al = rank("aluminium") >= last - 1, ag = rank("silver") >= last - 1;
    most.finding = fmt::format("Largest: {}; then {}.", order[order.size() - 1]->name,
                               order[order.size() - 2]->name);
    most.verdict = al && ag ? Verdict::holds : al || ag ? Verdict::partly : Verdict::does_not_hold;
    most.why =
        "Holds where these two come last, partly where one of them does. They reflect most, so "
        "that the same relative difference is a larger absolute one; the rest is again the choice "
        "of sets.";
    subtle.finding =
        fmt::format("Mean colour difference, pictures exposed alike: {}.", fmt::join(by_eye, "; "));
    subtle.verdict = all_below    ? Verdict::holds
                     : some_below ? Verdict::partly
                                  : Verdict::does_not_hold;
    subtle.why =
        "Subtle: a mean ΔE*ab below 2.3, which is just noticeable side by side (Mahy et al. 1994). "
        "Pictures looked at one after the other hide more than that.";
    return {gold, most, subtle};
}

Claim polarisation_implies_reflectance(const Study& study) {
    Claim c{"polarisation-implies-reflectance",
            "1",
            "Where the state of polarisation is predicted correctly, the reflectance is too.",
            "",
            Verdict::not_tested,
            ""};
    double bare = 0;
    for (const StudyMetal& metal : study.metals) {
        bare =
            std::max(bare, reflectance_error(material_from_set(published_set(metal.sample_set)),
                                             material_from_set(metal.fitted), metal.measurement));
    }
    c.finding = fmt::format(
        "(Rs + Rp)/2 from the fitted n, k against that of the sample: within {} for bare metals",
        percent(bare));
    double filmed = 0;
    if (study.film) {
        filmed = reflectance_error(study.film->sample, material_from_set(study.film->bare),
                                   study.film->measurement);
        c.finding += fmt::format("; off by up to {} where a film is taken for a bare metal",
                                 percent(filmed));
    }
    c.finding += ".";
    c.verdict = bare < 0.02 && filmed < 0.02 ? Verdict::holds
                : bare < 0.02                ? Verdict::partly
                                             : Verdict::does_not_hold;
    c.why =
        "Holds within 2 %. Ψ and Δ fix n and k, and with them the reflectance, if the model of the "
        "surface is right; a wrong model that happens to meet Ψ and Δ need not meet the "
        "reflectance.";
    return c;
}

Claim roughness_is_fitted(const Study& study) {
    Claim c{"beta-fitted",
            "4.1, Table 1",
            "Fitting the ratio yields the roughness β of each microfacet distribution.",
            "",
            Verdict::not_tested,
            ""};
    if (study.metals.empty()) return c;
    double change = 0;
    for (const StudyMetal& metal : study.metals) {
        change = std::max(change, largest_ratio_change_by_beta(metal.fitted, metal.measurement));
    }
    c.finding = fmt::format(
        "Between β = 0.05 and 1.15 the ratio in the mirror direction changes by at most {:.1e} of "
        "itself, with all four distributions.",
        change);
    c.verdict = change < 1e-9 ? Verdict::does_not_hold : Verdict::holds;
    c.why =
        "Holds if the ratio depends on β beyond rounding (1e-9). D and G stand in r_p and r_s "
        "alike and cancel: a fit returns the β it was started with.";
    return c;
}

}  // namespace

std::string verdict_text(Verdict verdict) {
    switch (verdict) {
        case Verdict::holds:
            return "holds";
        case Verdict::partly:
            return "partly";
        case Verdict::does_not_hold:
            return "does not hold";
        case Verdict::not_tested:
            break;
    }
    return "not tested";
}

int turning_points(const std::vector<double>& values, double least) {
    if (values.empty()) return 0;
    int count = 0, direction = 0;
    double low = values[0], high = values[0];  // since the last turn
    for (const double v : values) {
        low = std::min(low, v);
        high = std::max(high, v);
        if (direction >= 0 && v < high - least) {
            count += direction > 0;
            direction = -1;
            low = v;
            high = v;
        } else if (direction <= 0 && v > low + least) {
            count += direction < 0;
            direction = 1;
            low = v;
            high = v;
        }
    }
    return count;
}

std::vector<Claim> paper_claims(const Study& study) {
    std::vector<Claim> claims = {polarisation_implies_reflectance(study),
                                 near_the_literature(study)};
    claims.push_back(sign_claim(study, "copper-k-below", "4.1", "copper", false, true,
                                "Copper's fitted k lies slightly below the literature's."));
    claims.push_back(roughness_is_fitted(study));
    for (Claim& c : film_claims(study)) claims.push_back(std::move(c));
    claims.push_back(substrate_claim());
    claims.push_back(gold_fits(study));
    claims.push_back(sign_claim(study, "silver-k-below", "4.3", "silver", false, true,
                                "Silver's fitted k lies a little below the literature's."));
    claims.push_back(sign_claim(study, "silver-n-above", "4.3", "silver", true, false,
                                "Silver's fitted n lies slightly above the literature's."));
    claims.push_back(proof_coins());
    for (Claim& c : picture_claims(study)) claims.push_back(std::move(c));
    for (Claim& c : claims) {
        if (c.why.empty()) c.why = "The study holds no such sample or pictures.";
    }
    return claims;
}

}  // namespace drude
