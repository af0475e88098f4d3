#include "bench/charts/illuminants.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace drude {

namespace {

DenseSpectrum gaussian(double nanometres, double sigma) {
    DenseSpectrum spectrum{};
    for (int i = 0; i < spectrum_size; ++i) {
        const double t = (spectrum_first_nm + i - nanometres) / sigma;
        spectrum[i] = std::exp(-0.5 * t * t);
    }
    return spectrum;
}

// The mixture of three bands that has the XYZ of D65.
DenseSpectrum three_bands() {
    const DenseSpectrum bands[] = {gaussian(450, 10), gaussian(540, 10), gaussian(610, 10)};
    glm::dmat3 xyz_of_bands;
    for (int b = 0; b < 3; ++b) {
        const XYZ xyz = spectrum_to_xyz(bands[b]);
        xyz_of_bands[b] = {xyz[0], xyz[1], xyz[2]};
    }
    const XYZ white = spectrum_to_xyz(rgb_illuminant({1, 1, 1}));
    const glm::dvec3 amount = glm::inverse(xyz_of_bands) * glm::dvec3(white[0], white[1], white[2]);
    DenseSpectrum sum{};
    for (int i = 0; i < spectrum_size; ++i) {
        for (int b = 0; b < 3; ++b) sum[i] += amount[b] * bands[b][i];
    }
    return sum;
}

}  // namespace

XYZ ChartIlluminant::white() const {
    const XYZ xyz = spectrum_to_xyz(spectrum);
    return {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]};
}

const std::vector<ChartIlluminant>& chart_illuminants() {
    static const std::vector<ChartIlluminant> all = {
        {"d65", "daylight (D65)", illuminant_d65()},
        {"a", "lamp light (illuminant A)", illuminant_a()},
        {"bands", "a lamp of three bands", three_bands()},
        {"sodium", "a sodium lamp", gaussian(589, 2)}};
    return all;
}

}  // namespace drude
