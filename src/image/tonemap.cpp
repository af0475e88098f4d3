#include "image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/bilateral.h"

namespace drude {

namespace {

// The authors' weights; negative and unreal values count as none.
double intensity(const float* rgb) {
    const double value = (20.0 * static_cast<double>(rgb[0]) + 40.0 * static_cast<double>(rgb[1]) +
                          static_cast<double>(rgb[2])) /
                         61.0;
    return std::isfinite(value) && value > 0.0 ? value : 0.0;
}

std::vector<double> intensities(int width, int height, const std::vector<float>& rgb) {
    if (width < 1 || height < 1 ||
        rgb.size() != 3 * static_cast<size_t>(width) * static_cast<size_t>(height)) {
        throw std::logic_error("tonemap: a picture of a wrong size");
    }
    std::vector<double> result(rgb.size() / 3);
    for (size_t i = 0; i < result.size(); ++i) result[i] = intensity(&rgb[3 * i]);
    return result;
}

std::vector<float> log_intensities(const std::vector<double>& values, double floor) {
    std::vector<float> result(values.size());
    for (size_t i = 0; i < values.size(); ++i) {
        result[i] = static_cast<float>(std::log10(std::max(values[i], floor)));
    }
    return result;
}

std::vector<float> base_layer(int width, int height, const std::vector<float>& logs,
                              const DurandOptions& options) {
    const BilateralWidths widths = {0.02 * std::max(width, height), 0.4};
    return options.exact ? bilateral_exact(width, height, logs, widths, options.threads)
                         : bilateral_grid(width, height, logs, widths, options.threads);
}

// Nearest rank: the smallest value that at least `fraction` of all do not exceed.
template <class Real>
double percentile(std::vector<Real>& values, double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(values.size()));
    const size_t index = static_cast<size_t>(std::max(1.0, rank)) - 1;
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), nth, values.end());
    return static_cast<double>(*nth);
}

}  // namespace

DurandParameters durand_parameters(int width, int height, const std::vector<float>& rgb,
                                   const DurandOptions& options) {
    const std::vector<double> values = intensities(width, height, rgb);
    DurandParameters parameters;
    std::vector<double> lit;
    for (const double value : values) {
        if (value > 0.0) lit.push_back(value);
    }
    if (lit.empty()) return parameters;
    parameters.floor = 1e-6 * percentile(lit, 0.999);
    const std::vector<float> base =
        base_layer(width, height, log_intensities(values, parameters.floor), options);
    std::vector<float> seen;
    for (size_t i = 0; i < values.size(); ++i) {
        if (values[i] > parameters.floor) seen.push_back(base[i]);
    }
    const double low = percentile(seen, 0.001), high = percentile(seen, 0.999);
    parameters.max_base = high;
    const double wanted = std::log10(options.contrast);
    if (high - low > wanted) parameters.compression = wanted / (high - low);
    return parameters;
}

std::vector<float> tonemap_durand(int width, int height, const std::vector<float>& rgb,
                                  const DurandParameters& parameters,
                                  const DurandOptions& options) {
    const std::vector<double> values = intensities(width, height, rgb);
    const std::vector<float> logs = log_intensities(values, parameters.floor);
    const std::vector<float> base = base_layer(width, height, logs, options);
    std::vector<float> result(rgb.size());
    for (size_t i = 0; i < values.size(); ++i) {
        const double l = static_cast<double>(logs[i]), b = static_cast<double>(base[i]);
        const double out = parameters.compression * (b - parameters.max_base) + (l - b);
        const double gain = std::pow(10.0, out) / std::max(values[i], parameters.floor);
        for (size_t c = 0; c < 3; ++c) {
            const double value = static_cast<double>(rgb[3 * i + c]) * gain;
            result[3 * i + c] = std::isfinite(value) ? static_cast<float>(value) : 0.0F;
        }
    }
    return result;
}

std::vector<float> expose(std::vector<float> rgb, double exposure) {
    const float gain = static_cast<float>(std::exp2(exposure));
    for (float& value : rgb) value *= gain;
    return rgb;
}

}  // namespace drude
