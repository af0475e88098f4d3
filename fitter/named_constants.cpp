#include "fitter/named_constants.h"

#include <cmath>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/numbers.h"
#include "fitter/point_fit.h"
#include "materials/dispersion.h"

namespace drude {

namespace {

constexpr std::string_view cauchy_prefix = "cauchy:";

// Every field of a list of numbers, or nothing where one is no finite number.
std::vector<double> numbers(std::string_view text) {
    std::vector<double> values;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        const auto value = parse_double(text.substr(begin, end - begin));
        if (!value || !std::isfinite(*value)) return {};
        values.push_back(*value);
        begin = end + 1;
    }
    return values;
}

OpticalConstants constant(double n, double k) {
    OpticalConstants constants;
    constants.name = fmt::format("{} + {}i", n, k);
    constants.kind = "calculated";
    // Two rows that span every wavelength: no warning about a range can arise.
    constants.wavelength_nm = {1e-6, 1e12};
    constants.n = {n, n};
    constants.k = {k, k};
    return constants;
}

}  // namespace

OpticalConstants cauchy_constants(const std::array<double, 3>& coefficients) {
    OpticalConstants constants;
    constants.name =
        fmt::format("cauchy:{},{},{}", coefficients[0], coefficients[1], coefficients[2]);
    constants.kind = "calculated";
    constants.citation = "Cauchy's formula";
    for (int i = 0; i <= 2 * (3500 - 190); ++i) {
        const double nm = 190 + 0.5 * i;
        const auto index = cauchy(coefficients[0], coefficients[1], coefficients[2], nm);
        constants.wavelength_nm.push_back(nm);
        constants.n.push_back(index.n);
        constants.k.push_back(index.k);
    }
    constants.check();
    return constants;
}

OpticalConstants find_constants(const std::string& text, const std::string& what) {
    if (text.starts_with(cauchy_prefix)) {
        const std::vector<double> c = numbers(std::string_view(text).substr(cauchy_prefix.size()));
        if (c.size() < 2 || c.size() > 3) {
            user_error(
                "{}: found '{}', expected two or three coefficients as in "
                "cauchy:1.452,0.0036 (1, um^2, um^4)",
                what, text);
        }
        return cauchy_constants({c[0], c[1], c.size() > 2 ? c[2] : 0.0});
    }
    const std::vector<double> values = numbers(text);
    if (values.size() == 2) {
        if (!(values[0] > 0 && values[0] <= largest_index && values[1] >= 0 &&
              values[1] <= largest_index)) {
            user_error("{}: found n,k = {}, expected n above 0, k of at least 0, both up to {}",
                       what, text, largest_index);
        }
        return constant(values[0], values[1]);
    }
    Material material;
    try {
        material = find_material(text);
    } catch (const Error& error) {
        throw Error(error.cause(), what + ": " + error.message());
    }
    if (!material.layers.empty()) {
        user_error("{}: found {} with {} layers, expected one material without", what, text,
                   material.layers.size());
    }
    return material.substrate;
}

FilmLayer find_layer(const std::string& text, const std::string& what) {
    const size_t comma = text.rfind(',');
    const auto thickness = comma == std::string::npos
                               ? std::nullopt
                               : parse_double(std::string_view(text).substr(comma + 1));
    if (!thickness || comma == 0) {
        user_error(
            "{}: found '{}', expected a material and its thickness in nm, as in "
            "Al2O3-Malitson-o,3 or 1.77,0,3",
            what, text);
    }
    if (!(*thickness >= 0 && *thickness <= 1e9)) {
        user_error("{}: found a thickness of {} nm in '{}', expected one from 0 to 1e9", what,
                   *thickness, text);
    }
    return {find_constants(text.substr(0, comma), what), *thickness};
}

}  // namespace drude
