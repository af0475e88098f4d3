// Suns of a single pixel: the irradiance that an environment's sampling gives a plane, against the
// closed form.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>

#include "bench/charts/bench_items.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/scalar.h"
#include "render/environment.h"

namespace drude {

namespace {

// A lat-long sky of radiance 1 with one texel `sun` times as bright, a third of the way down from
// the zenith to the horizon.
struct Sky {
    Image image;
    int row = 0;
    double sun = 1;
};

Sky sky_of(int width, double sun) {
    Sky sky;
    sky.image.width = width;
    sky.image.height = width / 2;
    sky.row = width / 2 / 6;
    sky.sun = sun;
    for (const char* name : {"R", "G", "B"}) {
        Channel& channel = sky.image.add(name);
        std::fill(channel.data.begin(), channel.data.end(), 1.0f);
        channel.data[static_cast<size_t>(sky.row) * width + width / 3] = static_cast<float>(sun);
    }
    return sky;
}

// Of the plane z = 0: pi of the sky, and the texel's integral of the cosine.
double exact_irradiance(const Sky& sky) {
    const double step = pi / sky.image.height;
    const double top = std::sin(sky.row * step), bottom = std::sin((sky.row + 1) * step);
    const double texel = (bottom * bottom - top * top) / 2 * (2 * pi / sky.image.width);
    return pi + (sky.sun - 1) * texel;
}

struct Estimate {
    double mean = 0, deviation = 0;  // of one sample
};

// As a path does it: the sky's own sampling and the cosine's, weighed by the power heuristic.
Estimate irradiance(const Environment& environment, int samples) {
    const auto share = [](float a, float b) {
        const float ratio = b / a;
        return 1 / (1 + ratio * ratio);
    };
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
        // Multiples of powers of the root of x^5 = x + 1.
        double u[4], power = 1;
        for (double& value : u) {
            power /= 1.16730397826141868426;
            const double turn = 0.5 + power * (i + 1);
            value = turn - std::floor(turn);
        }
        double value = 0;
        const auto s = environment.sample({static_cast<float>(u[0]), static_cast<float>(u[1])});
        if (s.d.z > 0 && s.pdf > 0) {
            const float cosine = s.d.z / static_cast<float>(pi);
            value += static_cast<double>(s.radiance.y * s.d.z / s.pdf * share(s.pdf, cosine));
        }
        const auto r = static_cast<float>(std::sqrt(u[2])),
                   z = static_cast<float>(std::sqrt(1 - u[2])),
                   phi = static_cast<float>(2 * pi * u[3]);
        const Environment::Light found =
            environment.light({r * std::cos(phi), r * std::sin(phi), z});
        const float cosine = z / static_cast<float>(pi);
        if (cosine > 0) {
            value += static_cast<double>(found.radiance.y * static_cast<float>(pi) *
                                         share(cosine, found.pdf));
        }
        sum += value;
        squares += value * value;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean))};
}

}  // namespace

std::vector<StabilityMap> light_maps(const std::vector<double>& widths, int resolution,
                                     int samples) {
    StabilityMap bias;
    bias.id = "lights-sun";
    bias.title = "A sun of one pixel";
    bias.error = "relative error of the irradiance of a plane";
    bias.bound = 5e-3;
    bias.domain = "everywhere";
    bias.outside = "a sky that is black, or whose sum is no float: refused when it is read";
    bias.caption = fmt::format(
        "A constant sky with one bright texel on a plane, {} samples of the renderer's own "
        "sampling "
        "in floats, against the closed form.",
        samples);
    bias.x = {"width of the sky (texels)", widths};
    bias.y = {"sun over sky", log_steps(1, 1e12, resolution)};
    StabilityMap noise = bias;
    noise.id = "lights-sun-noise";
    noise.title = "Noise of a sun of one pixel";
    noise.error = "standard deviation of one sample, over the irradiance";
    noise.bound = 1;
    noise.caption =
        "Without light sampling one sample in ten million finds the sun, and the deviation is a "
        "thousand times the mean.";
    bias.cells.resize(bias.x.at.size() * bias.y.at.size());
    noise.cells = bias.cells;
    for (size_t i = 0; i < bias.cells.size(); ++i) {
        const Sky sky = sky_of(static_cast<int>(bias.x.at[i % bias.x.at.size()]),
                               bias.y.at[i / bias.x.at.size()]);
        const Environment environment(sky.image, 1, glm::dmat4(1), "a sun");
        const Estimate found = irradiance(environment, samples);
        const double exact = exact_irradiance(sky);
        bias.cells[i].error = std::abs(found.mean / exact - 1);
        noise.cells[i].error = found.deviation / exact;
    }
    return {bias, noise};
}

BenchItem light_stability_item() {
    return {"stability-lights", "Stability: suns of one pixel",
            "light sampling of a sky with one bright texel against the closed form",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = options.quick ? light_maps({8, 64, 512}, 4, 4096)
                                            : light_maps({8, 16, 64, 256, 1024, 2048}, 9, 65536);
                return result;
            }};
}

}  // namespace drude
