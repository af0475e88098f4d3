// "auto" carries more wavelengths than eight where the lights need them, and only there.
#include "render/wavelength_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/embedded_tables.h"
#include "render/test_scenes.h"

namespace drude {
namespace {

// A single nanometre is seen at one of the phases alone, as `phases` times its mean.
TEST(PhaseNoise, OfALineIsTheRootOfThePhasesThatMissIt) {
    DenseSpectrum line{};
    line[555 - spectrum_first_nm] = 3;
    for (const int wavelengths : {1, 4, 8, 16, 40}) {
        const double phases = 400.0 / wavelengths;
        EXPECT_NEAR(phase_noise(line, wavelengths), std::sqrt(phases - 1), 1e-9) << wavelengths;
    }
    EXPECT_EQ(phase_noise(line, 400), 0);
    EXPECT_EQ(phase_noise(DenseSpectrum{}, 8), 0);
}

TEST(PhaseNoise, FallsWithTheNumberAndKnowsNoScale) {
    DenseSpectrum bright = illuminant_a();
    for (double& value : bright) value *= 1e6;
    double last = 10;
    for (const int wavelengths : {1, 4, 8, 16, 40}) {
        const double noise = phase_noise(illuminant_a(), wavelengths);
        EXPECT_LT(noise, last);
        EXPECT_NEAR(phase_noise(bright, wavelengths), noise, 1e-9);
        last = noise;
    }
}

// A gold sphere before a lamp whose spectrum is a Gaussian of this width.
Scene gold_in_light(double nanometres, double width, const std::string& more = "") {
    std::string pairs;
    for (int nm = 380; nm <= 780; ++nm) {
        const double t = (nm - nanometres) / width;
        pairs += fmt::format(" {} {}", nm, std::exp(-0.5 * t * t));
    }
    return parse_scene(
        fmt::format("LookAt 0 -5 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 30\n"
                    "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 12\n"
                    "PixelFilter \"box\"\nWorldBegin\n"
                    "AttributeBegin\nTranslate -2 -3 3\n"
                    "AreaLightSource \"diffuse\" \"spectrum L\" [{}]\n"
                    "Shape \"sphere\" \"float radius\" 0.5\nAttributeEnd\n{}"
                    "Material \"conductor\" \"string material\" \"Au\" \"float beta\" 0.4 "
                    "\"string lobe\" \"beckmann\"\nShape \"sphere\"\n",
                    pairs, more),
        "gold.pbrt");
}

int automatic(const Scene& scene) {
    return cheapest_exact_wavelengths(scene, RenderOptions()).wavelengths;
}

constexpr int seeds = 8;

// Mean over pixels and colours of the variance between seeds; the mean of the picture with it.
double variance(const Scene& scene, int wavelengths, double* mean) {
    std::vector<double> sum, squares;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderOptions options;
        options.samples_per_pixel = 32;
        options.wavelengths = wavelengths;
        options.seed = 40 + static_cast<uint64_t>(seed);
        options.quiet = true;
        const Image image = render(scene, options).image;
        const std::vector<float> rgb = rgb_values(image, "test");
        sum.resize(rgb.size());
        squares.resize(rgb.size());
        for (size_t i = 0; i < rgb.size(); ++i) {
            const double value = static_cast<double>(rgb[i]);
            sum[i] += value / seeds;
            squares[i] += value * value / seeds;
        }
    }
    double total = 0;
    *mean = 0;
    for (size_t i = 0; i < sum.size(); ++i) {
        total += (squares[i] - sum[i] * sum[i]) * seeds / (seeds - 1);
        *mean += sum[i] / static_cast<double>(sum.size());
    }
    return total / static_cast<double>(sum.size());
}

TEST(WavelengthChoice, IsEightWhereLightsAreBroad) {
    for (const EmbeddedTable& table : embedded_scenes()) {
        if (table.name == "killeroo-gold") continue;  // its geometry is not the project's
        const Scene scene = parse_scene(std::string(table.text),
                                        DRUDE_SOURCE_DIR "/scenes/" + std::string(table.name));
        EXPECT_EQ(automatic(scene), 8) << table.name;
    }
    const Scene broad = gold_in_light(600, 60);
    EXPECT_EQ(automatic(broad), 8);
    // The richer one changes nothing that could be measured.
    double mean_8 = 0, mean_40 = 0;
    const double with_8 = variance(broad, 8, &mean_8), with_40 = variance(broad, 40, &mean_40);
    EXPECT_LT(with_8, 1.3 * with_40);
    EXPECT_NEAR(mean_8 / mean_40, 1, 0.01);
}

TEST(WavelengthChoice, IsRicherWhereALightIsNarrow) {
    const Scene band = gold_in_light(600, 12);
    EXPECT_EQ(automatic(band), 16);
    const Scene line = gold_in_light(589, 2);
    EXPECT_EQ(automatic(line), 40);
    double mean_8 = 0, mean_16 = 0, mean_40 = 0;
    // The colours of a pixel may lean on each other: three as one.
    const auto sigma = [](double a, double b) { return std::sqrt((a + b) / (144 * seeds)); };
    const double band_8 = variance(band, 8, &mean_8), band_16 = variance(band, 16, &mean_16);
    EXPECT_GT(band_8, 1.3 * band_16);
    EXPECT_NEAR(mean_8, mean_16, 4 * sigma(band_8, band_16));
    const double line_8 = variance(line, 8, &mean_8), line_40 = variance(line, 40, &mean_40);
    EXPECT_GT(line_8, 4 * line_40);
    EXPECT_NEAR(mean_8, mean_40, 4 * sigma(line_8, line_40));
    // One narrow lamp among broad light is enough.
    const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
    EXPECT_EQ(automatic(gold_in_light(589, 2, sky)), 40);
}

TEST(WavelengthChoice, FillsEverySpectralLayer) {
    RenderOptions options;
    options.spectral = true;
    EXPECT_EQ(cheapest_exact_wavelengths(gold_in_light(600, 60), options).wavelengths, 40);
}

}  // namespace
}  // namespace drude
