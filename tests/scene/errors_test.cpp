// Every kind of error at its exact place, with the word a person needs.
#include <gtest/gtest.h>

#include "scene_text.h"

namespace drude {
namespace {

TEST(SceneErrors, Structure) {
    EXPECT_PLACE_AND_TEXT(error_of(""), "t.pbrt:1:1", "without WorldBegin");
    EXPECT_PLACE_AND_TEXT(error_of("WorldBegin WorldBegin"), "t.pbrt:1:12", "twice");
    EXPECT_PLACE_AND_TEXT(error_of("Shape \"sphere\""), "t.pbrt:1:1", "before WorldBegin");
    EXPECT_PLACE_AND_TEXT(world_error_of("Film \"rgb\""), "t.pbrt:2:1", "behind WorldBegin");
    EXPECT_PLACE_AND_TEXT(world_error_of("AttributeEnd"), "t.pbrt:2:1", "without AttributeBegin");
    EXPECT_PLACE_AND_TEXT(world_error_of("\n AttributeBegin\nAttributeBegin AttributeEnd"),
                          "t.pbrt:3:2", "not closed");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shpae \"sphere\""), "t.pbrt:2:1",
                          "did you mean 'Shape'?");
    EXPECT_PLACE_AND_TEXT(world_error_of("\"sphere\""), "t.pbrt:2:1", "expected a directive");
    EXPECT_PLACE_AND_TEXT(world_error_of("]"), "t.pbrt:2:1", "expected a directive");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape sphere"), "t.pbrt:2:7", "in quotes");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape"), "t.pbrt:2:6", "the end of the file");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape \"spheer\""), "t.pbrt:2:7",
                          "did you mean 'sphere'?");
    EXPECT_PLACE_AND_TEXT(error_of("ColorSpace \"rec202\""), "t.pbrt:1:1",
                          "did you mean 'rec2020'?");
    EXPECT_PLACE_AND_TEXT(error_of("Option \"sede\" 1"), "t.pbrt:1:1", "did you mean 'seed'?");
}

TEST(SceneErrors, Parameters) {
    const std::string shape = "Shape \"sphere\" ";  // 15 characters
    const auto of = [&](const std::string& text) { return world_error_of(shape + text); };
    EXPECT_PLACE_AND_TEXT(of("\"float radios\" 1"), "t.pbrt:2:16", "did you mean 'radius'?");
    EXPECT_PLACE_AND_TEXT(of("\"flaot radius\" 1"), "t.pbrt:2:16", "did you mean 'float'?");
    EXPECT_PLACE_AND_TEXT(of("\"radius\" 1"), "t.pbrt:2:16", "expected \"type name\"");
    EXPECT_PLACE_AND_TEXT(of("\"integer radius\" 1"), "t.pbrt:2:16", "expected \"float radius\"");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" 1 \"float radius\" 2"), "t.pbrt:2:33", "twice");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" [ 1 2 ]"), "t.pbrt:2:35", "2 values; expected 1");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" []"), "t.pbrt:2:16", "0 values");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" [ 1"), "t.pbrt:2:34", "the end of the file");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\""), "t.pbrt:2:30", "the end of the file");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" ]"), "t.pbrt:2:31", "expected a value");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" [ [ 1 ] ]"), "t.pbrt:2:33", "expected a value");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" 1x"), "t.pbrt:2:31", "finite number");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" \"1\""), "t.pbrt:2:31", "finite number");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" nan"), "t.pbrt:2:31", "finite number");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" -1"), "t.pbrt:2:31", "radius is -1");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" 0"), "t.pbrt:2:31", "radius is 0");
    EXPECT_PLACE_AND_TEXT(of("\"float zmin\" 2"), "t.pbrt:2:16", "nothing is left");
    EXPECT_PLACE_AND_TEXT(of("\"float phimax\" [\n\n 0 ]"), "t.pbrt:4:2", "phimax is 0");
    EXPECT_PLACE_AND_TEXT(of("\"float radius\" 1 2"), "t.pbrt:2:33", "in brackets");
    EXPECT_PLACE_AND_TEXT(error_of("Film \"rgb\" \"integer xresolution\" 1.5"), "t.pbrt:1:34",
                          "expected an integer");
    EXPECT_PLACE_AND_TEXT(error_of("Film \"rgb\" \"integer xresolution\" 99999999999"),
                          "t.pbrt:1:34", "32 bits");
    EXPECT_PLACE_AND_TEXT(error_of("Film \"rgb\" \"bool savefp16\" 1"), "t.pbrt:1:28",
                          "true or false");
    EXPECT_PLACE_AND_TEXT(error_of("Film \"rgb\" \"string filename\" x"), "t.pbrt:1:30",
                          "a string in quotes");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"point\" \"point3 from\" [ 1 2 ]"),
                          "t.pbrt:2:21", "a multiple of 3");
}

