#include "cli/films.h"

#include <algorithm>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

// Beyond these nothing is physical and squares start to overflow.
constexpr double largest_index = 1000, largest_thickness_nm = 1e9;

FilmLayer parse_film(const std::string& text) {
    const auto malformed = [&] {
        user_error("--film: found '{}', expected n,k,nm as in 1.77,0,100", text);
    };
    double values[3];
    size_t begin = 0;
    for (int i = 0; i < 3; ++i) {
        const size_t end = i < 2 ? text.find(',', begin) : text.size();
        if (end == std::string::npos) malformed();
        const auto value = parse_double(std::string_view(text).substr(begin, end - begin));
        if (!value) malformed();
        values[i] = *value;
        begin = end + 1;
    }
    if (!(values[2] >= 0 && values[2] <= largest_thickness_nm)) {
        user_error("--film: found a thickness of {} nm in '{}', expected one from 0 to {}",
                   values[2], text, largest_thickness_nm);
    }
    return {constant_index(values[0], values[1], "--film '" + text + "'"), values[2]};
}

}  // namespace

OpticalConstants constant_index(double n, double k, const std::string& what) {
    if (!(n > 0 && n <= largest_index)) {
        user_error("{}: found n = {}, expected a value above 0 and up to {}", what, n,
                   largest_index);
    }
    if (!(k >= 0 && k <= largest_index)) {
        user_error("{}: found k = {}, expected a value from 0 (transparent) to {}", what, k,
                   largest_index);
    }
    OpticalConstants constants;
    constants.name = fmt::format("{} + {}i", n, k);
    constants.kind = "calculated";
    // Two rows that span every wavelength: no warning about a range can arise.
    constants.wavelength_nm = {1e-6, 1e12};
    constants.n = {n, n};
    constants.k = {k, k};
    return constants;
}

void lay_films(const std::vector<std::string>& films, Material* material) {
    std::vector<FilmLayer> layers;
    for (const std::string& film : films) layers.push_back(parse_film(film));
    material->layers.insert(material->layers.begin(), layers.begin(), layers.end());
}

}  // namespace drude
