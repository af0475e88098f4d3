#include "image/stokes_layer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

bool has_linear(const Image& image, const std::string& suffix) {
    return image.find("S0." + suffix) && image.find("S1." + suffix) && image.find("S2." + suffix);
}

std::optional<double> layer_wavelength(const std::string& channel) {
    // "S0." to "S3.", digits with a comma for the point, "nm" (Fichet et al., JCGT 10(3), 2021).
    if (channel.size() < 6 || channel[0] != 'S' || channel[1] < '0' || channel[1] > '3' ||
        channel[2] != '.' || channel.compare(channel.size() - 2, 2, "nm") != 0) {
        return std::nullopt;
    }
    std::string number = channel.substr(3, channel.size() - 5);
    std::replace(number.begin(), number.end(), ',', '.');
    const std::optional<double> value = parse_double(number);
    return value && *value > 0.0 && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<double> stokes_values(const Image& image, const std::string& where, int i,
                                  const std::string& suffix) {
    const std::string prefix = "S" + std::to_string(i) + ".";
    if (suffix != "Y") {
        const Channel& channel = image.at(prefix + suffix, where);
        return {channel.data.begin(), channel.data.end()};
    }
    std::vector<double> luminance(image.pixels(), 0.0);
    constexpr double weight[3] = {0.2126, 0.7152, 0.0722};
    for (int c = 0; c < 3; ++c) {
        const std::vector<float>& colour = image.at(prefix + "RGB"[c], where).data;
        for (size_t p = 0; p < colour.size(); ++p) {
            luminance[p] += weight[c] * static_cast<double>(colour[p]);
        }
    }
    return luminance;
}

std::vector<LayerChoice> spectral_layers(const Image& image) {
    std::vector<LayerChoice> layers;
    for (const Channel& channel : image.channels) {
        if (channel.name.rfind("S0.", 0) != 0) continue;
        const std::optional<double> nm = layer_wavelength(channel.name);
        if (nm && has_linear(image, channel.name.substr(3))) {
            layers.push_back({channel.name.substr(3), nm});
        }
    }
    std::stable_sort(layers.begin(), layers.end(), [](const auto& a, const auto& b) {
        return *a.wavelength_nm < *b.wavelength_nm;
    });
    return layers;
}

LayerChoice choose_layer(const Image& image, const std::string& where,
                         std::optional<double> wavelength_nm) {
    const std::vector<LayerChoice> layers = spectral_layers(image);
    const bool colours = has_linear(image, "R") && has_linear(image, "G") && has_linear(image, "B");
    if (layers.empty() && !colours) {
        user_error(
            "{}: has no Stokes layers (S0, S1, S2 of R, G, B or of wavelengths), so nothing is "
            "known about its polarisation; render the scene with --stokes",
            where);
    }
    if (!wavelength_nm) {
        if (colours) return {"Y", std::nullopt};
        user_error(
            "{}: has Stokes layers of wavelengths only, {} from {} to {} nm; choose one, e.g. "
            "--wavelength {}",
            where, layers.size(), format_double(*layers.front().wavelength_nm),
            format_double(*layers.back().wavelength_nm),
            format_double(*layers[layers.size() / 2].wavelength_nm));
    }
    if (layers.empty()) {
        user_error(
            "{}: has Stokes layers of R, G, B only, none of a wavelength; render the scene with "
            "--stokes --spectral, or leave out --wavelength",
            where);
    }
    return *std::min_element(layers.begin(), layers.end(), [&](const auto& a, const auto& b) {
        return std::abs(*a.wavelength_nm - *wavelength_nm) <
               std::abs(*b.wavelength_nm - *wavelength_nm);
    });
}

Stokes<double> StokesLayer::at(size_t pixel) const {
    return {{s[0][pixel], s[1][pixel], s[2][pixel], s[3].empty() ? 0.0 : s[3][pixel]}};
}

bool is_left_handed(const Image& image) {
    return image.text("polarisationHandedness") == "left";
}

StokesLayer read_stokes_layer(const Image& image, const std::string& where,
                              const LayerChoice& choice, bool with_s3) {
    StokesLayer layer;
    layer.width = image.width;
    layer.height = image.height;
    layer.choice = choice;
    for (int i = 0; i < (with_s3 ? 4 : 3); ++i) {
        layer.s[i] = stokes_values(image, where, i, choice.suffix);
    }
    if (with_s3 && is_left_handed(image)) {
        for (double& s3 : layer.s[3]) s3 = -s3;
    }
    return layer;
}

}  // namespace drude
