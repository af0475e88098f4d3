#include "report/picture_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/numbers.h"
#include "image/colour_map.h"
#include "image/difference.h"
#include "image/srgb.h"
#include "image/stokes_layer.h"
#include "report/markup.h"
#include "report/packed_layers.h"

namespace drude {

namespace {

size_t channel_index(const Image& image, const std::string& name) {
    return static_cast<size_t>(&image.at(name, "the picture") - image.channels.data());
}

// 256 colours of a map as "rrggbb...".
std::string map_text(ColourMap map) {
    std::string text;
    for (int i = 0; i < 256; ++i) {
        for (const float linear : map_colour(map, i / 255.0)) {
            text += fmt::format("{:02x}", srgb_byte(linear));
        }
    }
    return text;
}

}  // namespace

PictureData::PictureData(const PictureBudget& budget) : budget_(budget) {}

void PictureData::Grid::add(Layers layers, bool is_blurred) {
    own.resize(pixels(), 0);
    if (!pictures.empty()) {
        for (size_t row = 0; row < 4; ++row) {
            const std::vector<uint16_t>& first = pictures.front().values[row];
            for (size_t i = 0; i < first.size(); ++i) {
                if (first[i] != layers.values[row][i]) own[i % pixels()] = 1;
            }
        }
    }
    pictures.push_back(std::move(layers));
    blurred.push_back(is_blurred);
}

std::vector<size_t> PictureData::Grid::chosen(char kind, int step) const {
    std::vector<size_t> indices;
    for (int y = 0; y < height; y += step) {
        for (int x = 0; x < width; x += step) {
            const size_t i = static_cast<size_t>(y) * width + x;
            if (own[i] == kind) indices.push_back(i);
        }
    }
    return indices;
}

size_t PictureData::Grid::bytes(int step, int first_row) const {
    // Rows of zeros cost nothing.
    const auto kept = [&](const Layers& picture) {
        size_t rows = 0;
        for (size_t row = first_row; row < 4; ++row) {
            const std::vector<uint16_t>& v = picture.values[row];
            rows += std::any_of(v.begin(), v.end(), [](uint16_t h) { return (h & 0x7fffu) != 0; });
        }
        return rows;
    };
    size_t rows = 0;
    for (const Layers& picture : pictures) rows += kept(picture);
    return 2 * planes *
           (rows * chosen(1, step).size() + kept(pictures.front()) * chosen(0, step).size());
}

int PictureData::Grid::fitting_step(size_t budget, int first_row, int unit) const {
    int step = unit;
    while (bytes(step, first_row) > budget && step < std::max(width, height)) step += unit;
    return step;
}

int PictureData::Grid::blurred_step(size_t budget) const {
    const auto count = static_cast<size_t>(std::count(blurred.begin(), blurred.end(), 1));
    if (count == 0) return 1;
    const size_t sharp =
        2 * planes * (chosen(0, 1).size() + (pictures.size() - count) * chosen(1, 1).size());
    int step = 1;
    while (sharp + 2 * planes * count * chosen(1, step).size() > budget && step < 8) ++step;
    return step;
}

std::string PictureData::Grid::packed(size_t picture, char kind, int first, int rest) const {
    std::string text = "[";
    for (size_t row = 0; row < 4; ++row) {
        const std::vector<size_t> indices = chosen(kind, row == 0 ? first : rest);
        std::vector<uint16_t> halves;
        halves.reserve(planes * indices.size());
        for (size_t plane = 0; plane < planes; ++plane) {
            const uint16_t* values = pictures[picture].values[row].data() + plane * pixels();
            for (const size_t i : indices) halves.push_back(values[i]);
        }
        text += fmt::format("{}\"{}\"", row ? "," : "", pack_halves(halves));
    }
    return text + "]";
}

PictureData::Layers PictureData::layers_of(const Image& image,
                                           const std::vector<std::array<size_t, 4>>& planes,
                                           int step) {
    Layers layers;
    for (size_t row = 0; row < 4; ++row) {
        for (const std::array<size_t, 4>& plane : planes) {
            const std::vector<float>& data = image.channels[plane[row]].data;
            for (int y = 0; y < image.height; y += step) {
                for (int x = 0; x < image.width; x += step) {
                    layers.values[row].push_back(
                        half_from_float(data[static_cast<size_t>(y) * image.width + x]));
                }
            }
        }
    }
    return layers;
}

void PictureData::add_spectra(const StudyPair& pair) {
    const auto planes_of = [](const Image& image, std::vector<double>* wavelengths) {
        std::vector<std::array<size_t, 4>> planes;
        for (const LayerChoice& layer : spectral_layers(image)) {
            wavelengths->push_back(*layer.wavelength_nm);
            planes.emplace_back();
            for (size_t row = 0; row < 4; ++row) {
                planes.back()[row] = channel_index(image, fmt::format("S{}.{}", row, layer.suffix));
            }
        }
        return planes;
    };
    for (const Image* image : {&pair.fitted_spectral, &pair.literature_spectral}) {
        std::vector<double> wavelengths;
        const auto planes = planes_of(*image, &wavelengths);
        // A quarter of the shown resolution is plenty for a map; the numbers stay single pixels'.
        const int longer = std::max(image->width, image->height);
        const int step = std::max(1, 4 * longer / std::max(1, budget_.side));
        if (spectral_.pictures.empty()) {
            wavelengths_ = wavelengths;
            spectral_.planes = planes.size();
            spectral_step_ = step;
            spectral_is_smaller_ = pair.spectral_is_smaller;
            spectral_.width = (image->width + step - 1) / step;
            spectral_.height = (image->height + step - 1) / step;
        }
        Layers layers = layers_of(*image, planes, spectral_step_);
        if (wavelengths != wavelengths_ ||
            layers.values[0].size() != spectral_.planes * spectral_.pixels()) {
            user_error(
                "the spectral layers of the study's pictures differ; render all of them "
                "with one resolution and the same layers");
        }
        spectral_.add(std::move(layers), false);
    }
}

void PictureData::add(const std::string& id, const StudyPair& pair, bool blurred) {
    const Image& first = pair.fitted;
    if (colour_.pictures.empty()) {
        exr_width_ = first.width;
        exr_height_ = first.height;
        const int longer = std::max(first.width, first.height);
        step_ = (longer + budget_.side - 1) / budget_.side;
        colour_.planes = 3;
        colour_.width = (first.width + step_ - 1) / step_;
        colour_.height = (first.height + step_ - 1) / step_;
    } else if (first.width != exr_width_ || first.height != exr_height_) {
        user_error(
            "{}: its pictures have {} x {} pixels, those before it {} x {}; render all with "
            "one resolution",
            id, first.width, first.height, exr_width_, exr_height_);
    }
    for (const Image* image : {&pair.fitted, &pair.literature}) {
        std::vector<std::array<size_t, 4>> planes(3);
        for (size_t c = 0; c < 3; ++c) {
            for (size_t row = 0; row < 4; ++row) {
                planes[c][row] = channel_index(*image, fmt::format("S{}.{}", row, "RGB"[c]));
            }
        }
        colour_.add(layers_of(*image, planes, step_), blurred);
    }
    const bool spectra = pair.fitted_spectral.width > 0;
    if (spectra != !spectral_.pictures.empty() && colour_.pictures.size() > 2) {
        user_error("{}: spectral layers are in some of the study's pictures only", id);
    }
    if (spectra) add_spectra(pair);
    ids_ += (ids_.empty() ? "" : ",") + fmt::format("\"{}\"", id);
}

std::string PictureData::json() const {
    if (colour_.pictures.empty()) return "";
    // What all pictures share is as fine as the finest of them.
    const auto group = [](const Grid& grid, int first, int blurred, int rest) {
        std::string steps, pictures;
        for (size_t i = 0; i < grid.pictures.size(); ++i) {
            const int step = grid.blurred[i] ? blurred : first;
            steps += (i ? "," : "") + fmt::format("{}", step);
            pictures += (i ? ",\n" : "") + grid.packed(i, 1, step, rest);
        }
        return fmt::format(
            "\"width\":{},\"height\":{},\"planes\":{},\"first\":{},\"firsts\":[{}],\"rest\":{},"
            "\"own\":\"{}\",\n\"shared\":{},\n\"pictures\":[\n{}\n]",
            grid.width, grid.height, grid.planes, first, steps, rest,
            pack_bytes({grid.own.data(), grid.own.size()}), grid.packed(0, 0, first, rest),
            pictures);
    };
    const int blurred = colour_.blurred_step(budget_.colour_bytes);
    std::string text = fmt::format(
        "{{\"step\":{},\"pairs\":[{}],\n\"colour\":{{{}}}", step_, ids_,
        group(colour_, 1, blurred, colour_.fitting_step(budget_.stokes_bytes, 1, blurred)));
    if (!spectral_.pictures.empty()) {
        std::string nm;
        for (const double w : wavelengths_) nm += (nm.empty() ? "" : ",") + format_double(w);
        const int step = spectral_.fitting_step(budget_.spectral_bytes, 0, 1);
        text += fmt::format(",\n\"spectral\":{{\"smaller\":{},\"step\":{},\"nm\":[{}],{}}}",
                            spectral_is_smaller_, spectral_step_, nm,
                            group(spectral_, step, step, step));
    }
    const ColourBar log_bar = log_difference_bar();
    return text + fmt::format(",\n\"log\":[{},{}],\"sequential\":\"{}\",\"diverging\":\"{}\"}}\n",
                              log_bar.low, log_bar.high, map_text(ColourMap::sequential),
                              map_text(ColourMap::diverging));
}

std::string PictureData::description() const {
    if (colour_.pictures.empty()) return "";
    const auto every = [](int step) {
        return step == 1 ? std::string("every pixel")
                         : fmt::format("every {}{} pixel of every {}{} row", step,
                                       step == 2   ? "nd"
                                       : step == 3 ? "rd"
                                                   : "th",
                                       step,
                                       step == 2   ? "nd"
                                       : step == 3 ? "rd"
                                                   : "th");
    };
    const int blurred = colour_.blurred_step(budget_.colour_bytes);
    const int rest = colour_.fitting_step(budget_.stokes_bytes, 1, blurred);
    std::string text = fmt::format(
        "Embedded are the numbers of the EXR files beside this page, rounded to half floats (a "
        "relative error of at most 0.05 %), single pixels and never averages: S0 in R, G, B of "
        "{}{}, S1 to S3 of {}",
        every(step_),
        blurred > 1 ? fmt::format(" ({} of the rough surfaces)", every(step_ * blurred)) : "",
        every(step_ * rest));
    if (spectral_.pictures.empty()) return text + "; no spectral layers.";
    const int step = spectral_.fitting_step(budget_.spectral_bytes, 0, 1) * spectral_step_;
    return text + fmt::format(", and S0 to S3 at {} wavelengths of {}{}.", wavelengths_.size(),
                              every(step),
                              spectral_is_smaller_
                                  ? " of the smaller pictures *-spectral.exr, which show the same "
                                    "scene at a quarter of the resolution"
                                  : "");
}

}  // namespace drude
