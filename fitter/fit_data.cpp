#include "fitter/fit_data.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

bool is_chosen(const MeasurementRow& row, const FitOptions& options) {
    return row.wavelength_nm >= options.first_nm && row.wavelength_nm <= options.last_nm;
}

std::vector<MeasurementRow> chosen_rows(const Measurement& measurement, const FitOptions& options) {
    std::vector<MeasurementRow> rows;
    for (const MeasurementRow& row : measurement.rows) {
        if (is_chosen(row, options)) rows.push_back(row);
    }
    return rows;
}

struct WeighedRow {
    MeasurementRow row;
    double weight = 1;
};

std::vector<WeighedRow> weighed_rows(const Measurement& measurement, const FitOptions& options) {
    const std::vector<double>& weights = options.weights;
    if (!weights.empty() && weights.size() != measurement.rows.size()) {
        user_error("found {} weights, expected one for each of the {} rows", weights.size(),
                   measurement.rows.size());
    }
    std::vector<WeighedRow> rows;
    for (size_t i = 0; i < measurement.rows.size(); ++i) {
        const double weight = weights.empty() ? 1 : weights[i];
        if (!(weight > 0 && std::isfinite(weight))) {
            user_error("found a weight of {}, expected a finite one above 0", weight);
        }
        if (is_chosen(measurement.rows[i], options)) rows.push_back({measurement.rows[i], weight});
    }
    return rows;
}

// Its squared residuals multiplied by `weight`, whatever the estimator.
AnglePoint weighed(AnglePoint point, double weight) {
    const double root = std::sqrt(weight);
    for (double& component : point.along_psi) component *= root;
    for (double& component : point.along_delta) component *= root;
    point.sigma_psi /= root;
    point.sigma_delta /= root;
    point.sigma_tan2_psi /= root;
    return point;
}

std::vector<ThinFilm<double>> layers_at(const std::vector<FilmLayer>& layers,
                                        double wavelength_nm) {
    std::vector<ThinFilm<double>> films;
    for (const FilmLayer& layer : layers) {
        const Index index = layer.constants.at(wavelength_nm);
        films.push_back({{index.n, index.k}, layer.thickness_nm});
    }
    return films;
}

}  // namespace

AnglePoint angle_point(const MeasurementRow& row, const FitOptions& options) {
    double sigma_psi = 1, sigma_delta = 1;
    if (!options.unweighted) {
        sigma_psi = row.sigma_psi_deg > 0 ? row.sigma_psi_deg : options.default_sigma_psi_deg;
        sigma_delta =
            row.sigma_delta_deg > 0 ? row.sigma_delta_deg : options.default_sigma_delta_deg;
    }
    return make_angle_point(row.angle_deg, row.psi_deg, row.delta_deg, sigma_psi, sigma_delta);
}

std::vector<WavelengthData> group_by_wavelength(const Measurement& measurement,
                                                const FitOptions& options) {
    std::vector<WeighedRow> rows = weighed_rows(measurement, options);
    if (rows.empty()) {
        const std::vector<double> wavelengths = measurement.wavelengths();
        user_error(
            "{}: found no row from {} to {} nm, expected some: the measurement spans {} to {}",
            measurement.file.empty() ? "measurement" : measurement.file, options.first_nm,
            options.last_nm, wavelengths.front(), wavelengths.back());
    }
    std::sort(rows.begin(), rows.end(), [](const WeighedRow& a, const WeighedRow& b) {
        if (a.row.wavelength_nm != b.row.wavelength_nm) {
            return a.row.wavelength_nm < b.row.wavelength_nm;
        }
        return a.row.angle_deg < b.row.angle_deg;
    });
    std::vector<WavelengthData> groups;
    for (const auto& [row, weight] : rows) {
        if (groups.empty() || groups.back().wavelength_nm != row.wavelength_nm) {
            groups.push_back({row.wavelength_nm,
                              {},
                              layers_at(options.overlayers, row.wavelength_nm),
                              options.roughness_nm.value});
        }
        groups.back().points.push_back(weighed(angle_point(row, options), weight));
    }
    return groups;
}

std::vector<std::string> data_warnings(const Measurement& measurement, const FitOptions& options) {
    std::vector<std::string> warnings;
    const std::vector<MeasurementRow> chosen = chosen_rows(measurement, options);
    const auto count = [&](auto&& holds) {
        return std::count_if(chosen.begin(), chosen.end(), holds);
    };
    const size_t rows = chosen.size();
    const auto without_sigma = count([](const MeasurementRow& row) {
        return !(row.sigma_psi_deg > 0 && row.sigma_delta_deg > 0);
    });
    if (options.unweighted) {
        warnings.push_back(
            "every row counts alike: standard deviations are those that the scatter of the "
            "residuals suggests, and chi-square is in square degrees");
    } else if (without_sigma > 0) {
        warnings.push_back(fmt::format(
            "{} of {} rows bring no standard deviations: {} degrees in Psi and {} in Delta assumed "
            "there; those of n and k and the reduced chi-square follow from that assumption",
            without_sigma, rows, options.default_sigma_psi_deg, options.default_sigma_delta_deg));
    }
    const auto depolarised =
        count([](const MeasurementRow& row) { return row.depolarization > 0.01; });
    if (depolarised > 0) {
        warnings.push_back(fmt::format(
            "{} of {} rows are depolarised by more than 1 %, which no smooth surface does: n and k "
            "are not those of the metal alone",
            depolarised, rows));
    }
    if (options.estimator == "rho2" || options.model != "bulk") return warnings;
    // Noise takes Delta of a transparent material across 0 and 180; a degree leaves that out.
    const auto opposite = count([](const MeasurementRow& row) {
        const double delta = std::remainder(row.delta_deg, 360.0);
        return delta < -1 && delta > -179;
    });
    if (2 * static_cast<size_t>(opposite) > rows) {
        warnings.push_back(fmt::format(
            "Delta lies between 180 and 360 degrees in {} of {} rows, where no bare surface has it "
            "in this project's sign: a film, or an instrument of the opposite sign (then write "
            "360 - Delta)",
            opposite, rows));
    }
    return warnings;
}

}  // namespace drude
