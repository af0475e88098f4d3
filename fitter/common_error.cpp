#include "fitter/common_error.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

constexpr const char* header_key = "sigma_common_deg";

// The common error of an angle; zeros where none is stated.
CommonError common_at(const std::vector<CommonError>& common, double angle_deg) {
    for (const CommonError& error : common) {
        if (error.angle_deg == angle_deg) return error;
    }
    return {angle_deg, 0, 0};
}

// Takes the text up to `end` and the blanks around it off `rest`.
std::string_view take(std::string_view* rest, char end) {
    while (!rest->empty() && rest->front() == ' ') rest->remove_prefix(1);
    const size_t length = std::min(rest->find(end), rest->size());
    std::string_view word = rest->substr(0, length);
    rest->remove_prefix(std::min(length + 1, rest->size()));
    while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
    return word;
}

}  // namespace

const char* const weighed_by_common_error =
    "the rows were weighed by their noise and by sigma_common_deg of the measurement, the error "
    "that the wavelengths of an angle share";

std::vector<CommonError> common_errors(const Measurement& measurement) {
    std::vector<CommonError> common;
    const std::string text = measurement.header_value(header_key);
    std::string_view rest = text;
    rest = take(&rest, '(');
    while (!rest.empty()) {
        std::string_view entry = take(&rest, ';');
        const std::string found(entry);
        const auto angle = parse_double(take(&entry, ':'));
        const auto psi = parse_double(take(&entry, ' '));
        const auto delta = parse_double(take(&entry, '\0'));
        if (!angle || !psi || !delta || !std::isfinite(*angle) || !std::isfinite(*psi) ||
            !std::isfinite(*delta) || *psi < 0 || *delta < 0) {
            user_error(
                "{}: {}: found '{}', expected an angle of incidence and two standard deviations "
                "in degrees, as in '60: 0.025 0.011; 70: 0.025 0.008'; without this line rows "
                "are weighed by their own standard deviations",
                measurement.file, header_key, found);
        }
        common.push_back({*angle, *psi, *delta});
    }
    return common;
}

Measurement with_common_error(Measurement measurement, const std::vector<CommonError>& common) {
    for (MeasurementRow& row : measurement.rows) {
        if (!(row.sigma_psi_deg > 0 && row.sigma_delta_deg > 0)) continue;
        const CommonError error = common_at(common, row.angle_deg);
        row.sigma_psi_deg = std::hypot(row.sigma_psi_deg, error.sigma_psi_deg);
        row.sigma_delta_deg = std::hypot(row.sigma_delta_deg, error.sigma_delta_deg);
    }
    return measurement;
}

double chi2_common_scatter(const Measurement& noise_alone, const std::vector<CommonError>& common) {
    double share = 0;
    for (const MeasurementRow& row : noise_alone.rows) {
        const CommonError e = common_at(common, row.angle_deg);
        const auto part = [](double shared, double noise) {
            return noise > 0 ? shared * shared / (shared * shared + noise * noise) : 0;
        };
        share += (part(e.sigma_psi_deg, row.sigma_psi_deg) +
                  part(e.sigma_delta_deg, row.sigma_delta_deg)) /
                 (2 * static_cast<double>(noise_alone.rows.size()));
    }
    const double draws = 2 * static_cast<double>(noise_alone.angles().size()) - 2;
    return share * std::sqrt(2 / std::max(1.0, draws));
}

double chi2_slack(const Measurement& noise_alone, const std::vector<CommonError>& common,
                  double dof) {
    return 4 * (std::sqrt(2 / std::max(1.0, dof)) + chi2_common_scatter(noise_alone, common));
}

double chi2_by_common_error(const Measurement& noise_alone,
                            const std::vector<CommonError>& common) {
    double sum = 0, rows = 0;
    for (const MeasurementRow& row : noise_alone.rows) {
        if (!(row.sigma_psi_deg > 0 && row.sigma_delta_deg > 0)) continue;
        const CommonError e = common_at(common, row.angle_deg);
        sum += (std::pow(e.sigma_psi_deg / row.sigma_psi_deg, 2) +
                std::pow(e.sigma_delta_deg / row.sigma_delta_deg, 2)) /
               2;
        ++rows;
    }
    return 1 + sum / std::max(1.0, rows);
}

}  // namespace drude
