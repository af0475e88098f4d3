// Scenes of sizes, depths and numbers that nobody writes by hand.
#include <gtest/gtest.h>

#include "scene_text.h"

namespace drude {
namespace {

std::string repeated(const std::string& text, size_t times) {
    std::string result;
    result.reserve(text.size() * times);
    for (size_t i = 0; i < times; ++i) result += text;
    return result;
}

TEST(Sizes, TenThousandBlocksWithinEachOther) {
    constexpr size_t deep = 10000;
    const std::string begin = repeated("AttributeBegin Translate 1 0 0\n", deep);
    const Scene scene = world_of(begin + "Shape \"sphere\"\n" + repeated("AttributeEnd\n", deep) +
                                 "Shape \"disk\"");
    EXPECT_EQ(scene.shapes.at(0).world_from_object[3][0], deep);
    EXPECT_EQ(scene.shapes.at(1).world_from_object[3][0], 0);
    EXPECT_PLACE_AND_TEXT(world_error_of(begin + repeated("AttributeEnd ", deep - 1)), "t.pbrt:2:1",
                          "not closed");
    EXPECT_PLACE_AND_TEXT(world_error_of(repeated("[", deep)), "t.pbrt:2:1", "found '['");
}

TEST(Sizes, AHundredMegabytesOfComments) {
    std::string text = "WorldBegin\n";
    text +=
        repeated("# nothing to see in this line, nor in the next, nor in any of them\n", 750000);
    text += "#" + std::string(50'000'000, '-') + "\nShape \"sphere\"\nShpae";
    ASSERT_GT(text.size(), 100'000'000u);
    EXPECT_PLACE_AND_TEXT(error_of(text), "t.pbrt:750004:1", "Shpae");
    text.resize(text.size() - 5);
    EXPECT_EQ(scene_of(text).shapes.size(), 1u);
}

TEST(Sizes, LongNamesAndManyParametersAreToldShortly) {
    const std::string name(1'000'000, 'n');
    for (const std::string& text :
         {name, "Shape \"" + name + "\"", "Shape \"sphere\" \"float " + name + "\" 1",
          "Shape \"sphere\" \"float " + name + "\" x", "Shape \"sphere\" \"" + name + " radius\" 1",
          "Shape \"sphere\" \"float " + name + "\" []", "NamedMaterial \"" + name + "\"",
          "Texture \"" + name + "\" \"float\" \"constant\" \"float valeu\" 1",
          "Material \"conductor\" \"string material\" \"" + name + "\"",
          "Material \"conductor\" \"string lobe\" \"" + name + "\" \"float beta\" 1",
          "Material \"diffuse\" \"spectrum reflectance\" \"metal-" + name + "\"",
          "Include \"" + name + "\"", "ObjectInstance \"" + name + "\""}) {
        EXPECT_LT(world_error_of(text).size(), 2000u) << text.substr(0, 40);
    }
    EXPECT_LT(error_of("Option \"" + name + "\" 1").size(), 2000u);
    std::string many = "Shape \"sphere\"";
    for (int i = 0; i < 20000; ++i) many += " \"float p" + std::to_string(i) + "\" 1";
    EXPECT_PLACE_AND_TEXT(world_error_of(many), "t.pbrt:2:16", "has no parameter 'p0'");
}

TEST(Sizes, MixesOfMixesToAnyDepth) {
    constexpr int deep = 10000;
    std::string text = "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
    for (int i = 1; i <= deep; ++i) {
        const std::string below = "\"m" + std::to_string(i - 1) + "\"";
        text += "MakeNamedMaterial \"m" + std::to_string(i) +
                "\" \"string type\" \"mix\" \"string materials\" [ " + below + below + " ]\n";
    }
    EXPECT_EQ(world_of(text).materials.size(), deep + 2u);
    // The first is made of the last.
    text.replace(text.find("\"diffuse\""), 9,
                 "\"mix\" \"string materials\" [ \"m" + std::to_string(deep) + "\" \"m1\" ]");
    EXPECT_TRUE(contains(world_error_of(text), "made of itself"));
}

TEST(Sizes, NumbersThatSinglePrecisionCannotHoldAreErrors) {
    const std::string bright = "\"rgb L\" [ 1e14 1e14 1e14 ] \"float scale\" 1e14 ";
    for (const std::string& light :
         {"LightSource \"distant\" " + bright, "LightSource \"infinite\" " + bright,
          "AreaLightSource \"diffuse\" " + bright}) {
        EXPECT_PLACE_AND_TEXT(world_error_of(light), "t.pbrt:2:1", "expected at most 1e+20");
    }
    EXPECT_PLACE_AND_TEXT(
        world_error_of("LightSource \"point\" \"float scale\" 1e15 \"float power\" 1e15"),
        "t.pbrt:2:1", "expected at most 1e+20");
    EXPECT_PLACE_AND_TEXT(world_error_of("AreaLightSource \"diffuse\" \"float power\" 1e15\n"
                                         "Scale 1e-5 1e-5 1e-5 Shape \"sphere\""),
                          "t.pbrt:2:1", "a shape of area");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Texture \"t\" \"float\" \"constant\" \"float value\" 1e300"), "t.pbrt:2:1",
        "comes to 1e+300");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Texture \"t\" \"float\" \"checkerboard\"\n \"float tex2\" -1e300"),
        "t.pbrt:3:2", "tex2 comes to 1e+300");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Texture \"t\" \"spectrum\" \"scale\" \"rgb tex\" [ 1e12 1 1 ] "
                       "\"float scale\" 1e12"),
        "t.pbrt:2:1", "expected at most 1000000000000000");
    EXPECT_PLACE_AND_TEXT(
        world_error_of("Texture \"t\" \"float\" \"bilerp\" \"float uscale\" 1e300"), "t.pbrt:2:45",
        "expected -1000000000 to 1000000000");
    EXPECT_PLACE_AND_TEXT(world_error_of("Texture \"t\" \"float\" \"bilerp\" \"string mapping\" "
                                         "\"planar\" \"vector3 v2\" [ 0 1e10 0 ]"),
                          "t.pbrt:2:56", "v2 is 0 1");
}

}  // namespace
}  // namespace drude
