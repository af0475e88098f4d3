#include "bench/charts/colour_error.h"

#include <algorithm>
#include <stdexcept>

#include "image/delta_e.h"

namespace drude {

namespace {

RGB rgb_at(const TracedPicture& picture, size_t pixel) {
    const double* rgb = picture.at(pixel);
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

double mean_delta_e(const TracedPicture& picture, const TracedPicture& reference, double white) {
    if (picture.pixels() != reference.pixels()) {
        throw std::logic_error("mean_delta_e: pictures of different sizes");
    }
    double total = 0;
    for (size_t p = 0; p < picture.pixels(); ++p) {
        total += delta_e_2000(cielab_of_rgb(rgb_at(picture, p), white),
                              cielab_of_rgb(rgb_at(reference, p), white));
    }
    return total / static_cast<double>(picture.pixels());
}

TracedPicture mean_picture(const ReferencePicture& reference) {
    TracedPicture mean = reference.first;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = reference.mean(i);
    return mean;
}

double bright_luminance(const TracedPicture& picture) {
    std::vector<double> luminance;
    for (size_t p = 0; p < picture.pixels(); ++p) {
        luminance.push_back(rgb_to_xyz(rgb_at(picture, p))[1]);
    }
    const auto at = static_cast<size_t>(0.99 * static_cast<double>(luminance.size() - 1));
    std::nth_element(luminance.begin(), luminance.begin() + static_cast<std::ptrdiff_t>(at),
                     luminance.end());
    return luminance[at] / rgb_to_xyz({1, 1, 1})[1];
}

}  // namespace drude
