#include "materials/optical_constants.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

std::string range_text(const OpticalConstants& constants) {
    return fmt::format("{} to {} nm", constants.first_nm(), constants.last_nm());
}

}  // namespace

void OpticalConstants::check() const {
    const std::string shown = name.empty() ? "optical constants without a name" : name;
    if (wavelength_nm.empty()) user_error("{}: found no rows, expected at least one", shown);
    const auto check_size = [&](const std::vector<double>& column, const char* what) {
        if (column.size() != wavelength_nm.size()) {
            user_error("{}: found {} values of {} for {} wavelengths, expected one for each", shown,
                       column.size(), what, wavelength_nm.size());
        }
    };
    check_size(n, "n");
    check_size(k, "k");
    if (!sigma_n.empty()) check_size(sigma_n, "sigma_n");
    if (!sigma_k.empty()) check_size(sigma_k, "sigma_k");
    for (size_t i = 0; i < wavelength_nm.size(); ++i) {
        if (!std::isfinite(wavelength_nm[i]) || wavelength_nm[i] <= 0) {
            user_error(
                "{}: wavelength {} in row {}, expected a finite number of nanometres above 0",
                shown, wavelength_nm[i], i + 1);
        }
        if (i > 0 && wavelength_nm[i] <= wavelength_nm[i - 1]) {
            user_error(
                "{}: {} nm is followed by {} nm, expected ascending wavelengths; sort the "
                "rows and remove duplicates",
                shown, wavelength_nm[i - 1], wavelength_nm[i]);
        }
        const auto check_value = [&](const std::vector<double>& column, const char* what,
                                     bool zero_allowed) {
            if (column.empty()) return;
            const double value = column[i];
            if (!std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed)) {
                user_error("{}: {} = {} at {} nm, expected a finite number {}", shown, what, value,
                           wavelength_nm[i], zero_allowed ? "of at least 0" : "above 0");
            }
        };
        const auto check_size_of = [&](const std::vector<double>& column, const char* what) {
            if (column[i] <= largest_table_index) return;
            user_error("{}: {} = {} at {} nm, expected at most {}", shown, what, column[i],
                       wavelength_nm[i], largest_table_index);
        };
        check_value(n, "n", false);
        check_value(k, "k", true);
        check_value(sigma_n, "sigma_n", true);
        check_value(sigma_k, "sigma_k", true);
        check_size_of(n, "n");
        check_size_of(k, "k");
        if (std::hypot(n[i], k[i]) < least_table_index) {
            user_error("{}: n = {} and k = {} at {} nm, expected n + ik at least {} long", shown,
                       n[i], k[i], wavelength_nm[i], least_table_index);
        }
    }
}

Index OpticalConstants::at(double nm) const {
    if (std::isnan(nm)) user_error("{}: the wavelength asked for is not a number", name);
    if (wavelength_nm.empty()) user_error("{}: found no rows, expected at least one", name);
    if (policy == RangePolicy::error && !covers(nm, nm)) {
        user_error(
            "{}: {} nm is outside the table, which spans {}; choose wavelengths inside it, "
            "another set, or the range policy 'clamp'",
            name, nm, range_text(*this));
    }
    if (nm <= first_nm()) return {n.front(), k.front()};
    if (nm >= last_nm()) return {n.back(), k.back()};
    const auto above = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), nm);
    const size_t i = static_cast<size_t>(above - wavelength_nm.begin());
    const double t = (nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
    return {std::lerp(n[i - 1], n[i], t), std::lerp(k[i - 1], k[i], t)};
}

std::string OpticalConstants::range_warning(double first, double last) const {
    if (wavelength_nm.empty() || covers(first, last)) return {};
    const bool below = first<first_nm(), above = last> last_nm();
    if (policy == RangePolicy::error) {
        return fmt::format("{} is tabulated from {}; wavelengths outside are errors", name,
                           range_text(*this));
    }
    const std::string held =
        below && above ? fmt::format("the end values are held below {} nm and above {} nm",
                                     first_nm(), last_nm())
                       : fmt::format("the value at {0} nm is held {1} {0} nm",
                                     below ? first_nm() : last_nm(), below ? "below" : "above");
    return fmt::format("{} is tabulated from {}; {}", name, range_text(*this), held);
}

DenseIndex dense(const OpticalConstants& constants) {
    DenseIndex result;
    for (size_t i = 0; i < spectrum_size; ++i) {
        const Index index = constants.at(spectrum_first_nm + static_cast<double>(i));
        result.n[i] = index.n;
        result.k[i] = index.k;
    }
    return result;
}

}  // namespace drude
