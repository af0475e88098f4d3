#include "image/analyser.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/numbers.h"
#include "materials/optical_elements.h"

namespace drude {

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

Rotation<double> turned(double degrees) {
    return rotation_from_dots(std::cos(radians(degrees)), std::sin(radians(degrees)));
}

double parse_angle(std::string_view text, std::string_view whole, std::string_view what) {
    const std::optional<double> value = parse_double(text);
    if (!value || !(std::abs(*value) <= 360.0)) {
        user_error(
            "{} '{}': '{}' is no angle; expected degrees from -360 to 360 as "
            "ANGLE[,retarder=FAST_AXIS[:RETARDANCE]], e.g. 45 or 0,retarder=-45",
            what, whole, text);
    }
    return *value;
}

}  // namespace

Analyser parse_analyser(std::string_view text, std::string_view what) {
    Analyser analyser;
    const size_t comma = text.find(',');
    analyser.axis_deg = parse_angle(text.substr(0, comma), text, what);
    if (comma == std::string_view::npos) return analyser;
    const std::string_view rest = text.substr(comma + 1);
    const size_t equals = rest.find('=');
    const std::string_view key = rest.substr(0, equals);
    if (key != "retarder" || equals == std::string_view::npos) {
        user_error("{} '{}': expected 'retarder=FAST_AXIS' after the comma, found '{}'{}", what,
                   text, rest, key == "retarder" ? "" : did_you_mean(key, {"retarder"}));
    }
    const std::string_view value = rest.substr(equals + 1);
    const size_t colon = value.find(':');
    Analyser::Retarder retarder;
    retarder.fast_axis_deg = parse_angle(value.substr(0, colon), text, what);
    if (colon != std::string_view::npos) {
        retarder.retardance_deg = parse_angle(value.substr(colon + 1), text, what);
    }
    analyser.retarder = retarder;
    return analyser;
}

std::string format_analyser(const Analyser& analyser) {
    const std::string axis = format_double(analyser.axis_deg);
    if (!analyser.retarder) return axis;
    return fmt::format("{},retarder={}:{}", axis, format_double(analyser.retarder->fast_axis_deg),
                       format_double(analyser.retarder->retardance_deg));
}

Mueller<double> mueller(const Analyser& analyser) {
    const Mueller<double> polariser = linear_polariser(turned(analyser.axis_deg));
    if (!analyser.retarder) return polariser;
    return polariser * linear_retarder(turned(analyser.retarder->fast_axis_deg),
                                       radians(analyser.retarder->retardance_deg));
}

std::vector<std::string> analysed_layers(const Image& image, const std::string& where,
                                         std::optional<double> wavelength_nm) {
    const LayerChoice choice = choose_layer(image, where, wavelength_nm);
    if (choice.suffix != "Y") return {choice.suffix};
    std::vector<std::string> layers = {"R", "G", "B"};
    for (const LayerChoice& spectral : spectral_layers(image)) layers.push_back(spectral.suffix);
    return layers;
}

Image behind_analyser(const Image& image, const std::string& where,
                      const std::vector<std::string>& layers, const Analyser& analyser) {
    const Mueller<double> matrix = mueller(analyser);
    Image result;
    result.width = image.width;
    result.height = image.height;
    for (const std::string& suffix : layers) {
        const StokesLayer layer =
            read_stokes_layer(image, where, {suffix, {}}, analyser.retarder.has_value());
        std::vector<float> s[4];
        for (auto& component : s) component.resize(image.pixels());
        for (size_t p = 0; p < image.pixels(); ++p) {
            const Stokes<double> v = matrix * layer.at(p);
            for (int i = 0; i < 4; ++i) s[i][p] = static_cast<float>(v[i]);
        }
        const bool colour = suffix == "R" || suffix == "G" || suffix == "B";
        if (colour || layers.size() == 1) result.add(colour ? suffix : "Y").data = s[0];
        for (int i = 0; i < 4; ++i) {
            result.add(fmt::format("S{}.{}", i, suffix)).data = std::move(s[i]);
        }
    }
    for (const char* name : {"spectralLayoutVersion", "emissiveUnits"}) {
        const auto found = image.attributes.find(name);
        if (found != image.attributes.end()) result.attributes[name] = found->second;
    }
    result.attributes["polarisationHandedness"] = std::string("right");
    result.attributes["analyser"] = format_analyser(analyser);
    return result;
}

}  // namespace drude
