// Materials, textures and lights.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "materials/material.h"
#include "scene_text.h"
#include "temporary_folder.h"

namespace drude {
namespace {

const double pi = 3.14159265358979323846;

ConductorMaterial conductor(const Scene& scene) {
    return std::get<ConductorMaterial>(scene.materials.at(1));
}
ConductorMaterial conductor(const std::string& parameters) {
    return conductor(world_of("Material \"conductor\" " + parameters));
}

TEST(Conductor, IsCopperByDefaultAndSaysSo) {
    const Scene scene = world_of("Material \"conductor\"");
    const ConductorMaterial metal = conductor(scene);
    EXPECT_EQ(metal.surface.substrate.name, published_set("Cu").name);
    EXPECT_EQ(metal.alpha, 0);
    EXPECT_EQ(metal.surface.lobe, Lobe::trowbridge_reitz);
    EXPECT_EQ(metal.surface.masking, Masking::smith);
    EXPECT_TRUE(warns(scene, "'metal-Cu-eta' is n of this project's set Cu-"));
}

TEST(Conductor, RoughnessIsPbrts) {
    EXPECT_DOUBLE_EQ(conductor("\"float roughness\" 0.04").alpha, 0.2);
    EXPECT_DOUBLE_EQ(conductor("\"float roughness\" 0.04 \"bool remaproughness\" false").alpha,
                     0.04);
    const Scene scene =
        world_of("Material \"conductor\" \"float uroughness\" 0.04 \"float vroughness\" 0.09");
    EXPECT_NEAR(conductor(scene).alpha, std::sqrt(0.06), 1e-15);
    EXPECT_EQ(scene.stand_ins.size(), 1u);
}

TEST(Conductor, EtaAndKComeAsPairsNamesAndFiles) {
    const ConductorMaterial pairs =
        conductor("\"spectrum eta\" [ 400 1 700 4 ] \"spectrum k\" [ 300 2 500 4 900 8 ]");
    const OpticalConstants& constants = pairs.surface.substrate;
    ASSERT_EQ(constants.wavelength_nm, (std::vector<double>{300, 400, 500, 700, 900}));
    EXPECT_NEAR(constants.at(500).n, 2, 1e-15);
    EXPECT_NEAR(constants.at(400).k, 3, 1e-15);
    EXPECT_NEAR(constants.at(900).n, 4, 1e-15);

    TemporaryFolder folder;
    std::ofstream(folder.file("n.spd")) << "# n\n400 1.5\n800, 2.5 # end\n";
    const Scene scene = parse_scene(
        "WorldBegin Material \"conductor\" \"spectrum eta\" \"n.spd\" \"spectrum k\" "
        "\"metal-Ag-k\"",
        folder.file("s.pbrt"));
    EXPECT_NEAR(conductor(scene).surface.substrate.at(600).n, 2, 1e-12);
    EXPECT_NEAR(conductor(scene).surface.substrate.at(600).k, published_set("Ag").at(600).k, 1e-12);
    EXPECT_TRUE(warns(scene, "covers 400 to 800 nm"));
    std::ofstream(folder.file("n.spd")) << "400 1.5\n300 2.5\n";
    try {
        parse_scene("WorldBegin Material \"conductor\" \"spectrum eta\" \"n.spd\"",
                    folder.file("s.pbrt"));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_TRUE(contains(error.message(), "n.spd:2:1: wavelength 300")) << error.message();
    }
}

TEST(Conductor, TakesTheProjectsMaterialsAndLobes) {
    const ConductorMaterial metal = conductor(
        "\"string material\" \"Ag\" \"string lobe\" \"blinn-phong\" \"float beta\" 0.011774");
    EXPECT_EQ(metal.surface.substrate.name, published_set("Ag").name);
    EXPECT_EQ(metal.surface.lobe, Lobe::blinn_phong);
    EXPECT_EQ(metal.surface.masking, Masking::v_groove);
    EXPECT_EQ(metal.surface.beta, 0.011774);
    EXPECT_LT(metal.alpha, 0);
    EXPECT_EQ(conductor("\"string lobe\" \"beckmann\" \"float beta\" 0.1 \"string masking\" "
                        "\"v-groove\"")
                  .surface.masking,
              Masking::v_groove);

    TemporaryFolder folder;
    Material material = material_from_set(published_set("Au"));
    material.lobe = Lobe::gaussian;
    material.masking = Masking::v_groove;
    material.beta = 0.25;
    write_material(folder.file("au.json"), material);
    const std::string file = folder.file("s.pbrt");
    const Scene plain =
        parse_scene("WorldBegin Material \"conductor\" \"string material\" \"au.json\"", file);
    EXPECT_EQ(conductor(plain).surface.lobe, Lobe::gaussian);
    EXPECT_EQ(conductor(plain).surface.beta, 0.25);
    EXPECT_LT(conductor(plain).alpha, 0);
    const Scene smoother = parse_scene(
        "WorldBegin Material \"conductor\" \"string material\" \"au.json\" \"float beta\" 0.125",
        file);
    EXPECT_EQ(conductor(smoother).surface.lobe, Lobe::gaussian);
    EXPECT_EQ(conductor(smoother).surface.beta, 0.125);
    // Its bytes count into the hash.
    material.beta = 0.5;
    write_material(folder.file("au.json"), material);
    EXPECT_NE(parse_scene("WorldBegin Material \"conductor\" \"string material\" \"au.json\"", file)
                  .sha256,
              plain.sha256);
}

TEST(Conductor, ReflectanceStandsForAMetal) {
    const ConductorMaterial metal = conductor("\"rgb reflectance\" [ 1 1 1 ]");
    ASSERT_TRUE(metal.reflectance.has_value());
    for (const double value : metal.reflectance->constant) EXPECT_NEAR(value, 1, 1e-6);
}

TEST(Textures, HaveOneValue) {
    const Scene scene = world_of(
        "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [ .4 .4 .4 ]\n"
        "Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"float scale\" 0.5\n"
        "Texture \"c\" \"spectrum\" \"mix\" \"texture tex1\" \"b\" \"rgb tex2\" [ 1 1 1 ] \"float "
        "amount\" 0.25\n"
        "Material \"diffuse\" \"texture reflectance\" \"c\"\n"
        "Texture \"r\" \"float\" \"constant\" \"float value\" 0.09\n"
        "Material \"conductor\" \"texture roughness\" \"r\"");
    EXPECT_NEAR(std::get<DiffuseMaterial>(scene.materials.at(1)).reflectance.constant[7],
                0.2 * 0.75 + 0.25, 1e-6);
    EXPECT_DOUBLE_EQ(std::get<ConductorMaterial>(scene.materials.at(2)).alpha, 0.3);
}

TEST(Textures, ThatChangeOverASurfaceAreKept) {
    const Scene scene = world_of(
        "Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0.04 \"float tex2\" 0.16\n"
        "Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.2 .2 .2]\n"
        "Material \"conductor\" \"texture roughness\" \"r\" \"texture reflectance\" \"c\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"c\"\n"
        "Material \"conductor\" \"texture uroughness\" \"r\"\n"
        "Material \"conductor\" \"texture eta\" \"c\"\n");
    const auto metal = std::get<ConductorMaterial>(scene.materials.at(1));
    ASSERT_TRUE(metal.textured_roughness && metal.reflectance);
    EXPECT_EQ(metal.textured_roughness->roughness.texture, 0);
    EXPECT_TRUE(metal.textured_roughness->remap);
    EXPECT_NEAR(metal.alpha, std::sqrt(0.1), 1e-12);
    EXPECT_EQ(metal.reflectance->texture, 0);
    EXPECT_NEAR(metal.reflectance->constant[9], 0.1, 1e-6);
    EXPECT_EQ(std::get<DiffuseMaterial>(scene.materials.at(2)).reflectance.texture, 0);
    EXPECT_TRUE(std::get<ConductorMaterial>(scene.materials.at(3)).textured_roughness);
    ASSERT_EQ(scene.stand_ins.size(), 2u);
    EXPECT_TRUE(contains(scene.stand_ins[0], "that of u stands in for both"));
    EXPECT_TRUE(contains(scene.stand_ins[1], "'eta' cannot change over a surface here"));
}

TEST(Lights, AreNormalisedAsInPbrt) {
    // rgb: D65 of Y = 1 times the colour. Everything else: Y = 1, then scale.
    const Scene scene = world_of(
        "LightSource \"infinite\" \"rgb L\" [ 3 3 3 ] \"float scale\" 2\n"
        "LightSource \"infinite\" \"spectrum L\" [ 300 5 900 5 ] \"float scale\" 2\n"
        "LightSource \"infinite\" \"blackbody L\" 3000\n"
        "LightSource \"infinite\" \"spectrum L\" \"stdillum-D65\" \"float illuminance\" 10\n"
        "LightSource \"infinite\"\n"
        "LightSource \"infinite\" \"spectrum L\" [ 300 0 900 0 ]");
    const double expected[] = {6, 2, 1, 10 / pi, 1, 0};
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(luminance(scene.infinite_lights.at(i).radiance), expected[i], 1e-9) << i;
    }
    const DenseSpectrum& d65 = illuminant_d65();
    const DenseSpectrum& grey = scene.infinite_lights[0].radiance;
    EXPECT_NEAR(grey[50] / grey[300], d65[50] / d65[300], 1e-6);
    EXPECT_TRUE(contains(world_error_of("LightSource \"infinite\" \"spectrum L\" [ 300 1 301 0 ]"),
                         "no luminance"));
}

TEST(Lights, DistantLightTravelsFromItsFromToItsTo) {
    const Scene scene = world_of(
        "LightSource \"distant\"\n"
        "Rotate 90 1 0 0\nLightSource \"distant\" \"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 0 0 "
        "] "
        "\"float illuminance\" 7");
    EXPECT_LT(glm::distance(scene.distant_lights.at(0).direction, glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_LT(glm::distance(scene.distant_lights.at(1).direction, glm::dvec3(0, 0, -1)), 1e-15);
    EXPECT_NEAR(luminance(scene.distant_lights[0].irradiance), 1, 1e-9);
    EXPECT_NEAR(luminance(scene.distant_lights[1].irradiance), 7, 1e-9);
}

TEST(Lights, AreaLightsBelongToTheirShapes) {
    const Scene scene = world_of(
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 2 2 2 ] \"bool twosided\" true\n"
        "Shape \"sphere\" Shape \"sphere\" Material \"interface\" Shape \"sphere\" AttributeEnd\n"
        "Shape \"sphere\"\n"
        "AreaLightSource \"diffuse\" \"float power\" 100 Shape \"sphere\" \"float radius\" 2");
    ASSERT_EQ(scene.shapes.size(), 5u);
    EXPECT_EQ(scene.shapes[0].area_light, 0);
    EXPECT_EQ(scene.shapes[1].area_light, 0);
    EXPECT_EQ(scene.shapes[2].area_light, -1);
    EXPECT_EQ(scene.shapes[3].area_light, -1);
    ASSERT_EQ(scene.shapes[4].area_light, 1);
    EXPECT_TRUE(scene.area_lights[0].two_sided);
    EXPECT_NEAR(luminance(scene.area_lights[0].radiance), 2, 1e-9);
    // Lambert: power = pi L A.
    EXPECT_NEAR(luminance(scene.area_lights[1].radiance), 100 / (pi * 16 * pi), 1e-9);
    EXPECT_TRUE(warns(scene, "\"interface\" emits no light"));
}

TEST(Lights, APolariserEmitsNone) {
    const Scene scene = parse_scene(
        "WorldBegin\nMaterial \"diffuse\"\nShape \"sphere\"\n"
        "MakeNamedMaterial \"p\" \"string type\" \"linearpolariser\"\nNamedMaterial \"p\"\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nShape \"disk\"\n"
        "Material \"retarder\"\nShape \"disk\"\nMaterial \"diffuse\"\nShape \"disk\"\n",
        "p.pbrt");
    ASSERT_EQ(scene.shapes.size(), 4u);
    EXPECT_EQ(scene.shapes[1].area_light, -1);
    EXPECT_EQ(scene.shapes[2].area_light, -1);
    EXPECT_EQ(scene.shapes[3].area_light, 0);
    EXPECT_TRUE(warns(scene, "a polariser or retarder emits no light"));
}

TEST(Lights, AnEnvironmentIsResolvedAndCountedIntoTheHash) {
    TemporaryFolder folder;
    std::ofstream(folder.file("e.exr")) << "one";
    const std::string text =
        "WorldBegin Rotate 90 0 0 1 LightSource \"infinite\" \"string filename\" \"e.exr\" \"float "
        "scale\" 3";
    const Scene scene = parse_scene(text, folder.file("s.pbrt"));
    const InfiniteLight& light = scene.infinite_lights.at(0);
    EXPECT_EQ(light.image, folder.file("e.exr"));
    EXPECT_EQ(light.scale, 3);
    EXPECT_NEAR(light.world_from_light[0][1], 1, 1e-15);
    std::ofstream(folder.file("e.exr")) << "two";
    EXPECT_NE(parse_scene(text, folder.file("s.pbrt")).sha256, scene.sha256);
}

}  // namespace
}  // namespace drude
