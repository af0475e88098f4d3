#include "render/film_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "image/noise_test.h"
#include "render/batch_tracer.h"

namespace drude {

namespace {

constexpr double largest_float = static_cast<double>(std::numeric_limits<float>::max());

std::string spectral_channel(int row, int bin) {
    // A bin of ten 1 nm samples, each standing for half a nanometre on either side.
    const double centre = spectrum_first_nm + 10 * bin + 4.5;
    std::string name = fmt::format("S{}.{:.6f}nm", row, centre);
    std::replace(name.begin() + 3, name.end() - 2, '.', ',');
    return name;
}

}  // namespace

FilmLayers::FilmLayers(const FilmLayout& layout, bool variance) : layout_(layout) {
    add_colour("", 0, variance);
    if (layout.rows == 4) {
        for (int row = 0; row < 4; ++row) add_colour(fmt::format("S{}.", row), row, variance);
    }
    if (!layout.spectral) return;
    for (int row = 0; row < layout.rows; ++row) {
        for (int bin = 0; bin < spectral_bins; ++bin) {
            add(spectral_channel(row, bin), {Kind::spectral, row, bin});
        }
    }
}

void FilmLayers::add(std::string name, const Layer& layer) {
    channels_.push_back({std::move(name), ExrSamples::float32});
    layers_.push_back(layer);
}

void FilmLayers::add_colour(const std::string& prefix, int row, bool variance) {
    for (int c = 0; c < 3; ++c) add(prefix + "RGB" [c], { Kind::mean, row, c });
    for (int c = 0; variance && c < 3; ++c) {
        add(variance_name(prefix + "RGB"[c]), {Kind::variance, row, c});
    }
}

void FilmLayers::row(const FilmSums& sums, size_t first_pixel, uint32_t* words) const {
    const auto value = [&](const Layer& layer, size_t pixel) {
        switch (layer.kind) {
            case Kind::mean:
                return sums.mean(pixel, layer.row, layer.index);
            case Kind::variance:
                return sums.variance(pixel, layer.row, layer.index);
            case Kind::spectral:
                break;
        }
        return sums.spectral_mean(pixel, layer.row, layer.index);
    };
    for (const Layer& layer : layers_) {
        for (int x = 0; x < layout_.width; ++x) {
            // The variance of values beyond 1e19 is beyond float32.
            const double held = std::clamp(value(layer, first_pixel + static_cast<size_t>(x)),
                                           -largest_float, largest_float);
            *words++ = std::bit_cast<uint32_t>(static_cast<float>(held));
        }
    }
}

}  // namespace drude
