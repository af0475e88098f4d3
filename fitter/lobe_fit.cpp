#include "fitter/lobe_fit.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "fitter/lobe_scan_model.h"
#include "materials/microfacet.h"

namespace drude {

namespace {

using Jet = ceres::Jet<double, 1>;

// Facet angle at which D has fallen to half of D(0).
double half_height_angle(Lobe lobe, double beta) {
    const LobeDensity<double> density(lobe, beta);
    const double half = density(0.0) / 2;
    double low = 0, high = pi / 2;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2, t = std::tan(middle);
        (density(t * t) > half ? low : high) = middle;
    }
    return low;
}

// The beta of the lobe that is as wide as the cone: a facet turned by an angle turns the light by
// twice that.
double beta_of_cone(Lobe lobe, double half_angle) {
    double low = 1e-6, high = largest_beta;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (2 * half_height_angle(lobe, middle) < half_angle ? low : high) = middle;
    }
    return high;
}

// What the data of one wavelength say of their common scale, over the standard deviations:
// m the model at scale 1, d its derivative by beta, y the data.
struct Sums {
    double mm = 0, md = 0, dd = 0, ym = 0, yd = 0, yy = 0;
    // The scale that fits best; a negative one reflects nothing.
    double scale() const { return mm > 0 ? std::max(ym / mm, 0.0) : 0; }
    double chi2() const { return yy - 2 * scale() * ym + scale() * scale() * mm; }
};

// Chi-square at the best scales.
double chi2_at(const LobeScanModel& model, Lobe lobe, double beta) {
    const LobeDensity<double> density(lobe, beta);
    std::vector<double> D;
    D.reserve(model.tan2().size());
    for (const double tan2 : model.tan2()) D.push_back(density(tan2));
    const std::vector<double> seen = model.average(D);
    std::vector<Sums> sums(model.wavelength_count());
    for (size_t i = 0; i < seen.size(); ++i) {
        const LobeDatum& datum = model.data()[i];
        const double m = seen[i] / datum.sigma, y = datum.value / datum.sigma;
        Sums& s = sums[datum.wavelength];
        s.mm += m * m;
        s.ym += y * m;
        s.yy += y * y;
    }
    double chi2 = 0;
    for (const Sums& s : sums) chi2 += s.chi2();
    return chi2;
}

// The same with Gauss and Newton's slope and information in beta.
struct Profile {
    double chi2 = 0, slope = 0, information = 0, whole = 0;
};

Profile profile_at(const LobeScanModel& model, Lobe lobe, double beta) {
    const LobeDensity<Jet> density(lobe, Jet(beta, 0));
    std::vector<double> D, by_beta;
    D.reserve(model.tan2().size());
    by_beta.reserve(model.tan2().size());
    for (const double tan2 : model.tan2()) {
        const Jet value = density(Jet(tan2));
        D.push_back(value.a);
        by_beta.push_back(value.v[0]);
    }
    const std::vector<double> seen = model.average(D), seen_by_beta = model.average(by_beta);
    std::vector<Sums> sums(model.wavelength_count());
    for (size_t i = 0; i < seen.size(); ++i) {
        const LobeDatum& datum = model.data()[i];
        const double m = seen[i] / datum.sigma, d = seen_by_beta[i] / datum.sigma;
        const double y = datum.value / datum.sigma;
        Sums& s = sums[datum.wavelength];
        s.mm += m * m;
        s.md += m * d;
        s.dd += d * d;
        s.ym += y * m;
        s.yd += y * d;
        s.yy += y * y;
    }
    Profile profile;
    for (const Sums& s : sums) {
        profile.chi2 += s.chi2();
        if (!(s.mm > 0)) continue;
        const double scale = s.scale();
        const double outside = s.dd - s.md * s.md / s.mm;
        profile.information += scale * scale * std::max(outside, 0.0);
        profile.whole += scale * scale * s.dd;
        // d(residual)/d(beta) outside the span of the scale, times the residuals.
        profile.slope += scale * ((scale * s.md - s.yd) - s.md / s.mm * (scale * s.mm - s.ym));
    }
    return profile;
}

FittedLobe fit_lobe(const LobeScanModel& model, Lobe lobe, double half_angle) {
    const double cone = beta_of_cone(lobe, half_angle);
    const double lowest = std::max(cone / 4, 1e-3), highest = largest_beta;
    // A twentieth of beta at most, which no minimum is narrower than.
    const int steps = 1 + static_cast<int>(std::ceil(std::log(highest / lowest) / 0.05));
    std::vector<double> grid, chi2;
    for (int i = 0; i <= steps; ++i) {
        grid.push_back(lowest * std::pow(highest / lowest, static_cast<double>(i) / steps));
        chi2.push_back(chi2_at(model, lobe, grid.back()));
    }
    const size_t at =
        static_cast<size_t>(std::min_element(chi2.begin(), chi2.end()) - chi2.begin());
    const double low = grid[at > 0 ? at - 1 : 0], high = grid[std::min(at + 1, grid.size() - 1)];
    double beta = grid[at];
    Profile best = profile_at(model, lobe, beta);
    for (int iteration = 0; iteration < 100 && best.information > 0; ++iteration) {
        double step = -best.slope / best.information;
        if (std::abs(step) < 1e-9 * beta) break;
        bool better = false;
        for (int halving = 0; halving < 40 && !better; ++halving, step /= 2) {
            const double next = std::clamp(beta + step, low, high);
            const Profile there = profile_at(model, lobe, next);
            if (there.chi2 < best.chi2) {
                beta = next;
                best = there;
                better = true;
            }
        }
        if (!better) break;
    }
    if (!(best.information > 1e-16 * best.whole)) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("no fit: the scan does not determine the roughness of the lobe '{}' "
                        "beside the free scale; scan the detector over the lobe",
                        lobe_name(lobe)));
    }
    FittedLobe fit;
    fit.lobe = lobe;
    fit.beta = beta;
    fit.sigma_beta = 1 / std::sqrt(best.information);
    fit.chi2 = best.chi2;
    fit.narrower_than_aperture = beta < cone;
    fit.upper_bound = fit.narrower_than_aperture ? cone : 0;
    fit.at_bound = beta <= lowest * 1.0001 || beta >= highest * 0.9999;
    return fit;
}

