#include "image/polarisation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/stokes_layer.h"

namespace drude {

namespace {

// S0, S1, S2 of one layer, a value a pixel.
using Layer = std::vector<double>[3];

void read_layer(const Image& image, const std::string& suffix, Layer& layer) {
    for (int i = 0; i < 3; ++i) layer[i] = stokes_values(image, "picture", i, suffix);
}

std::vector<std::string> common_layers(const Image& a, const Image& b) {
    std::vector<std::string> layers;
    for (const Channel& channel : a.channels) {
        if (channel.name.rfind("S0.", 0) != 0 || !layer_wavelength(channel.name)) continue;
        const std::string suffix = channel.name.substr(3);
        if (has_linear(a, suffix) && has_linear(b, suffix)) layers.push_back(suffix);
    }
    if (!layers.empty()) return layers;
    for (const char* colour : {"R", "G", "B"}) {
        if (!has_linear(a, colour) || !has_linear(b, colour)) return {};
    }
    return {"Y"};
}

}  // namespace

std::optional<PolarisationErrors> polarisation_errors(const Image& a, const Image& b) {
    PolarisationErrors errors;
    errors.layers = common_layers(a, b);
    if (errors.layers.empty()) return std::nullopt;
    double weights = 0.0, intensity = 0.0;
    for (const std::string& suffix : errors.layers) {
        Layer in_a, in_b;
        read_layer(a, suffix, in_a);
        read_layer(b, suffix, in_b);
        for (size_t p = 0; p < a.pixels(); ++p) {
            const double pa = std::hypot(in_a[1][p], in_a[2][p]);
            const double pb = std::hypot(in_b[1][p], in_b[2][p]);
            const bool physical = std::isfinite(pa) && std::isfinite(pb) && in_a[0][p] > 0.0 &&
                                  in_b[0][p] > 0.0 && std::isfinite(in_a[0][p]) &&
                                  std::isfinite(in_b[0][p]);
            if (!physical) {
                ++errors.not_physical;
                continue;
            }
            const double weight = 0.5 * (pa + pb);
            const double dolp = pa / in_a[0][p] - pb / in_b[0][p];
            // Twice the angle between the two axes, from the vectors (S1, S2) themselves.
            const double cross = in_a[1][p] * in_b[2][p] - in_a[2][p] * in_b[1][p];
            const double dot = in_a[1][p] * in_b[1][p] + in_a[2][p] * in_b[2][p];
            const double angle = 0.5 * std::abs(std::atan2(cross, dot)) * 180.0 / std::numbers::pi;
            weights += weight;
            intensity += pb;
            errors.dolp_bias += weight * dolp;
            errors.dolp_mae += weight * std::abs(dolp);
            errors.aolp_mae_deg += weight * angle;
        }
    }
    const double count =
        static_cast<double>(a.pixels() * errors.layers.size() - errors.not_physical);
    if (count > 0.0) errors.polarised_intensity = intensity / count;
    if (weights > 0.0) {
        errors.dolp_bias /= weights;
        errors.dolp_mae /= weights;
        errors.aolp_mae_deg /= weights;
    }
    return errors;
}

}  // namespace drude
