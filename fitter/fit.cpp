#include "fitter/fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/point_data.h"
#include "fitter/point_fit.h"

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
    if (!options.lobe.empty()) {
        throw Error(Cause::answer_is_no,
                    "Psi and Delta hold nothing about the lobe '" + options.lobe +
                        "' or its roughness beta: the facet distribution D and the masking G "
                        "multiply r_p and r_s alike and cancel in r_p/r_s = tan(Psi) exp(i Delta), "
                        "so the Jacobian's column of beta is zero. beta takes a lobe scan: "
                        "reflectance against the detector's offset from the mirror direction.");
    }
}

std::vector<WavelengthData> group_by_wavelength(const Measurement& measurement,
                                                const FitOptions& options) {
    std::vector<MeasurementRow> rows = measurement.rows;
    // Sorted by angle too, so that the order of the rows in a file does not move the last digit.
    std::sort(rows.begin(), rows.end(), [](const MeasurementRow& a, const MeasurementRow& b) {
        if (a.wavelength_nm != b.wavelength_nm) return a.wavelength_nm < b.wavelength_nm;
        return a.angle_deg < b.angle_deg;
    });
    std::vector<WavelengthData> groups;
    for (const MeasurementRow& row : rows) {
        if (groups.empty() || groups.back().wavelength_nm != row.wavelength_nm) {
            groups.push_back({row.wavelength_nm, {}});
        }
        const double sigma_psi =
            row.sigma_psi_deg > 0 ? row.sigma_psi_deg : options.default_sigma_psi_deg;
        const double sigma_delta =
            row.sigma_delta_deg > 0 ? row.sigma_delta_deg : options.default_sigma_delta_deg;
        groups.back().points.push_back(
            make_angle_point(row.angle_deg, row.psi_deg, row.delta_deg, sigma_psi, sigma_delta));
    }
    return groups;
}

void warn_about_data(const Measurement& measurement, const FitOptions& options,
                     std::vector<std::string>* warnings) {
    const auto count = [&](auto&& holds) {
        return std::count_if(measurement.rows.begin(), measurement.rows.end(), holds);
    };
    const size_t rows = measurement.rows.size();
    const auto without_sigma = count([](const MeasurementRow& row) {
        return !(row.sigma_psi_deg > 0 && row.sigma_delta_deg > 0);
    });
    if (without_sigma > 0) {
        warnings->push_back(fmt::format(
            "{} of {} rows bring no standard deviations: {} degrees in Psi and {} in Delta assumed "
            "there; those of n and k and the reduced chi-square follow from that assumption",
            without_sigma, rows, options.default_sigma_psi_deg, options.default_sigma_delta_deg));
    }
    const auto depolarised =
        count([](const MeasurementRow& row) { return row.depolarization > 0.01; });
    if (depolarised > 0) {
        warnings->push_back(fmt::format(
            "{} of {} rows are depolarised by more than 1 %, which no smooth surface does: n and k "
            "are not those of the metal alone",
            depolarised, rows));
    }
    if (options.estimator == "rho2") return;
    // Noise takes Delta of a transparent material across 0 and 180; a degree leaves that out.
    const auto opposite = count([](const MeasurementRow& row) {
        const double delta = std::remainder(row.delta_deg, 360.0);
        return delta < -1 && delta > -179;
    });
    if (2 * static_cast<size_t>(opposite) > rows) {
        warnings->push_back(fmt::format(
            "Delta lies between 180 and 360 degrees in {} of {} rows, where no bare surface has it "
            "in this project's sign: a film, or an instrument of the opposite sign (then write "
            "360 - Delta)",
            opposite, rows));
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

void warn_about_result(FitResult* result) {
    std::map<std::string, std::vector<double>> refused;
    std::vector<double> bounded, vague;
    for (const FittedPoint& point : result->points) {
        if (!point.identifiable) {
            refused[point.reason].push_back(point.wavelength_nm);
            continue;
        }
        if (point.at_bound) bounded.push_back(point.wavelength_nm);
        if (point.sigma_n > point.n || (point.k > 0 && point.sigma_k > point.k)) {
            vague.push_back(point.wavelength_nm);
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
    if (result->dof() <= 0) {
        result->warnings.push_back(
            "as many parameters as data: they cannot contradict the model, there is no reduced "
            "chi-square");
        return;
    }
    const double reduced = result->chi2_reduced();
    const double scatter = 3 * std::sqrt(2.0 / result->dof());
    if (reduced > 1 + scatter) {
        result->warnings.push_back(fmt::format(
            "reduced chi-square {:.3g}, expected 1 +- {:.2g}: a film, roughness, a wrong angle of "
            "incidence, or standard deviations stated too small",
            reduced, scatter));
    }
}

}  // namespace

const std::vector<std::string>& estimator_names() {
    // In the order of Estimator.
    static const std::vector<std::string> names = {"psi-delta", "rho2", "inversion"};
    return names;
}

const std::vector<std::string>& fit_model_names() {
    static const std::vector<std::string> names = {"bulk"};
    return names;
}

FitResult fit_measurement(const Measurement& measurement, const FitOptions& options) {
    const Estimator estimator = parse_estimator(options.estimator);
    check_options(options);
    measurement.check();
    FitResult result;
    result.estimator = options.estimator;
    result.model = options.model;
    warn_about_data(measurement, options, &result.warnings);

    const std::vector<WavelengthData> groups = group_by_wavelength(measurement, options);
    result.points.resize(groups.size());
    parallel_for(groups.size(), options.threads,
                 [&](size_t i) { result.points[i] = fit_point(groups[i], estimator); });

    for (const FittedPoint& point : result.points) {
        if (!point.identifiable) continue;
        result.chi2 += point.chi2;
        result.data += point.data;
        result.parameters += 2;
    }
    if (result.parameters == 0) {
        throw Error(Cause::answer_is_no,
                    fmt::format("{}: no fit: at none of the {} wavelengths do the data determine n "
                                "and k ({})",
                                measurement.file.empty() ? "measurement" : measurement.file,
                                result.points.size(), result.points.front().reason));
    }
    warn_about_result(&result);
    return result;
}

}  // namespace drude