TEST(SceneErrors, Meshes) {
    const std::string mesh = "Shape \"trianglemesh\"\n";
    const std::string points = "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]\n";
    const auto of = [&](const std::string& text) { return world_error_of(mesh + text); };
    EXPECT_PLACE_AND_TEXT(of(points + "\"integer indices\" [ 0 1\n 4 ]"), "t.pbrt:5:2",
                          "index 4; expected 0 to 3");
    EXPECT_PLACE_AND_TEXT(of(points + "\"integer indices\" [ 0 -1 2 ]"), "t.pbrt:4:23", "index -1");
    EXPECT_PLACE_AND_TEXT(of(points + "\"integer indices\" [ 0 1 ]"), "t.pbrt:4:1",
                          "multiple of 3");
    EXPECT_PLACE_AND_TEXT(of(points), "t.pbrt:2:1", "without \"integer indices\"");
    EXPECT_PLACE_AND_TEXT(of("\"integer indices\" [ 0 1 2 ]"), "t.pbrt:2:1",
                          "without \"point3 P\"");
    EXPECT_PLACE_AND_TEXT(of(points + "\"integer indices\" [ 0 0 1 ]"), "t.pbrt:2:1",
                          "only triangles without area");
    EXPECT_PLACE_AND_TEXT(of(points + "\"integer indices\" [ 0 1 2 ]\n\"normal N\" [ 0 0 1 ]"),
                          "t.pbrt:5:1", "1 of 'N' for 4 of 'P'");
    EXPECT_PLACE_AND_TEXT(of("\"point3 P\" [ 0 0 0 1 0 0 0 1e30 0 ]"), "t.pbrt:3:28",
                          "coordinate 1e+30");
    EXPECT_PLACE_AND_TEXT(of("\"float uv\" [ 0 0 5 0 5 5 0 5 ]" + points), "t.pbrt:3:1",
                          "expected \"point2 uv\"");
}

TEST(SceneErrors, MaterialsAndLights) {
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"difuse\""), "t.pbrt:2:10",
                          "did you mean 'diffuse'?");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"diffuse\" \"rgb reflectance\" [ 0 0.5 1.5 ]"),
                          "t.pbrt:2:46", "is 1.5; expected 0 to 1");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"diffuse\" \"rgb reflectance\" [ 0 0.5 ]"),
                          "t.pbrt:2:20", "multiple of 3");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"diffuse\" \"texture reflectance\" \"a\""),
                          "t.pbrt:2:42", "no spectrum texture 'a'");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"conductor\" \"spectrum eta\" [ 500 1 400 1 ]"),
                          "t.pbrt:2:45", "ascending");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"conductor\" \"spectrum eta\" [ 500 ]"),
                          "t.pbrt:2:22", "pairs");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Material \"conductor\" \"spectrum eta\" \"metal-Cu-ate\""), "t.pbrt:2:22",
        "did you mean 'metal-Cu-eta'?");
    EXPECT_PLACE_AND_TEXT(
        world_error_of(
            "Material \"conductor\" \"spectrum eta\" [ 500 1 ] \"spectrum k\" [ 500 -1 ]"),
        "t.pbrt:2:47", "k is -1");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"conductor\" \"string lobe\" \"gaussian\""),
                          "t.pbrt:2:22", "without \"float beta\"");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Material \"conductor\" \"string lobe\" \"gausian\" \"float beta\" 0.1"),
        "t.pbrt:2:22", "gaussian");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Material \"conductor\" \"float roughness\" 0.1 \"float beta\" 0.1"),
        "t.pbrt:2:44", "exclude each other");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"conductor\" \"float beta\" 3"), "t.pbrt:2:1",
                          "beta");
    EXPECT_PLACE_AND_TEXT(world_error_of("Material \"conductor\" \"string material\" \"Cuu\""),
                          "t.pbrt:2:22", "Cu");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Material \"conductor\" \"string material\" \"no/cu.json\""), "t.pbrt:2:22",
        "material file not found");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"infinite\" \"rgb L\" [ 1 -1 1 ]"),
                          "t.pbrt:2:36", "L is -1");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"infinite\" \"string filename\" \"no.exr\""),
                          "t.pbrt:2:24", "environment image not found");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"distant\" \"point3 to\" [ 0 0 0 ]"),
                          "t.pbrt:2:1", "two different points");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"distant\" \"blackbody L\" 0"),
                          "t.pbrt:2:37", "blackbody of 0 K");
    EXPECT_PLACE_AND_TEXT(
        world_error_of(
            "Texture \"a\" \"float\" \"constant\"\nTexture \"a\" \"float\" \"constant\""),
        "t.pbrt:3:1", "defined twice");
    EXPECT_PLACE_AND_TEXT(world_error_of("Texture \"a\" \"flot\" \"constant\""), "t.pbrt:2:13",
                          "did you mean 'float'?");
}

TEST(SceneErrors, OldVersionsAreNamedWithTheirChanges) {
    const std::string v3 = error_of(
        "Film \"image\"\nIntegrator \"path\"\nWorldBegin\nMaterial \"matte\" \"color Kd\" [0 0 "
        "0]\nWorldEnd");
    EXPECT_PLACE_AND_TEXT(v3, "t.pbrt:1:6", "is pbrt-v3 syntax");
    for (const char* part :
         {"line 1: Film \"image\" becomes Film \"rgb\"", "line 4: Material \"matte\" becomes",
          "line 4: \"color X\" becomes", "line 5: leave WorldEnd out"}) {
        EXPECT_TRUE(contains(v3, part)) << v3;
    }
    EXPECT_PLACE_AND_TEXT(error_of("Renderer \"metropolis\""), "t.pbrt:1:1", "is pbrt-v2 syntax");
    EXPECT_PLACE_AND_TEXT(world_error_of("WorldEnd"), "t.pbrt:2:1", "pbrt-v2 or pbrt-v3");
    EXPECT_PLACE_AND_TEXT(world_error_of("LightSource \"infinite\" \"color L\" [ 1 1 1 ]"),
                          "t.pbrt:2:24", "becomes \"rgb X\"");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("MakeNamedMaterial \"a\" \"string type\" \"matte\" \"float sigma\" 3"),
        "t.pbrt:2:23", "Material \"matte\" becomes \"diffuse\"");
}

}  // namespace
}  // namespace drude
