#include "scene/colour_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene_text.h"

namespace drude {
namespace {

constexpr ColourSpace every_space[] = {ColourSpace::srgb, ColourSpace::rec2020, ColourSpace::dci_p3,
                                       ColourSpace::aces2065_1};

// Published matrices are rounded and of D65 = (0.3127, 0.3290); the project's D65 is the tabulated
// one, 1e-4 away.
void expect_matrix(ColourSpace space, const double (&rows)[3][3]) {
    for (size_t column = 0; column < 3; ++column) {
        RGB unit{};
        unit[column] = 1;
        const RGB srgb = matter_to_srgb(space, unit);
        for (size_t row = 0; row < 3; ++row) {
            EXPECT_NEAR(srgb[row], rows[row][column], 2e-3)
                << colour_space_name(space) << " " << row << " " << column;
        }
    }
}

TEST(ColourSpace, TheMatricesAreThosePublished) {
    // Recommendation ITU-R BT.2407, section 2.
    expect_matrix(
        ColourSpace::rec2020,
        {{1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}});
    // Display P3 to sRGB, as in CSS Color 4's sample code (of their XYZ matrices).
    expect_matrix(ColourSpace::dci_p3,
                  {{1.2249, -0.2249, 0}, {-0.0421, 1.0421, 0}, {-0.0196, -0.0786, 1.0983}});
    // ACES2065-1 to Rec. 709 with Bradford adaptation (S-2014-004's conversions, as in
    // OpenColorIO).
    expect_matrix(
        ColourSpace::aces2065_1,
        {{2.5217, -1.1341, -0.3876}, {-0.2765, 1.3727, -0.0962}, {-0.0154, -0.1530, 1.1684}});
}

TEST(ColourSpace, PrimariesAndWhitesKeepTheirChromaticity) {
    const auto expect_xy = [](ColourSpace space, const RGB& rgb, double x, double y) {
        const XYZ xyz = rgb_to_xyz(light_to_srgb(space, rgb));
        const double sum = xyz[0] + xyz[1] + xyz[2];
        EXPECT_NEAR(xyz[0] / sum, x, 1e-9) << colour_space_name(space);
        EXPECT_NEAR(xyz[1] / sum, y, 1e-9) << colour_space_name(space);
    };
    expect_xy(ColourSpace::rec2020, {1, 0, 0}, 0.708, 0.292);
    expect_xy(ColourSpace::rec2020, {0, 2, 0}, 0.170, 0.797);
    expect_xy(ColourSpace::rec2020, {0, 0, 1}, 0.131, 0.046);
    expect_xy(ColourSpace::dci_p3, {1, 0, 0}, 0.680, 0.320);
    expect_xy(ColourSpace::dci_p3, {0, 1, 0}, 0.265, 0.690);
    expect_xy(ColourSpace::dci_p3, {0, 0, 1}, 0.150, 0.060);
    expect_xy(ColourSpace::aces2065_1, {1, 0, 0}, 0.7347, 0.2653);
    expect_xy(ColourSpace::aces2065_1, {0, 1, 0}, 0, 1);
    expect_xy(ColourSpace::aces2065_1, {0, 0, 1}, 0.0001, -0.0770);
    expect_xy(ColourSpace::aces2065_1, {1, 1, 1}, 0.32168, 0.33767);
}

TEST(ColourSpace, WhiteIsWhiteAndHasLuminanceOne) {
    for (const ColourSpace space : every_space) {
        EXPECT_NEAR(rgb_to_xyz(light_to_srgb(space, {1, 1, 1}))[1], 1, 1e-12);
        for (const double value : matter_to_srgb(space, {0.3, 0.3, 0.3})) {
            EXPECT_NEAR(value, 0.3, 1e-12) << colour_space_name(space);
        }
    }
}

TEST(ColourSpace, WhatIsOutOfGamutKeepsItsLuminance) {
    const RGB inside = {0, 0.5, 1};
    EXPECT_EQ(into_gamut(inside, 1), inside);
    for (const RGB& rgb : {RGB{1.66, -0.12, -0.02}, RGB{-0.58, 1.13, -0.1}, RGB{-0.07, 0, 1.1}}) {
        for (const double highest : {1.0, 1e300}) {
            const RGB pale = into_gamut(rgb, highest);
            EXPECT_NEAR(rgb_to_xyz(pale)[1], rgb_to_xyz(rgb)[1], 1e-12);
            const auto [low, high] = std::minmax_element(pale.begin(), pale.end());
            EXPECT_GE(*low, 0);
            EXPECT_LE(*high, highest);
            // As much of its colour as there is room for: it lies on the edge.
            EXPECT_TRUE(*low < 1e-12 || *high > highest - 1e-12);
        }
    }
    // Luminance below 0, as the blue of ACES has it, is black.
    EXPECT_EQ(into_gamut({-0.4, -0.1, 1.2}, 1), (RGB{0, 0, 0}));
}

RGB diffuse_rgb(const Scene& scene, size_t material) {
    const auto& diffuse = std::get<DiffuseMaterial>(scene.materials.at(material));
    // Under D65 the basis has the RGB it was given.
    DenseSpectrum lit = diffuse.reflectance.constant;
    for (size_t i = 0; i < lit.size(); ++i) lit[i] *= illuminant_d65()[i];
    RGB rgb = xyz_to_rgb(spectrum_to_xyz(lit));
    for (double& value : rgb) value /= spectrum_to_xyz(illuminant_d65())[1];
    return rgb;
}

TEST(ColourSpace, BelongsToTheGraphicsState) {
    const Scene scene = world_of(
        "AttributeBegin ColorSpace \"rec2020\" Material \"diffuse\" \"rgb reflectance\" [ .5 .4 .3 "
        "]"
        "\nAttribute \"material\" \"rgb reflectance\" [ .5 .4 .3 ] ColorSpace \"srgb\" "
        "Material \"diffuse\" AttributeEnd\n"
        "Material \"diffuse\" \"rgb reflectance\" [ .5 .4 .3 ]");
    EXPECT_TRUE(scene.warnings.empty());
    const RGB expected = matter_to_srgb(ColourSpace::rec2020, {.5, .4, .3});
    const RGB srgb = {.5, .4, .3};
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(diffuse_rgb(scene, 1)[c], expected[c], 2e-3);
        EXPECT_NEAR(diffuse_rgb(scene, 2)[c], expected[c], 2e-3);  // where the default was given
        EXPECT_NEAR(diffuse_rgb(scene, 3)[c], srgb[c], 2e-3);
    }
    EXPECT_GT(std::abs(expected[0] - srgb[0]), 0.03);
}

TEST(ColourSpace, WhatSrgbCannotHoldIsSaid) {
    const Scene scene = world_of(
        "ColorSpace \"rec2020\"\nMaterial \"diffuse\" \"rgb reflectance\" [ 1 0 0 ]\n"
        "LightSource \"distant\" \"rgb L\" [ 0 2 0 ]\nMaterial \"diffuse\" \"rgb reflectance\" [ 1 "
        "1 1 ]");
    ASSERT_EQ(scene.stand_ins.size(), 2u);
    EXPECT_PLACE_AND_TEXT(scene.stand_ins[0], "t.pbrt:3:20", "ColorSpace \"rec2020\" is outside");
    EXPECT_PLACE_AND_TEXT(scene.stand_ins[1], "t.pbrt:4:23", "'L': the colour 0 2 0");
    for (const double value : scene.distant_lights.at(0).irradiance) EXPECT_GE(value, 0);
    EXPECT_NEAR(spectrum_to_xyz(scene.distant_lights[0].irradiance)[1],
                2 * rgb_to_xyz(light_to_srgb(ColourSpace::rec2020, {0, 1, 0}))[1], 2e-2);
    for (const double value :
         std::get<DiffuseMaterial>(scene.materials.at(2)).reflectance.constant) {
        EXPECT_NEAR(value, 1, 1e-12);
    }
    EXPECT_PLACE_AND_TEXT(
        world_error_of("ColorSpace \"rec2020\" Material \"diffuse\" \"rgb reflectance\" [ 0 0 2 ]"),
        "t.pbrt:2:65", "is 2; expected 0 to 1");
}

TEST(ColourSpace, AWhiteLightHasLuminanceOneInEverySpace) {
    for (const ColourSpace space : every_space) {
        const Scene scene = world_of("ColorSpace \"" + std::string(colour_space_name(space)) +
                                     "\" LightSource \"distant\" \"rgb L\" [ 1 1 1 ]");
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
        EXPECT_NEAR(spectrum_to_xyz(scene.distant_lights.at(0).irradiance)[1], 1, 1e-3);
    }
}

TEST(ColourSpace, TheFilmStaysLinearSrgb) {
    EXPECT_TRUE(warns(scene_of("ColorSpace \"dci-p3\" Film \"rgb\" WorldBegin"),
                      "linear sRGB, not in the ColorSpace \"dci-p3\""));
    EXPECT_TRUE(scene_of("Film \"rgb\" ColorSpace \"dci-p3\" WorldBegin").warnings.empty());
}

}  // namespace
}  // namespace drude
