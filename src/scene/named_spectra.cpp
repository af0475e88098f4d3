// pbrt-v4's named spectra, and spectra from pairs of numbers, inline or in a file.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numbers.h"
#include "materials/glasses.h"
#include "scene/spectra.h"

namespace drude {

namespace {

// Everything pbrt-v4 has a name for (util/spectrum.cpp), and the glasses that it calls F5, F10 and
// F11 by their own names.
const std::vector<std::string>& spectrum_names() {
    static const std::vector<std::string> names = {
        "glass-BK7",     "glass-BAF10",  "glass-FK51A",    "glass-LASF9",    "glass-F5",
        "glass-SF5",     "glass-SF10",   "glass-SF11",     "glass-F10",      "glass-F11",
        "metal-Ag-eta",  "metal-Ag-k",   "metal-Al-eta",   "metal-Al-k",     "metal-Au-eta",
        "metal-Au-k",    "metal-Cu-eta", "metal-Cu-k",     "metal-CuZn-eta", "metal-CuZn-k",
        "metal-MgO-eta", "metal-MgO-k",  "metal-TiO2-eta", "metal-TiO2-k",   "stdillum-A",
        "stdillum-D50",  "stdillum-D65", "stdillum-F1",    "stdillum-F2",    "stdillum-F3",
        "stdillum-F4",   "stdillum-F5",  "stdillum-F6",    "stdillum-F7",    "stdillum-F8",
        "stdillum-F9",   "stdillum-F10", "stdillum-F11",   "stdillum-F12",   "illum-acesD60",
    };
    return names;
}

bool is_known(const std::string& name) {
    const std::vector<std::string>& names = spectrum_names();
    return std::find(names.begin(), names.end(), name) != names.end();
}

SampledTable on_grid(const std::string& name, const DenseSpectrum& spectrum) {
    SampledTable table{
        name, std::vector<double>(spectrum.size()), {spectrum.begin(), spectrum.end()}};
    std::iota(table.wavelength_nm.begin(), table.wavelength_nm.end(), spectrum_first_nm);
    return table;
}

SampledTable named_table(const std::string& name, const Place& place, Messages& messages) {
    if (const auto metal = metal_spectrum(name, place, messages)) {
        return {name, metal->set->wavelength_nm, metal->is_k ? metal->set->k : metal->set->n};
    }
    if (name.rfind("glass-", 0) == 0) {
        const Glass* glass = find_glass(std::string_view(name).substr(6));
        if (glass != nullptr) return on_grid(name, dense_index(*glass));
    }
    if (name == "stdillum-A") return on_grid(name, illuminant_a());
    if (name != "stdillum-D65") {
        messages.stand_in(place, fmt::format("the spectrum '{}' is not in this project; "
                                             "stdillum-D65 stands in",
                                             name));
    }
    return on_grid(name, illuminant_d65());
}

// `previous` is 0 before the first.
[[noreturn]] void wrong_order(double wavelength, double previous, const Place& place) {
    if (!(wavelength > 0)) {
        user_error_at(place, "wavelength {} nm; expected more than 0", format_double(wavelength));
    }
    user_error_at(place, "wavelength {} nm after {} nm; expected ascending wavelengths",
                  format_double(wavelength), format_double(previous));
}

SampledTable inline_table(const Parameter& parameter) {
    SampledTable table{fmt::format("'{}'", parameter.name), {}, {}};
    for (size_t i = 0; i < parameter.numbers.size(); i += 2) {
        const double wavelength = parameter.numbers[i];
        const double previous = i == 0 ? 0 : parameter.numbers[i - 2];
        if (!(wavelength > previous)) wrong_order(wavelength, previous, parameter.place_of(i));
        table.wavelength_nm.push_back(wavelength);
        table.values.push_back(parameter.numbers[i + 1]);
    }
    return table;
}

// Pairs of wavelength and value, separated by white space, commas or lines, '#' comments.
SampledTable file_table(const std::string& path, std::string text) {
    std::replace(text.begin(), text.end(), ',', ' ');
    SampledTable table{path, {}, {}};
    Lexer lexer(std::make_shared<const Source>(Source{path, std::move(text)}));
    bool is_value = false;
    for (Token token = lexer.take(); token.kind != Token::Kind::end; token = lexer.take()) {
        const std::optional<double> number =
            token.kind == Token::Kind::word ? parse_double(token.text) : std::nullopt;
        if (!number || !std::isfinite(*number)) {
            user_error_at(lexer.place(token), "found '{}'; expected a finite number",
                          shown(token.text));
        }
        const bool is_first = table.wavelength_nm.empty();
        if (is_value) {
            table.values.push_back(*number);
        } else {
            const double previous = is_first ? 0 : table.wavelength_nm.back();
            if (!(*number > previous)) wrong_order(*number, previous, lexer.place(token));
            table.wavelength_nm.push_back(*number);
        }
        is_value = !is_value;
    }
    if (table.values.empty() || is_value) {
        user_error_at(lexer.place(lexer.peek()),
                      "the file ends here; expected pairs of wavelength (nm) and value");
    }
    return table;
}

}  // namespace

std::optional<MetalSpectrum> metal_spectrum(const std::string& name, const Place& place,
                                            Messages& messages) {
    if (name.rfind("metal-", 0) != 0) return {};
    const bool is_k = name.size() > 8 && name.substr(name.size() - 2) == "-k";
    const bool is_eta = name.size() > 10 && name.substr(name.size() - 4) == "-eta";
    std::vector<std::string> known = published_names();
    const std::string metal =
        is_k || is_eta ? name.substr(6, name.size() - 6 - (is_k ? 2u : 4u)) : name.substr(6);
    const bool here = std::find(known.begin(), known.end(), metal) != known.end();
    if ((is_k || is_eta) && here) {
        const OpticalConstants& set = published_set(metal);
        messages.note(place, fmt::format("'{}' is {} of this project's set {}", name,
                                         is_k ? "k" : "n", set.name));
        return MetalSpectrum{&set, is_k};
    }
    if (is_known(name)) {
        const OpticalConstants& set = published_set("Cu");
        messages.stand_in(place, fmt::format("'{}' is not among this project's tables; {} of {} "
                                             "stands in",
                                             name, is_k ? "k" : "n", set.name));
        return MetalSpectrum{&set, is_k};
    }
    user_error_at(place,
                  "unknown spectrum '{}'{}; expected metal-X-eta or metal-X-k with X one of: "
                  "{}",
                  shown(name), did_you_mean(name, spectrum_names()), fmt::join(known, ", "));
}

SampledTable sampled_table(const Parameter& parameter, BuildContext& context) {
    if (parameter.strings.empty()) return inline_table(parameter);
    const std::string& name = parameter.strings[0];
    const Place place = parameter.place_of(0);
    if (is_known(name) || name.rfind("metal-", 0) == 0) {
        return named_table(name, place, context.messages);
    }
    // Neither a name nor a file is most often a name misspelt.
    const std::string hint = did_you_mean(name, spectrum_names());
    std::string path;
    try {
        path = context.assets.find(name, place.file, place, "spectrum file");
    } catch (const Error& error) {
        if (hint.empty()) throw;
        throw Error(error.cause(), error.message() + hint);
    }
    return file_table(path, context.assets.read(path, place));
}

}  // namespace drude
