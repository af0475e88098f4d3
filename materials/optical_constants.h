// Tables of optical constants N = n + ik against vacuum wavelength, and the published sets that
// come with the project.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "materials/spectrum.h"

namespace drude {

// What happens outside a table: the end value is held (and the caller told once), or it is an
// error. Never zero, never silent.
enum class RangePolicy { clamp, error };

// Beyond these nothing is a medium of light, and in single precision powers leave the range. The
// least is that of the length of n + ik.
inline constexpr double largest_table_index = 1e6, least_table_index = 1e-6;

struct Index {
    double n = 1, k = 0;
};

struct OpticalConstants {
    std::string name;      // "Cu-McPeak" for a published set, otherwise the user's name
    std::string material;  // "Cu"
    std::string citation;  // the original publication
    std::string kind;      // "measured", "calculated" (theory or a formula), "digitised" (from a
                           // figure), "fitted"
    std::vector<double> wavelength_nm;     // strictly ascending
    std::vector<double> n, k;              // n > 0, k >= 0, at most largest_table_index
    std::vector<double> sigma_n, sigma_k;  // standard deviations; empty where not known
    RangePolicy policy = RangePolicy::clamp;

    // Throws Error (user) naming the set where the table breaks the bounds above.
    void check() const;
    double first_nm() const { return wavelength_nm.front(); }
    double last_nm() const { return wavelength_nm.back(); }
    bool covers(double first, double last) const {
        return first_nm() <= first && last_nm() >= last;
    }
    // Linear interpolation. Outside the table: the end value (clamp) or Error (user) naming the
    // range (error). A NaN wavelength is an Error (user).
    Index at(double wavelength_nm) const;
    // "" where [first, last] is covered, otherwise the one warning that names the range and what
    // is held outside it.
    std::string range_warning(double first, double last) const;
};

struct DenseIndex {
    DenseSpectrum n, k;
};
DenseIndex dense(const OpticalConstants& constants);

// Every published set that comes with the project, ordered by material, then set.
const std::vector<OpticalConstants>& published_sets();

// "Cu-McPeak" by full name, or "Cu" for the default set of a material (letter case matters);
// throws Error (user) with the nearest name.
const OpticalConstants& published_set(std::string_view name);

// Full names and material names, for suggestions and listings.
std::vector<std::string> published_names();

// What there is to know about a published set before it is used (model or sample, gaps, what was
// merged), "" where nothing or where `full_name` is no published set.
std::string published_note(std::string_view full_name);

}  // namespace drude
