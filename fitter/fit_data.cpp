#include "fitter/fit_data.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

std::vector<MeasurementRow> chosen_rows(const Measurement& measurement, const FitOptions& options) {
    std::vector<MeasurementRow> rows;
    for (const MeasurementRow& row : measurement.rows) {
        if (row.wavelength_nm >= options.first_nm && row.wavelength_nm <= options.last_nm) {
            rows.push_back(row);
        }
    }
    return rows;
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

std::vector<WavelengthData> group_by_wavelength(const Measurement& measurement,
                                                const FitOptions& options) {
    std::vector<MeasurementRow> rows = chosen_rows(measurement, options);
    if (rows.empty()) {
        const std::vector<double> wavelengths = measurement.wavelengths();
        user_error(
            "{}: found no row from {} to {} nm, expected some: the measurement spans {} to {}",
            measurement.file.empty() ? "measurement" : measurement.file, options.first_nm,
            options.last_nm, wavelengths.front(), wavelengths.back());
    }
    std::sort(rows.begin(), rows.end(), [](const MeasurementRow& a, const MeasurementRow& b) {
        if (a.wavelength_nm != b.wavelength_nm) return a.wavelength_nm < b.wavelength_nm;
        return a.angle_deg < b.angle_deg;
    });
    std::vector<WavelengthData> groups;
    for (const MeasurementRow& row : rows) {
        if (groups.empty() || groups.back().wavelength_nm != row.wavelength_nm) {
            groups.push_back(
                {row.wavelength_nm, {}, layers_at(options.overlayers, row.wavelength_nm),
                 options.roughness_nm.value});
        }
        double sigma_psi = 1, sigma_delta = 1;
        if (!options.unweighted) {
            sigma_psi = row.sigma_psi_deg > 0 ? row.sigma_psi_deg : options.default_sigma_psi_deg;
            sigma_delta =
                row.sigma_delta_deg > 0 ? row.sigma_delta_deg : options.default_sigma_delta_deg;
        }
        groups.back().points.push_back(
            make_angle_point(row.angle_deg, row.psi_deg, row.delta_deg, sigma_psi, sigma_delta));
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
