#include "bench/charts/sphere_picture.h"

#include <algorithm>
#include <cmath>

#include "image/delta_e.h"

namespace drude {

namespace {

// Linear sRGB of D65 at each wavelength, so that the sky is (1, 1, 1).
const std::vector<RGB>& sky_weights() {
    static const std::vector<RGB> weights = [] {
        const DenseSpectrum sky = rgb_illuminant({1, 1, 1});
        std::vector<RGB> result;
        for (size_t i = 0; i < spectrum_integral_size; ++i) {
            result.push_back(xyz_to_rgb(
                {sky[i] * cie1931().x[i], sky[i] * cie1931().y[i], sky[i] * cie1931().z[i]}));
        }
        return result;
    }();
    return weights;
}

}  // namespace

double ring_cosine(int ring) {
    const double sin2 = (ring + 0.5) / sphere_rings;
    return static_cast<double>(static_cast<float>(std::sqrt(1 - sin2)));
}

SpherePicture sphere_picture(const std::function<double(int i, int ring)>& reflectance) {
    SpherePicture picture(sphere_rings, RGB{0, 0, 0});
    for (int ring = 0; ring < sphere_rings; ++ring) {
        for (int i = 0; i < spectrum_integral_size; ++i) {
            const double value = reflectance(i, ring);
            for (size_t c = 0; c < 3; ++c) picture[ring][c] += value * sky_weights()[i][c];
        }
    }
    return picture;
}

PictureError picture_error(const SpherePicture& picture, const SpherePicture& truth, double white) {
    PictureError error;
    double squares = 0, signal = 0, absolute = 0;
    for (size_t ring = 0; ring < truth.size(); ++ring) {
        const double distance =
            delta_e_2000(cielab_of_rgb(picture[ring], white), cielab_of_rgb(truth[ring], white));
        error.mean_delta_e += distance / static_cast<double>(truth.size());
        error.worst_delta_e = std::max(error.worst_delta_e, distance);
        for (size_t c = 0; c < 3; ++c) {
            const double difference = picture[ring][c] - truth[ring][c];
            squares += difference * difference;
            signal += truth[ring][c] * truth[ring][c];
            absolute += std::abs(difference) / static_cast<double>(3 * truth.size());
        }
    }
    error.relative_rmse = std::sqrt(squares / signal);
    error.log10_difference = std::log10(absolute);
    return error;
}

double brightest(const SpherePicture& picture) {
    double largest = 0;
    for (const RGB& rgb : picture) largest = std::max(largest, rgb_to_xyz(rgb)[1]);
    return largest;
}

double mean_Y(const SpherePicture& picture) {
    double sum = 0;
    for (const RGB& rgb : picture) sum += rgb_to_xyz(rgb)[1];
    return sum / static_cast<double>(picture.size());
}

}  // namespace drude
