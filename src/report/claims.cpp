#include "report/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/claim_figures.h"
#include "report/study_lobe.h"

namespace drude {

namespace {

Claim near_the_literature(const Study& study) {
    Claim c{"near-literature",
            "4",
            "The measured ratios, and n and k fitted to them, agree with the literature.",
            "",
            Verdict::not_tested,
            ""};
    if (study.metals.empty()) return c;
    std::vector<std::string> ratios, shares;
    size_t near = 0;
    for (const StudyMetal& metal : study.metals) {
        const double deviation = ratio_deviation(metal.measurement, metal.literature);
        near += deviation < 0.05;
        ratios.push_back(fmt::format("{} {}", metal.name, percent_text(deviation)));
        const EnvelopeShare envelope = envelope_share(metal);
        shares.push_back(fmt::format(
            "{} {} ({} {})", metal.name,
            std::isnan(envelope.share) ? std::string("–") : percent_text(envelope.share),
            envelope.sets, envelope.sets == 1 ? "set" : "sets"));
    }
    c.finding = fmt::format(
        "|ρ|² against the set compared with, rms: {}. Share of wavelengths at which n and k lie "
        "between the other published sets (– where fewer than two cover them): {}.",
        fmt::join(ratios, ", "), fmt::join(shares, ", "));
    c.verdict = near == study.metals.size() ? Verdict::holds
                : near > 0                  ? Verdict::partly
                                            : Verdict::does_not_hold;
    c.why =
        "A ratio agrees where it differs by less than 5 %; holds where all do. Published sets of "
        "one metal lie further apart than the instrument's noise, so n and k of a sample may agree "
        "with one author and be many standard deviations from the next.";
    return c;
}

// That fitted n or k lies above or below what is published: held against every other set.
Claim sign_claim(const Study& study, const char* id, const char* section, const char* folder,
                 bool n, bool fitted_below, const char* text) {
    Claim c{id, section, text, "", Verdict::not_tested, ""};
    const StudyMetal* metal = find_metal(study, folder);
    if (!metal) return c;
    std::vector<std::string> gaps;
    size_t agreed = 0;
    for (const OpticalConstants& set : metal->published) {
        const double gap = relative_gap(metal->fitted, set, n);
        if (set.name == metal->sample_set || std::isnan(gap)) continue;
        agreed += (gap < 0) == fitted_below;
        gaps.push_back(
            fmt::format("{} {}{}", set.name, gap < 0 ? "−" : "+", percent_text(std::abs(gap))));
    }
    if (gaps.empty()) return c;
    c.finding = fmt::format("Fitted {} minus that of each other published set, on average: {}.",
                            n ? "n" : "k", fmt::join(gaps, ", "));
    c.verdict = agreed == gaps.size() ? Verdict::holds
                : agreed > 0          ? Verdict::partly
                                      : Verdict::does_not_hold;
    c.why = fmt::format(
        "Holds where it lies so against every set, partly against some ({} of {} here). The sign "
        "is that between two publications, for the sample is one ({}): it says which two were "
        "compared, nothing of the metal.",
        agreed, gaps.size(), metal->sample_set);
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
        parts.push_back(fmt::format("{} {}", metal.name, percent_text(its)));
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
        percent_text(bare));
    double hidden = 0;
    if (const StudyMetal* aluminium = find_metal(study, "aluminium")) {
        const HiddenOxide oxide = hidden_oxide(aluminium->sample_set, aluminium->measurement);
        hidden = oxide.reflectance_error;
        c.finding += fmt::format(
            "; off by up to {} for aluminium under 3 nm of oxide, taken for bare, although its Ψ "
            "and Δ are met (reduced χ² {:.2g})",
            percent_text(hidden), oxide.reduced_chi2);
    }
    c.finding += ".";
    c.verdict = bare < 0.02 && hidden < 0.02 ? Verdict::holds
                : bare < 0.02                ? Verdict::partly
                                             : Verdict::does_not_hold;
    c.why =
        "Holds within 2 %. Ψ and Δ hold no absolute reflectance: it follows from n and k through a "
        "model of the surface. Under the oxide the fitted n and k are not the metal's, and still "
        "stand for what reflects.";
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
    std::vector<std::string> scans;
    for (const StudyMetal& metal : study.metals) {
        if (!metal.lobe) continue;
        const StudyLobe& lobe = *metal.lobe;
        scans.push_back(fmt::format("{} {:.5f} ± {:.1g} ({} lobe, made with {:g}: {})", metal.name,
                                    own_lobe(lobe).beta, own_sigma(lobe), lobe_name(lobe.true_lobe),
                                    lobe.true_beta, lobe_verdict_text(lobe_verdict(lobe))));
    }
    if (!scans.empty()) {
        c.finding += fmt::format(" Lobe scans yield it: {}.", fmt::join(scans, "; "));
    }
    c.why =
        "Holds if the ratio depends on β beyond rounding (1e-9). D and G stand in r_p and r_s "
        "alike and cancel: a fit returns the β it was started with. What a detector sees beside "
        "the mirror direction does hold it.";
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

std::vector<Claim> paper_claims(const Study& study) {
    std::vector<Claim> claims = {polarisation_implies_reflectance(study),
                                 near_the_literature(study)};
    claims.push_back(sign_claim(study, "copper-k-below", "4.1", "copper", false, true,
                                "Copper's fitted k lies slightly below the literature's."));
    claims.push_back(roughness_is_fitted(study));
    for (Claim& c : film_claims(study)) claims.push_back(std::move(c));
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
