#include "fitter/export.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

constexpr double renderer_first_nm = 360, renderer_last_nm = 830;

// A value for a line of its own: a line break in it would end the comment.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

// A JSON string is a YAML double-quoted scalar (YAML 1.2, section 1.3).
std::string yaml_string(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// The decimal point three places to the left: nanometres as micrometres without a rounding, so that
// reading them back gives the same bits.
std::string thousandth(double value) {
    std::string text = format_double(value);
    const size_t exponent = text.find('e');
    if (exponent != std::string::npos) {
        const auto power = parse_integer(text[exponent + 1] == '+' ? text.substr(exponent + 2)
                                                                   : text.substr(exponent + 1));
        return fmt::format("{}e{}", text.substr(0, exponent), power.value_or(0) - 3);
    }
    size_t point = text.find('.');
    if (point == std::string::npos) point = text.size();
    const std::string fraction = point < text.size() ? text.substr(point + 1) : "";
    std::string digits = std::string(point < 4 ? 4 - point : 0, '0') + text.substr(0, point);
    digits.insert(digits.size() - 3, ".");
    digits += fraction;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
}

std::string comments(const OpticalConstants& constants) {
    std::string text = fmt::format("# name: {}\n", one_line(constants.name));
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) text += fmt::format("# {}: {}\n", key, one_line(value));
    };
    add("material", constants.material);
    add("kind", constants.kind);
    add("citation", constants.citation);
    return text;
}

}  // namespace

std::string format_spd(const OpticalConstants& constants, IndexPart part) {
    constants.check();
    const std::vector<double>& values = part == IndexPart::n ? constants.n : constants.k;
    std::string text = comments(constants);
    text += fmt::format("# {} against vacuum wavelength in nm, N = n + ik\n",
                        part == IndexPart::n ? "n" : "k");
    const auto line = [&](double wavelength, double value) {
        text += fmt::format("{} {}\n", format_double(wavelength), format_double(value));
    };
    const bool before = constants.first_nm() > renderer_first_nm;
    const bool after = constants.last_nm() < renderer_last_nm;
    if (before || after) {
        text +=
            fmt::format("# measured or computed from {} to {} nm; held beyond\n",
                        format_double(constants.first_nm()), format_double(constants.last_nm()));
    }
    if (before) line(renderer_first_nm, values.front());
    for (size_t i = 0; i < values.size(); ++i) line(constants.wavelength_nm[i], values[i]);
    if (after) line(renderer_last_nm, values.back());
    return text;
}

std::string format_refractiveindex_info(const OpticalConstants& constants) {
    constants.check();
    std::string text = "# written by drude in the format of the refractiveindex.info database\n";
    text += fmt::format("REFERENCES: {}\n", yaml_string(constants.citation));
    text += fmt::format("COMMENTS: {}\n",
                        yaml_string(fmt::format("{} ({})", constants.name, constants.kind)));
    text += "DATA:\n  - type: tabulated nk\n    data: |\n";
    for (size_t i = 0; i < constants.n.size(); ++i) {
        text += fmt::format("        {} {} {}\n", thousandth(constants.wavelength_nm[i]),
                            format_double(constants.n[i]), format_double(constants.k[i]));
    }
    return text;
}

std::string format_constants_csv(const OpticalConstants& constants) {
    constants.check();
    std::string text = comments(constants);
    const bool sigma = !constants.sigma_n.empty() && !constants.sigma_k.empty();
    text += sigma ? "wavelength_nm,n,k,sigma_n,sigma_k\n" : "wavelength_nm,n,k\n";
    for (size_t i = 0; i < constants.n.size(); ++i) {
        text += fmt::format("{},{},{}", format_double(constants.wavelength_nm[i]),
                            format_double(constants.n[i]), format_double(constants.k[i]));
        if (sigma) {
            text += fmt::format(",{},{}", format_double(constants.sigma_n[i]),
                                format_double(constants.sigma_k[i]));
        }
        text += "\n";
    }
    return text;
}

}  // namespace drude
