#include "fitter/fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/dispersion_choice.h"
#include "fitter/dispersion_fit.h"
#include "fitter/film_fit.h"
#include "fitter/fit_data.h"
#include "fitter/model_ladder.h"
#include "fitter/offset_fit.h"
#include "fitter/point_fit.h"
#include "fitter/robust_fit.h"
#include "fitter/roughness.h"

namespace drude {

namespace {

Estimator parse_estimator(const std::string& name) {
    const auto& names = estimator_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        user_error("found the estimator '{}'{}, expected {}", name, did_you_mean(name, names),
                   fmt::join(names, ", "));
    }
    return static_cast<Estimator>(found - names.begin());
}

// That the model has what it needs and nothing else was asked for.
void check_structure(const FitOptions& options) {
    if (options.model == "auto") {
        if (options.estimator == "inversion") {
            user_error(
                "the model auto compares chi-squares that were minimised, found the estimator "
                "inversion; expected psi-delta or rho2");
        }
        if (options.fit_angle_offset) {
            user_error(
                "the model auto tries an angle offset by itself: leave --angle-offset out, or "
                "name a model");
        }
        return;
    }
    const bool film = options.model == "film", overlayer = options.model == "overlayer";
    if (overlayer == options.overlayers.empty()) {
        user_error("{}", overlayer
                             ? "the model overlayer takes a layer of known material and thickness, "
                               "found none (--overlayer Al2O3-Malitson-o,3)"
                             : "a layer of known thickness is given: it belongs to the model "
                               "'overlayer'");
    }
    for (const FilmLayer& layer : options.overlayers) {
        layer.constants.check();
        if (!(layer.thickness_nm >= 0 && std::isfinite(layer.thickness_nm))) {
            user_error("found an overlayer of {} nm, expected a finite number of at least 0",
                       layer.thickness_nm);
        }
    }
    if (!options.film.substrate.wavelength_nm.empty() && !film) {
        user_error("a known substrate is given: it belongs to the model 'film'");
    }
    if ((film || overlayer) && options.estimator == "inversion") {
        user_error(
            "the estimator inversion solves a bare surface only, found the model '{}'; "
            "expected psi-delta or rho2",
            options.model);
    }
    if (!options.dispersion.empty() && (film || options.estimator == "inversion")) {
        user_error("{}", film ? "the model film takes n and k of its materials as known, found a "
                                "dispersion too; expected it with bulk, overlayer or auto"
                              : "the estimator inversion solves every wavelength by itself, found "
                                "a dispersion; expected psi-delta or rho2");
    }
    if (!film) return;
    if (options.film.substrate.wavelength_nm.empty()) {
        user_error("the model film takes a known substrate, found none (--substrate Al-Rakic)");
    }
    options.film.substrate.check();
    options.film.material.check();
    const auto& porosity = options.film.porosity;
    if (porosity && !(*porosity >= 0 && *porosity <= 0.95)) {
        user_error("found a porosity of {}, expected a volume fraction from 0 to 0.95", *porosity);
    }
    const double largest = options.film.largest_thickness_nm;
    if (!(largest >= 1 && largest <= 1e5)) {
        user_error("found {} nm as the largest thickness to try, expected 1 to 100000", largest);
    }
    const auto& start = options.film.start;
    if (start && !(start->thickness_nm >= 0 && start->thickness_nm <= largest &&
                   start->porosity >= 0 && start->porosity <= 0.95)) {
        user_error("found a start of {} nm with the porosity {}, expected 0 to {} nm and 0 to 0.95",
                   start->thickness_nm, start->porosity, largest);
    }
}

void check_roughness(const FitOptions& options) {
    const KnownOrFitted& roughness = options.roughness_nm;
    if (!(roughness.value >= 0 && roughness.value <= 100)) {
        user_error("found a roughness of {} nm, expected 0 to 100", roughness.value);
    }
    if (roughness.given() && options.estimator == "inversion") {
        user_error(
            "the estimator inversion solves a bare, smooth surface only, found a roughness; "
            "expected psi-delta or rho2");
    }
    if (roughness.fitted && options.model != "film" && options.model != "auto") {
        throw Error(Cause::answer_is_no,
                    "a rough layer on unknown n and k cannot be told from other n and k: give its "
                    "thickness (--roughness 3), or fit it on a film of known materials");
    }
    const KnownOrFitted& spread = options.film.spread_nm;
    const double bandwidth = options.film.bandwidth_nm;
    if (!(spread.value >= 0 && spread.value <= 1000)) {
        user_error("found a thickness spread of {} nm, expected 0 to 1000", spread.value);
    }
    if (!(bandwidth >= 0 && bandwidth <= 50)) {
        user_error("found a bandwidth of {} nm, expected 0 to 50", bandwidth);
    }
    const bool film = options.model == "film" || options.model == "auto";
    if ((spread.given() || bandwidth > 0) && !film) {
        user_error("a thickness spread or a bandwidth belongs to the model 'film', found '{}'",
                   options.model);
    }
}

void check_offset(const Measurement& measurement, const FitOptions& options) {
    if (!options.fit_angle_offset) return;
    if (options.estimator == "inversion") {
        user_error(
            "the estimator inversion takes the angles as they are stated; expected psi-delta "
            "or rho2 with an angle offset");
    }
    const size_t angles = measurement.angles().size();
    if (angles < 3) {
        throw Error(Cause::answer_is_no,
                    fmt::format("a common offset of the angles of incidence takes three angles or "
                                "more, found {}: with fewer, n and k take it up",
                                angles));
    }
}

void check_options(const FitOptions& options) {
    const auto& models = fit_model_names();
    if (std::find(models.begin(), models.end(), options.model) == models.end()) {
        user_error("found the model '{}'{}, expected {}", options.model,
                   did_you_mean(options.model, models), fmt::join(models, ", "));
    }
    for (const double sigma : {options.default_sigma_psi_deg, options.default_sigma_delta_deg}) {
        if (!(sigma > 0 && std::isfinite(sigma))) {
            user_error("found a standard deviation of {} degrees, expected one above 0", sigma);
        }
    }
    if (!(options.first_nm < options.last_nm)) {
        user_error("found the wavelengths {} to {} nm, expected the first below the last",
                   options.first_nm, options.last_nm);
    }
    check_structure(options);
    check_roughness(options);
    if (!options.lobe.empty()) {
        throw Error(Cause::answer_is_no,
                    "Psi and Delta hold nothing about the lobe '" + options.lobe +
                        "' or its roughness beta: the facet distribution D and the masking G "
                        "multiply r_p and r_s alike and cancel in r_p/r_s = tan(Psi) exp(i Delta), "
                        "so the Jacobian's column of beta is zero. beta takes a lobe scan: "
                        "reflectance against the detector's offset from the mirror direction.");
    }
}

std::string wavelength_list(const std::vector<double>& wavelengths) {
    std::string list;
    for (size_t i = 0; i < wavelengths.size() && i < 5; ++i) {
        list += fmt::format("{}{}", i > 0 ? ", " : "", wavelengths[i]);
    }
    if (wavelengths.size() > 5) list += ", ...";
    return list + " nm";
}

// Weights that say nothing of the noise: the residuals themselves say how large it is.
void scale_sigmas(FitResult* result) {
    const double scale = std::sqrt(result->chi2_reduced());
    for (FittedPoint& point : result->points) {
        point.sigma_n *= scale;
        point.sigma_k *= scale;
    }
    for (FittedParameter& parameter : result->common) parameter.sigma *= scale;
}

void warn_about_result(FitResult* result, const FitOptions& options) {
    std::map<std::string, std::vector<double>> refused;
    std::vector<double> bounded, vague, rough;
    const bool by_points = result->model != "film" && result->dispersion.empty();
    for (const FittedPoint& point : result->points) {
        if (!point.identifiable) {
            refused[point.reason].push_back(point.wavelength_nm);
            continue;
        }
        if (point.at_bound) bounded.push_back(point.wavelength_nm);
        if (point.sigma_n > point.n || (point.k > 0 && point.sigma_k > point.k)) {
            vague.push_back(point.wavelength_nm);
        } else if (by_points && understates_errors(point, parse_estimator(options.estimator))) {
            rough.push_back(point.wavelength_nm);
        }
    }
    for (const auto& [reason, wavelengths] : refused) {
        result->warnings.push_back(fmt::format("no n and k at {} of {} wavelengths ({}): {}",
                                               wavelengths.size(), result->points.size(),
                                               wavelength_list(wavelengths), reason));
    }
    if (!bounded.empty()) {
        result->warnings.push_back(
            fmt::format("k (or n) ends at its lower bound at {} of {} wavelengths ({}): a "
                        "transparent material, "
                        "a film, or the wrong sign of Delta",
                        bounded.size(), result->points.size(), wavelength_list(bounded)));
    }
    if (!vague.empty()) {
        result->warnings.push_back(
            fmt::format("a standard deviation exceeds its value at {} of {} wavelengths ({})",
                        vague.size(), result->points.size(), wavelength_list(vague)));
    }
    if (!rough.empty()) {
        result->warnings.push_back(fmt::format(
            "a standard deviation is above a tenth of n or k at {} of {} wavelengths ({}): tan^2 "
            "Psi "
            "alone scatters them by more than it says (--profile shows how far; --estimator "
            "psi-delta takes Delta as well)",
            rough.size(), result->points.size(), wavelength_list(rough)));
    }
    for (const FittedParameter& parameter : result->common) {
        if (!parameter.identifiable) {
            result->warnings.push_back(fmt::format(
                "the data do not determine the {}: it is not reported", parameter.name));
        } else if (parameter.at_bound) {
            result->warnings.push_back(fmt::format("the {} ends at the bound {:.6g} of its range",
                                                   parameter.name, parameter.value));
        }
    }
    if (result->dof() <= 0) {
        result->warnings.emplace_back(
            "as many parameters as data: they cannot contradict the model, there is no reduced "
            "chi-square");
        return;
    }
    if (options.unweighted) return;
    const double reduced = result->chi2_reduced();
    const double scatter = 3 * chi2_scatter(*result, options);
    if (reduced > 1 + scatter) {
        result->warnings.push_back(fmt::format(
            "reduced chi-square {:.3g}, expected 1 +- {:.2g}: {}a film, roughness, a wrong angle "
            "of incidence, or standard deviations stated too small",
            reduced, scatter,
            result->dispersion.empty() ? "" : "a formula that the constants do not follow, "));
    }
}

}  // namespace

