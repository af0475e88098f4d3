// "auto" carries more wavelengths than eight where the lights need them, and only there.
#include "render/wavelength_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "materials/embedded_tables.h"
#include "render/batch_tracer.h"
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

// ---- surfaces ----------------------------------------------------------------------------------

const std::string broad_sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
const std::string line_541_to_549 = "[380 0 540 0 541 1 549 1 550 0 780 0]";
const std::string edge_at_620 = "[380 0 605 0 635 1 780 1]";

// A sphere; the material is the scene's ninth line, the shape its tenth.
Scene sphere_of(const std::string& material, const std::string& light = broad_sky) {
    return parse_scene(
        "LookAt 0 -5 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 10\n"
        "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 12\n"
        "PixelFilter \"box\"\nIntegrator \"path\"\n\nWorldBegin\n" +
            light + material + "\nShape \"sphere\"\n",
        "matter.pbrt");
}

std::string diffuse(const std::string& spectrum) {
    return "Material \"diffuse\" \"spectrum reflectance\" " + spectrum;
}

Scene filmed(const std::string& substrate, double thickness_nm) {
    Scene scene = sphere_of(R"(Material "conductor" "string material" "Cu")");
    Material& metal =
        std::get<ConductorMaterial>(scene.materials[scene.shapes[0].material]).surface;
    metal.substrate = published_set(substrate);
    metal.layers = {{published_set("Al2O3-Malitson-o"), thickness_nm, 0}};
    return scene;
}

// Root of the mean over pixels and colours of the squared error of 64 samples a pixel, over the
// mean of the picture; that of all wavelengths, with many samples, counts as right.
double error_of(const Scene& scene, int wavelengths) {
    RenderOptions options;
    options.quiet = true;
    options.wavelengths = spectral_bins;
    options.samples_per_pixel = 2048;
    options.seed = 99;
    const std::vector<float> reference = rgb_values(render(scene, options).image, "test");
    options.wavelengths = wavelengths;
    options.samples_per_pixel = 64;
    double sum = 0;
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
        options.seed = seed;
        const std::vector<float> rgb = rgb_values(render(scene, options).image, "test");
        for (size_t i = 0; i < rgb.size(); ++i) {
            const double d = static_cast<double>(rgb[i]) - static_cast<double>(reference[i]);
            sum += d * d / (seeds * static_cast<double>(rgb.size()));
        }
    }
    const double mean = std::accumulate(reference.begin(), reference.end(), 0.0) /
                        static_cast<double>(reference.size());
    return std::sqrt(sum) / mean;
}

TEST(WavelengthChoice, IsEightWhereMatterIsBroad) {
    for (const std::string light : {"LightSource \"infinite\" \"rgb L\" [1 1 1]\n",
                                    "LightSource \"infinite\" \"blackbody L\" [2856]\n"}) {
        for (const std::string metal : {"Cu", "Au", "Ag", "Al", "Fe"}) {
            const Scene scene =
                sphere_of("Material \"conductor\" \"string material\" \"" + metal + "\"", light);
            EXPECT_EQ(automatic(scene), 8) << metal << " " << light;
        }
        EXPECT_EQ(automatic(sphere_of(diffuse("[380 0.2 780 0.8]"), light)), 8);
    }
    EXPECT_EQ(automatic(filmed("Cu-McPeak", 100)), 8);
    EXPECT_EQ(automatic(sphere_of("Material \"diffuse\" \"rgb reflectance\" [0 0 0]")), 8);
    // Nothing shows in the dark.
    EXPECT_EQ(automatic(sphere_of(diffuse(line_541_to_549), "")), 8);
}

TEST(WavelengthChoice, IsRicherWhereMatterIsNarrow) {
    const Scene edge = sphere_of(diffuse(edge_at_620)), line = sphere_of(diffuse(line_541_to_549)),
                fringes = filmed("Si-Green-2008", 1000);
    EXPECT_EQ(automatic(edge), 16);
    EXPECT_EQ(automatic(line), 40);
    EXPECT_EQ(automatic(fringes), 16);
    // What the times are apart by is below 1.3: see decision_costs.cpp.
    EXPECT_GT(error_of(edge, 8), 2 * error_of(edge, 16));
    EXPECT_GT(error_of(line, 8), 4 * error_of(line, 40));
    EXPECT_GT(error_of(fringes, 8), 1.5 * error_of(fringes, 16));
}

