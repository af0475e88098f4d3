// Materials other than conductors: glass, coats, diffusers, mixtures, optical elements.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/glasses.h"
#include "scene_text.h"

namespace drude {
namespace {

template <class Kind>
Kind material(const Scene& scene, size_t index = 1) {
    return std::get<Kind>(scene.materials.at(index));
}
template <class Kind>
Kind material(const std::string& text) {
    return material<Kind>(world_of("Material " + text));
}

TEST(Materials, DielectricsHavePbrtsDefaultsAndSpectra) {
    const auto plain = material<DielectricMaterial>("\"dielectric\"");
    EXPECT_EQ(plain.eta[7], 1.5);
    EXPECT_EQ(plain.alpha, 0);
    EXPECT_FALSE(plain.is_dispersive());
    const auto rough =
        material<DielectricMaterial>("\"dielectric\" \"float eta\" 1.3 \"float roughness\" 0.04");
    EXPECT_EQ(rough.eta[0], 1.3);
    EXPECT_DOUBLE_EQ(rough.alpha, 0.2);
    EXPECT_DOUBLE_EQ(material<DielectricMaterial>("\"dielectric\" \"float roughness\" 0.04 \"bool "
                                                  "remaproughness\" false")
                         .alpha,
                     0.04);
    const Scene scene = world_of("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"");
    const auto glass = material<DielectricMaterial>(scene);
    EXPECT_TRUE(glass.is_dispersive());
    EXPECT_EQ(glass.eta[100], find_glass("BK7")->n(480));
    EXPECT_TRUE(scene.stand_ins.empty());
    const auto sloped =
        material<DielectricMaterial>("\"dielectric\" \"spectrum eta\" [ 380 1.6 780 1.4 ]");
    EXPECT_NEAR(sloped.eta[200], 1.5, 1e-12);
    EXPECT_FALSE(material<DielectricMaterial>("\"dielectric\" \"spectrum eta\" [ 300 1.5 800 1.5 ]")
                     .is_dispersive());
    EXPECT_EQ(material<ThinDielectricMaterial>("\"thindielectric\" \"float eta\" 1.7").eta[3], 1.7);
}

// pbrt-v4 calls three of Schott's flint glasses F5, F10 and F11.
TEST(Materials, EveryGlassHasItsOwnIndex) {
    const char* names[] = {"BK7", "BAF10", "FK51A", "LASF9", "F5",
                           "F10", "F11",   "SF5",   "SF10",  "SF11"};
    for (const char* name : names) {
        const Scene scene = world_of(
            fmt::format("Material \"thindielectric\" \"spectrum eta\" \"glass-{}\"", name));
        EXPECT_EQ(material<ThinDielectricMaterial>(scene).eta[50], find_glass(name)->n(430));
        EXPECT_TRUE(scene.stand_ins.empty()) << name;
    }
}

TEST(Materials, CoatsHaveAnInterfaceAndABase) {
    const auto paint = material<CoatedMaterial>(
        "\"coateddiffuse\" \"rgb reflectance\" [ .2 .2 .2 ] \"float roughness\" 0.01 \"float "
        "thickness\" 0.5 \"float eta\" 1.6");
    EXPECT_EQ(paint.eta[9], 1.6);
    EXPECT_DOUBLE_EQ(paint.alpha, 0.1);
    EXPECT_EQ(paint.thickness, 0.5);
    EXPECT_NEAR(std::get<DiffuseMaterial>(paint.base).reflectance.constant[100], 0.2, 1e-6);

    const Scene scene = world_of(
        "Material \"coatedconductor\" \"spectrum conductor.eta\" \"metal-Ag-eta\" \"spectrum "
        "conductor.k\" \"metal-Ag-k\" \"float conductor.roughness\" 0.01 \"float "
        "interface.roughness\" 0.09 \"spectrum interface.eta\" \"glass-BK7\"");
    const auto lacquer = material<CoatedMaterial>(scene);
    const auto& metal = std::get<ConductorMaterial>(lacquer.base);
    EXPECT_EQ(metal.surface.substrate.name, published_set("Ag").name);
    EXPECT_DOUBLE_EQ(metal.alpha, 0.1);
    EXPECT_DOUBLE_EQ(lacquer.alpha, 0.3);
    EXPECT_EQ(lacquer.thickness, 0.01);
    EXPECT_EQ(lacquer.eta[0], find_glass("BK7")->n(380));
    EXPECT_TRUE(scene.stand_ins.empty());
}

TEST(Materials, CoatsThatScatterHaveAStandIn) {
    const Scene scene = world_of(
        "Material \"coateddiffuse\" \"rgb albedo\" [ .5 .5 .5 ] \"float g\" 0.2\n"
        "Material \"coateddiffuse\" \"rgb albedo\" [ 0 0 0 ] \"float g\" 0.2");
    ASSERT_EQ(scene.stand_ins.size(), 1u);
    EXPECT_PLACE_AND_TEXT(scene.stand_ins[0], "t.pbrt:2:26", "a clear one stands in");
}

TEST(Materials, DiffusersPassNoMoreThanTheyGet) {
    const auto leaf = material<DiffuseTransmissionMaterial>(
        "\"diffusetransmission\" \"rgb reflectance\" [ .2 .2 .2 ] \"rgb transmittance\" [ .4 .4 .4 "
        "] \"float scale\" 0.5");
    EXPECT_NEAR(leaf.reflectance.constant[50], 0.1, 1e-6);
    EXPECT_NEAR(leaf.transmittance.constant[50], 0.2, 1e-6);
    EXPECT_NEAR(
        material<DiffuseTransmissionMaterial>("\"diffusetransmission\"").transmittance.constant[0],
        0.25, 1e-15);
    const Scene bright = world_of(
        "Material \"diffusetransmission\" \"rgb reflectance\" [ 1 1 1 ] \"rgb transmittance\" [ 1 "
        "1 1 ]");
    EXPECT_EQ(bright.stand_ins.size(), 1u);
    const auto held = material<DiffuseTransmissionMaterial>(bright);
    EXPECT_NEAR(held.reflectance.constant[0], 0.5, 1e-6);
    // A texture is scaled by another on top of it.
    const Scene textured = world_of(
        "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ .4 .4 .4 ] \"rgb tex2\" [ .2 "
        ".2 "
        ".2 ]\nMaterial \"diffusetransmission\" \"texture reflectance\" \"t\" \"float scale\" 0.5");
    const auto& reflectance = material<DiffuseTransmissionMaterial>(textured).reflectance;
    ASSERT_GE(reflectance.texture, 0);
    const auto& scale = std::get<ScaleTexture<SpectrumValue>>(
        textured.spectrum_textures.at(static_cast<size_t>(reflectance.texture)));
    EXPECT_EQ(scale.scale.constant, 0.5);
    EXPECT_LT(scale.texture.texture, reflectance.texture);
}

TEST(Materials, MixesNameMaterialsThatMayFollow) {
    const Scene scene = world_of(
        "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
        "Material \"mix\" \"string materials\" [ \"a\" \"b\" ] \"float amount\" 0.25\n"
        "Shape \"sphere\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"mix\" \"string materials\" [ \"a\" \"none\" ]\n"
        "MakeNamedMaterial \"none\" \"string type\" \"interface\"\n");
    const int index = scene.shapes.at(0).material;
    const auto mix = material<MixMaterial>(scene, static_cast<size_t>(index));
    EXPECT_EQ(mix.amount.constant, 0.25);
    EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(scene.materials.at(mix.first)));
    const auto inner = material<MixMaterial>(scene, static_cast<size_t>(mix.second));
    EXPECT_EQ(inner.first, mix.first);
    EXPECT_EQ(inner.second, -1);
    EXPECT_EQ(inner.amount.constant, 0.5);
}

TEST(Materials, MixesOfThemselvesAreRefused) {
    EXPECT_PLACE_AND_TEXT(
        world_error_of("MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [ "
                       "\"b\" \"b\" ]\n"
                       "MakeNamedMaterial \"b\" \"string type\" \"mix\" \"string materials\" [ "
                       "\"c\" \"a\" ]\n"
                       "MakeNamedMaterial \"c\" \"string type\" \"diffuse\"\n"),
        "t.pbrt:2:1", "made of itself");
    // The same part twice is no circle.
    EXPECT_NO_THROW(world_of(
        "MakeNamedMaterial \"c\" \"string type\" \"diffuse\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"mix\" \"string materials\" [ \"c\" \"c\" ]\n"
        "MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [ \"b\" \"b\" ]\n"));
}

TEST(Materials, OpticalElementsAreTheProjectsOwn) {
    using Kind = OpticalElementMaterial::Kind;
    const auto linear = material<OpticalElementMaterial>(
        "\"linearpolariser\" \"float axis\" 30 \"float transmittance\" 0.9");
    EXPECT_EQ(linear.kind, Kind::linear_polariser);
    EXPECT_EQ(linear.axis_deg, 30);
    EXPECT_EQ(linear.transmittance, 0.9);
    const auto plate = material<OpticalElementMaterial>(
        "\"retarder\" \"float axis\" -45 \"float retardance\" 180");
    EXPECT_EQ(plate.kind, Kind::retarder);
    EXPECT_EQ(plate.retardance_deg, 180);
    EXPECT_EQ(material<OpticalElementMaterial>("\"retarder\"").retardance_deg, 90);
    const auto circular =
        material<OpticalElementMaterial>("\"circularpolariser\" \"bool righthanded\" false");
    EXPECT_EQ(circular.kind, Kind::circular_polariser);
    EXPECT_FALSE(circular.right_handed);
}

TEST(Materials, WhatIsNotModelledHasAStandIn) {
    const Scene scene =
        world_of("Material \"hair\"\nMaterial \"subsurface\"\nMaterial \"measured\"");
    EXPECT_EQ(scene.stand_ins.size(), 3u);
    EXPECT_NEAR(material<DiffuseMaterial>(scene).reflectance.constant[100], 0.5, 1e-15);
}

TEST(Materials, BadValuesHaveTheirPlace) {
    const struct {
        const char *text, *place, *part;
    } cases[] = {
        {"Material \"dielectric\" \"float eta\" 0", "t.pbrt:2:35", "eta is 0; expected"},
        {"Material \"dielectric\" \"spectrum eta\" [ 400 1.5 700 -1 ]", "t.pbrt:2:40",
         "refractive index"},
        {"Material \"dielectric\" \"float roughness\" -1", "t.pbrt:2:23", "expected 0 to 10"},
        {"Material \"coateddiffuse\" \"float thickness\" -1", "t.pbrt:2:44", "thickness"},
        {"Material \"retarder\" \"float transmittance\" 2", "t.pbrt:2:43", "transmittance"},
        {"Material \"retarder\" \"float axes\" 2", "t.pbrt:2:21", "'axis'"},
        {"Material \"linearpolarizer\"", "t.pbrt:2:10", "linearpolariser"},
        {"Material \"dielectric\" \"spectrum eta\" \"glass-BK8\"", "t.pbrt:2:38", "glass-BK7"},
        {"Material \"mix\"", "t.pbrt:2:1", "0 materials are named"},
        {"Material \"mix\" \"string materials\" [ \"a\" ]", "t.pbrt:2:16", "1 materials"},
        {"Material \"mix\" \"string materials\" [ \"a\" \"b\" ]", "t.pbrt:2:37",
         "there is no material 'a'"},
        {"MakeNamedMaterial \"a\" \"string type\" \"diffuse\" Material \"mix\" \"string "
         "materials\" [ \"a\" \"a\" ] \"float amount\" 1.5",
         "t.pbrt:2:93", "expected 0 to 1"},
    };
    for (const auto& c : cases) {
        const std::string message = world_error_of(c.text);
        EXPECT_EQ(message.rfind(std::string(c.place) + ": ", 0), 0u) << message;
        EXPECT_TRUE(contains(message, c.part)) << message;
    }
}

}  // namespace
}  // namespace drude