const std::vector<std::string>& estimator_names() {
    // In the order of Estimator.
    static const std::vector<std::string> names = {"psi-delta", "rho2", "inversion"};
    return names;
}

const std::vector<std::string>& fit_model_names() {
    static const std::vector<std::string> names = {"bulk", "overlayer", "film", "auto"};
    return names;
}

double chi2_scatter(const FitResult& result, const FitOptions& options) {
    if (result.dof() <= 0) return std::numeric_limits<double>::quiet_NaN();
    return std::sqrt(2.0 / result.dof()) + options.chi2_common_scatter;
}

double noise_variance(const FitResult& result, const FitOptions& options) {
    return options.unweighted && result.dof() > 0 ? result.chi2_reduced() : 1;
}

FitResult fit_measurement(const Measurement& measurement, const FitOptions& options) {
    const Estimator estimator = parse_estimator(options.estimator);
    check_options(options);
    measurement.check();
    check_offset(measurement, options);
    if (options.robust != "none") return fit_robust(measurement, options);
    if (options.model == "auto") return fit_ladder(measurement, options);
    if (options.model == "film") return fit_film(measurement, options);
    if (options.dispersion == "auto") return fit_dispersion_if_it_holds(measurement, options);
    FitResult result;
    result.estimator = options.estimator;
    result.model = options.model;
    result.layers = options.overlayers;
    result.warnings = data_warnings(measurement, options);

    const std::vector<WavelengthData> groups = group_by_wavelength(measurement, options);
    result.points.resize(groups.size());
    for (const FilmLayer& layer : options.overlayers) {
        const std::string warning = layer.constants.range_warning(groups.front().wavelength_nm,
                                                                  groups.back().wavelength_nm);
        if (!warning.empty()) result.warnings.push_back(warning);
    }
    if (!options.dispersion.empty()) {
        DispersionFit fit =
            fit_dispersion(groups, estimator, options.dispersion, options.dispersion_start,
                           options.fit_angle_offset, options.unweighted, options.threads);
        result.dispersion = fit.name;
        result.dispersion_parameters = std::move(fit.values);
        result.points = std::move(fit.points);
        result.parameters = static_cast<int>(fit.parameters.size());
        result.common = std::move(fit.parameters);
        result.common_correlation = std::move(fit.correlation);
        result.condition = fit.condition;
        result.ladder = std::move(fit.ladder);
        result.starts = fit.starts;
        result.chi2 = fit.chi2;
        result.data = fit.data;
    } else if (options.fit_angle_offset) {
        OffsetFit fit = fit_with_offset(groups, estimator, options.threads);
        result.points = std::move(fit.points);
        result.common = {fit.offset};
        result.common_correlation = {1};
        result.parameters = 1;
    } else {
        parallel_for(groups.size(), options.threads,
                     [&](size_t i) { result.points[i] = fit_point(groups[i], estimator); });
    }

    for (size_t i = 0; i < groups.size() && options.dispersion.empty(); ++i) {
        FittedPoint& point = result.points[i];
        // Unweighted, the standard deviations are in units that only the residuals will tell.
        if (!options.unweighted) refuse_if_unknown(groups[i], estimator, &point);
        if (!point.identifiable) continue;
        result.chi2 += point.chi2;
        result.data += point.data;
        result.parameters += 2;
        result.starts.refined += point.starts.refined;
        result.starts.in_best += point.starts.in_best;
    }
    if (!options.dispersion.empty() && !options.unweighted) {
        if (hold_nothing(groups, estimator)) {
            throw Error(Cause::answer_is_no, fmt::format("no fit: {}", normal_incidence_reason));
        }
        for (FittedPoint& point : result.points) refuse_if_vague(&point);
    }
    if (options.unweighted && result.dof() > 0) {
        scale_sigmas(&result);
        for (FittedPoint& point : result.points) refuse_if_vague(&point);
    }
    const bool any = std::any_of(result.points.begin(), result.points.end(),
                                 [](const FittedPoint& point) { return point.identifiable; });
    if (!any) {
        throw Error(Cause::answer_is_no,
                    fmt::format("{}: no fit: at none of the {} wavelengths do the data determine n "
                                "and k ({})",
                                measurement.file.empty() ? "measurement" : measurement.file,
                                result.points.size(), result.points.front().reason));
    }
    if (options.roughness_nm.value > 0) {
        OpticalConstants surface = result.constants();
        surface.name = "the fitted surface";
        result.layers.push_back(roughness_layer(surface, options.roughness_nm.value));
    }
    warn_about_result(&result, options);
    return result;
}

}  // namespace drude