void warn(LobeFitResult* result) {
    const FittedLobe& best = result->lobes.front();
    std::vector<std::string_view> tied;
    for (const FittedLobe& lobe : result->lobes) {
        if (lobe.tied) tied.push_back(lobe_name(lobe.lobe));
    }
    if (tied.size() > 1) {
        result->warnings.push_back(
            fmt::format("the data do not tell {} apart: each explains them to within {} in "
                        "chi-square, with a beta of its own",
                        fmt::join(tied, ", "), lobe_tie));
    }
    if (best.narrower_than_aperture) {
        result->warnings.push_back(
            fmt::format("the lobe is narrower than the detector's cone: beta is at most {:.4g}, a "
                        "smaller one is not excluded",
                        best.upper_bound));
    }
    if (best.at_bound && !best.narrower_than_aperture) {
        result->warnings.push_back(
            fmt::format("beta ends at {:.4g}, the widest lobe that is modelled", best.beta));
    }
    if (result->dof() <= 0) return;
    const double reduced = best.chi2 / result->dof(), scatter = 3 * std::sqrt(2.0 / result->dof());
    if (reduced > 1 + scatter) {
        result->warnings.push_back(
            fmt::format("reduced chi-square {:.3g} at best, expected 1 +- {:.2g}: none of the four "
                        "lobes has this shape, other n and k, or standard deviations stated too "
                        "small",
                        reduced, scatter));
    }
}

}  // namespace

LobeFitResult fit_lobes(const LobeScan& scan, const Material& metal) {
    scan.check();
    metal.check();
    const LobeScanModel model(scan, metal);
    LobeFitResult result;
    result.data = static_cast<int>(model.data().size());
    result.parameters = 1 + static_cast<int>(model.wavelength_count());
    if (result.dof() < 0) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: {} data for {} unknowns (beta, and a scale for every "
                                "wavelength); scan the detector over the lobe",
                                result.data, result.parameters));
    }
    const double half_angle = scan.detector_half_angle_deg * pi / 180;
    for (const std::string& name : lobe_names()) {
        result.lobes.push_back(fit_lobe(model, parse_lobe(name), half_angle));
    }
    std::stable_sort(result.lobes.begin(), result.lobes.end(),
                     [](const FittedLobe& a, const FittedLobe& b) { return a.chi2 < b.chi2; });
    for (FittedLobe& lobe : result.lobes) {
        lobe.tied = lobe.chi2 - result.lobes.front().chi2 <= lobe_tie;
    }
    warn(&result);
    return result;
}

void set_fitted_lobe(const LobeFitResult& result, const std::string& name, Material* material) {
    const FittedLobe* chosen = &result.lobes.front();
    if (name.empty()) {
        std::vector<std::string_view> tied;
        for (const FittedLobe& lobe : result.lobes) {
            if (lobe.tied) tied.push_back(lobe_name(lobe.lobe));
        }
        if (tied.size() > 1) {
            throw Error(
                Cause::answer_is_no,
                fmt::format("no material: the scan does not tell {} apart; name one of them "
                            "with --lobe",
                            fmt::join(tied, ", ")));
        }
    } else {
        const Lobe wanted = parse_lobe(name);
        for (const FittedLobe& lobe : result.lobes) {
            if (lobe.lobe == wanted) chosen = &lobe;
        }
        if (!chosen->tied) {
            throw Error(
                Cause::answer_is_no,
                fmt::format("no material: the scan excludes the lobe '{}', whose chi-square "
                            "is {:.4g} above that of '{}'",
                            name, chosen->chi2 - result.lobes.front().chi2,
                            lobe_name(result.lobes.front().lobe)));
        }
    }
    if (chosen->narrower_than_aperture) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("no material: the lobe is narrower than the detector's cone, beta is "
                        "at most {:.4g} and not known",
                        chosen->upper_bound));
    }
    material->lobe = chosen->lobe;
    material->masking = Masking::v_groove;
    material->beta = chosen->beta;
    for (const std::string& warning : result.warnings) {
        material->provenance.warnings.push_back(warning);
    }
    material->check();
}

}  // namespace drude
