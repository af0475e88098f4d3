#include "fitter/constants_rows.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

void check_row(const ConstantsRow& row, const std::string& file) {
    const Place place{file, row.line, 0};
    if (!(row.wavelength_nm > 0) || !std::isfinite(row.wavelength_nm)) {
        user_error_at(place, "found the wavelength {} nm, expected a finite number above 0",
                      row.wavelength_nm);
    }
    if (!(row.n > 0) || !std::isfinite(row.n)) {
        user_error_at(place, "found n = {}, expected a finite number above 0", row.n);
    }
    if (!std::isfinite(row.k)) {
        user_error_at(place, "found k = {}, expected a finite number of at least 0", row.k);
    }
    if (!(row.sigma_n >= 0) || !(row.sigma_k >= 0) || !std::isfinite(row.sigma_n) ||
        !std::isfinite(row.sigma_k)) {
        user_error_at(place, "found a standard deviation of {}, expected a finite one, 0 or more",
                      row.sigma_n >= 0 && std::isfinite(row.sigma_n) ? row.sigma_k : row.sigma_n);
    }
}

// Neighbours of the same wavelength become one row: the mean of the values, and the larger of the
// deviations, since two readings of one sample are seldom independent.
size_t join_repeats(std::vector<ConstantsRow>& rows, double* first_repeat) {
    std::vector<ConstantsRow> joined;
    size_t repeats = 0;
    for (size_t i = 0; i < rows.size();) {
        ConstantsRow mean = rows[i];
        size_t end = i + 1;
        for (; end < rows.size() && rows[end].wavelength_nm == mean.wavelength_nm; ++end) {
            const double share = 1 / static_cast<double>(end - i + 1);
            mean.n += (rows[end].n - mean.n) * share;
            mean.k += (rows[end].k - mean.k) * share;
            mean.sigma_n = std::max(mean.sigma_n, rows[end].sigma_n);
            mean.sigma_k = std::max(mean.sigma_k, rows[end].sigma_k);
        }
        if (end > i + 1 && repeats == 0) *first_repeat = mean.wavelength_nm;
        repeats += end - i - 1;
        joined.push_back(mean);
        i = end;
    }
    rows = std::move(joined);
    return repeats;
}

}  // namespace

void fill_constants(std::vector<ConstantsRow> rows, const std::string& file,
                    OpticalConstants& constants, std::vector<std::string>& warnings) {
    if (rows.empty()) user_error("{}: found no rows of optical constants", file);
    size_t negative = 0;
    const ConstantsRow* lowest = nullptr;
    for (ConstantsRow& row : rows) {
        check_row(row, file);
        if (row.k >= 0) continue;
        ++negative;
        if (!lowest || row.k < lowest->k) lowest = &row;
    }
    if (negative > 0) {
        warnings.push_back(fmt::format(
            "{} of {} rows have k below 0, which no passive material has (the lowest is {} at {} "
            "nm, line {}); taken for 0",
            negative, rows.size(), lowest->k, lowest->wavelength_nm, lowest->line));
    }
    for (ConstantsRow& row : rows) row.k = row.k > 0 ? row.k : 0;
    const auto earlier = [](const ConstantsRow& a, const ConstantsRow& b) {
        return a.wavelength_nm < b.wavelength_nm;
    };
    std::stable_sort(rows.begin(), rows.end(), earlier);
    double first_repeat = 0;
    if (const size_t repeats = join_repeats(rows, &first_repeat); repeats > 0) {
        warnings.push_back(
            fmt::format("{} rows repeat a wavelength, the first {} nm; their mean is taken",
                        repeats, first_repeat));
    }
    const bool sigma = std::all_of(rows.begin(), rows.end(), [](const ConstantsRow& row) {
        return row.sigma_n > 0 && row.sigma_k > 0;
    });
    for (const ConstantsRow& row : rows) {
        constants.wavelength_nm.push_back(row.wavelength_nm);
        constants.n.push_back(row.n);
        constants.k.push_back(row.k);
        if (!sigma) continue;
        constants.sigma_n.push_back(row.sigma_n);
        constants.sigma_k.push_back(row.sigma_k);
    }
}

}  // namespace drude
