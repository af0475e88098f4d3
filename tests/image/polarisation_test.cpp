#include "image/polarisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "image/compare.h"
#include "image/stokes_layer.h"
#include "shared_data.h"
#include "temporary_folder.h"

namespace drude {
namespace {

struct Light {
    double s0, dolp, aolp_deg;
};

// One pixel a Light, in layers "S0.<suffix>" to "S2.<suffix>".
void add_layers(Image& image, const std::string& suffix, const std::vector<Light>& pixels) {
    Channel* s[3] = {};
    for (int i = 0; i < 3; ++i) image.add("S" + std::to_string(i) + "." + suffix);
    for (int i = 0; i < 3; ++i) s[i] = image.find("S" + std::to_string(i) + "." + suffix);
    for (size_t p = 0; p < pixels.size(); ++p) {
        const double angle = 2 * pixels[p].aolp_deg * std::numbers::pi / 180;
        const double polarised = pixels[p].s0 * pixels[p].dolp;
        s[0]->data[p] = static_cast<float>(pixels[p].s0);
        s[1]->data[p] = static_cast<float>(polarised * std::cos(angle));
        s[2]->data[p] = static_cast<float>(polarised * std::sin(angle));
    }
}

Image image_of(int width) {
    Image image;
    image.width = width;
    image.height = 1;
    return image;
}

// Two pixels: polarised intensities (0.5 + 0.3)/2 and (1 + 1)/2; degrees off by 0.2 and 0, angles
// by 10 and 4 degrees, the second across the turn from 179 to 3.
TEST(Polarisation, ErrorsByHandWeightedByPolarisedIntensity) {
    Image a = image_of(2), b = image_of(2);
    const std::string layer = "550,000000nm";
    add_layers(a, layer, {{1.0, 0.5, 40.0}, {2.0, 0.5, 179.0}});
    add_layers(b, layer, {{1.0, 0.3, 30.0}, {2.0, 0.5, 3.0}});
    const auto errors = polarisation_errors(a, b);
    ASSERT_TRUE(errors.has_value());
    const double w0 = 0.4, w1 = 1.0;
    EXPECT_NEAR(errors->dolp_mae, w0 * 0.2 / (w0 + w1), 1e-6);
    EXPECT_NEAR(errors->dolp_bias, w0 * 0.2 / (w0 + w1), 1e-6);
    EXPECT_NEAR(errors->aolp_mae_deg, (w0 * 10 + w1 * 4) / (w0 + w1), 1e-4);
    EXPECT_NEAR(errors->polarised_intensity, (0.3 + 1.0) / 2, 1e-6);
    EXPECT_EQ(errors->layers, std::vector<std::string>{layer});
}

TEST(Polarisation, UnpolarisedLightHasNoAngle) {
    Image a = image_of(1), b = image_of(1);
    add_layers(a, "550,000000nm", {{1.0, 0.0, 0.0}});
    add_layers(b, "550,000000nm", {{1.0, 0.0, 0.0}});
    const auto errors = polarisation_errors(a, b);
    EXPECT_EQ(errors->aolp_mae_deg, 0.0);
    EXPECT_EQ(errors->dolp_mae, 0.0);
    a.find("S0.550,000000nm")->data[0] = 0.0F;
    EXPECT_EQ(polarisation_errors(a, b)->not_physical, 1U);
}

// R, G, B of S1 may be anything outside Rec.709; Y is what counts.
TEST(Polarisation, ColoursAreTakenAsLuminance) {
    Image a = image_of(1), b = image_of(1);
    for (const char* colour : {"R", "G", "B"}) {
        add_layers(a, colour, {{1.0, 0.4, 20.0}});
        add_layers(b, colour, {{1.0, 0.4, 65.0}});
    }
    const auto errors = polarisation_errors(a, b);
    ASSERT_TRUE(errors.has_value());
    EXPECT_EQ(errors->layers, std::vector<std::string>{"Y"});
    EXPECT_NEAR(errors->aolp_mae_deg, 45.0, 1e-4);
    EXPECT_NEAR(errors->dolp_mae, 0.0, 1e-6);
    EXPECT_FALSE(polarisation_errors(image_of(1), b).has_value());
}

TEST(Polarisation, LayerNames) {
    EXPECT_EQ(layer_wavelength("S3.550,250000nm"), 550.25);
    EXPECT_EQ(layer_wavelength("S0.400.5nm"), 400.5);
    for (const char* other :
         {"S0.R", "R", "S4.550nm", "S0.nm", "S0.-3nm", "S0.xnm", "variance.R"}) {
        EXPECT_FALSE(layer_wavelength(other).has_value()) << other;
    }
}

// What other renderers write is compared as it is: Mitsuba's stokes integrator beside its picture,
// pbrt-v4's spectral film.
TEST(Polarisation, ReadsTheLayersOfOtherRenderers) {
    const TemporaryFolder folder;
    Image mitsuba = image_of(1);
    for (const char* name : {"R", "G", "B"}) mitsuba.add(name);
    for (const char* colour : {"R", "G", "B"}) add_layers(mitsuba, colour, {{1.0, 0.4, 20.0}});
    for (const char* colour : {"R", "G", "B"}) mitsuba.add(std::string("S3.") + colour);
    const std::string path = (folder.path() / "mitsuba.exr").string();
    write_exr(path, mitsuba, Compression::zip);
    const Image read = read_image(path);
    CompareOptions options;
    options.channels = parse_channels("S0,S1,S2,S3", read, path);
    EXPECT_EQ(options.channels.size(), 12U);
    const Comparison result = compare_images(read, mitsuba, "a", "b", options);
    EXPECT_TRUE(result.same);
    ASSERT_TRUE(result.polarisation.has_value());
    EXPECT_EQ(result.stokes.size(), 4U);

    Image pbrt = image_of(1);
    for (const char* name : {"R", "G", "B", "S0.400,000000nm", "S0.500,000000nm"}) pbrt.add(name);
    const std::string spectral = (folder.path() / "pbrt.exr").string();
    write_exr(spectral, pbrt, Compression::zip);
    const Image layers = read_image(spectral);
    EXPECT_EQ(parse_channels("S0", layers, spectral).size(), 2U);
    EXPECT_TRUE(compare_images(layers, pbrt, "a", "b", {}).same);
}

TEST(Polarisation, ReadsArtsSpectralPicture) {
    const std::string path = shared_data("exr/art_polarised.exr");
    DRUDE_NEED_SHARED(path);
    const Image image = read_image(path);
    CompareOptions options;
    options.channels = parse_channels("S0,S1,S2,S3", image, path);
    EXPECT_EQ(options.channels.size(), 32U);  // 400 to 680 nm in steps of 40, four components
    const Comparison result = compare_images(image, image, "a", "b", options);
    EXPECT_TRUE(result.same);
    ASSERT_TRUE(result.polarisation.has_value());
    EXPECT_EQ(result.polarisation->layers.size(), 8U);
    EXPECT_GT(result.polarisation->polarised_intensity, 0.0);
    EXPECT_EQ(result.polarisation->aolp_mae_deg, 0.0);
}

}  // namespace
}  // namespace drude