// Each way that a constant spectrum gets into a picture.
TEST(WavelengthChoice, LooksAtEveryKindOfMatter) {
    const std::string line = line_541_to_549;
    const std::string texture = "Texture \"line\" \"spectrum\" \"constant\" \"spectrum value\" " +
                                line +
                                "\nTexture \"half\" \"spectrum\" \"checkerboard\" "
                                "\"texture tex1\" \"line\" \"rgb tex2\" [1 1 1]\n";
    const std::string named =
        "MakeNamedMaterial \"line\" \"string type\" \"diffuse\" "
        "\"spectrum reflectance\" " +
        line + "\nMakeNamedMaterial \"white\" \"string type\" \"diffuse\"\n";
    for (const std::string& material :
         {diffuse(line), "Material \"conductor\" \"spectrum reflectance\" " + line,
          "Material \"diffusetransmission\" \"rgb reflectance\" [0 0 0] "
          "\"spectrum transmittance\" " +
              line,
          "Material \"diffusetransmission\" \"rgb transmittance\" [0 0 0] "
          "\"spectrum reflectance\" " +
              line,
          "Material \"coateddiffuse\" \"spectrum reflectance\" " + line,
          "Material \"coatedconductor\" \"spectrum reflectance\" " + line,
          texture + "Material \"diffuse\" \"texture reflectance\" \"half\"",
          named + "Material \"mix\" \"string materials\" [\"white\" \"line\"]"}) {
        EXPECT_EQ(automatic(sphere_of(material)), 40) << material;
    }
    // What no shape is made of is no part of the picture.
    EXPECT_EQ(automatic(sphere_of(named + "NamedMaterial \"white\"")), 8);
    // Films that are left out have no fringes.
    RenderOptions bare;
    bare.films = FilmUse::leave_out;
    EXPECT_EQ(cheapest_exact_wavelengths(filmed("Si-Green-2008", 1000), bare).wavelengths, 8);
}

TEST(WavelengthChoice, NamesWhatDecided) {
    const auto reason = [](const Scene& scene) {
        return cheapest_exact_wavelengths(scene, RenderOptions()).reason;
    };
    const auto names = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    const std::string light =
        reason(sphere_of("Material \"diffuse\" \"rgb reflectance\" [0 0 0]",
                         "LightSource \"infinite\" \"spectrum L\" " + line_541_to_549 + "\n"));
    EXPECT_TRUE(names(light, "the colour of a light would")) << light;
    const std::string edge = reason(sphere_of(diffuse(edge_at_620)));
    EXPECT_TRUE(names(edge, "the surface at matter.pbrt:10:1 in the scene's light")) << edge;
    EXPECT_TRUE(names(edge, "paths of 8 wavelengths")) << edge;
    const std::string line = reason(sphere_of(diffuse(line_541_to_549)));
    EXPECT_TRUE(names(line, "paths of 16 wavelengths")) << line;
    const std::string film = reason(filmed("Si-Green-2008", 1000));
    EXPECT_TRUE(names(film, "Cu")) << film;
}

// 6 micrometres of alumina have a fringe about every 10 nm of blue light: all of 40 wavelengths sit
// on the same place of it.
TEST(WavelengthChoice, IsTheBestWhereNoneIsEnough) {
    const Scene scene = filmed("Si-Green-2008", 6000);
    const int chosen = automatic(scene);
    EXPECT_GT(chosen, 8);
    const double few = error_of(scene, 8);
    EXPECT_GT(few, 1.3 * error_of(scene, chosen));
}

TEST(WavelengthChoice, FillsEverySpectralLayer) {
    RenderOptions options;
    options.spectral = true;
    EXPECT_EQ(cheapest_exact_wavelengths(gold_in_light(600, 60), options).wavelengths, 40);
}

}  // namespace
}  // namespace drude
