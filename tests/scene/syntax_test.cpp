// The grammar of pbrt-v4 point by point: every type of value in every way of writing it, and text
// in every dress.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "scene/vocabulary.h"
#include "scene_text.h"
#include "temporary_folder.h"

namespace drude {
namespace {

const std::string seeds = DRUDE_SOURCE_DIR "/tests/fuzz/seeds/scene";

std::vector<std::string> seed_texts() {
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
        texts.push_back(read_file(entry.path().string()));
    }
    std::sort(texts.begin(), texts.end());
    return texts;
}

double x_of(const Shape& shape) {
    return shape.world_from_object[3][0];
}

// Two texts give the same scene; places, and messages that hold lines, may differ.
void expect_same(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.stand_ins.size(), b.stand_ins.size());
    EXPECT_EQ(a.materials.size(), b.materials.size());
    EXPECT_EQ(a.film.width, b.film.width);
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (size_t i = 0; i < a.shapes.size(); ++i) {
        EXPECT_EQ(a.shapes[i].world_from_object, b.shapes[i].world_from_object);
        EXPECT_EQ(a.shapes[i].material, b.shapes[i].material);
        EXPECT_EQ(a.shapes[i].geometry.index(), b.shapes[i].geometry.index());
    }
    ASSERT_EQ(a.distant_lights.size(), b.distant_lights.size());
    ASSERT_EQ(a.area_lights.size(), b.area_lights.size());
}

TEST(Seeds, AreScenesAndHoldEveryNameThatIsKnown) {
    std::string all;
    for (const std::string& text : seed_texts()) {
        EXPECT_NO_THROW(scene_of(text)) << text;
        all += text;
    }
    ASSERT_FALSE(all.empty());
    for (const char* kind :
         {"Camera", "Film", "Sampler", "PixelFilter", "Integrator", "Accelerator", "Shape",
          "Material", "LightSource", "AreaLightSource", "ColorSpace", "Texture"}) {
        for (const std::string& name : known_names(kind)) {
            // These name files.
            if (name == "imagemap" || name == "plymesh") continue;
            EXPECT_TRUE(contains(all, "\"" + name + "\"")) << kind << " \"" << name << "\"";
        }
    }
}

struct Value {
    const char* declaration;  // behind its directive
    const char* bare;         // nullptr where it wants brackets
    const char* in_brackets;
};

TEST(Syntax, EveryTypeInEveryWay) {
    TemporaryFolder folder;
    write(folder.file("a.spd"), "# wavelength value\n400 0.25\n700, 0.75\n");
    const std::string texture = "Texture \"t\" \"spectrum\" \"bilerp\"\n";
    const Value values[] = {
        {"LightSource \"infinite\" \"spectrum L\"", "\"a.spd\"", "[ \"a.spd\" ]"},
        {"LightSource \"infinite\" \"spectrum L\"", nullptr, "[ 400 .25 700 .75 ]"},
        {"LightSource \"infinite\" \"spectrum L\"", "\"stdillum-A\"", "[\"stdillum-A\"]"},
        {"LightSource \"infinite\" \"blackbody L\"", "3000", "[ 3000 ]"},
        {"LightSource \"infinite\" \"rgb L\"", nullptr, "[1 2 3]"},
        {"LightSource \"distant\" \"point3 from\"", nullptr, "[ 0 1 0 ]"},
        {"LightSource \"distant\" \"point from\"", nullptr, "[ 0 1 0 ]"},
        {"AreaLightSource \"diffuse\" \"bool twosided\"", "true", "[ true ]"},
        {"AreaLightSource \"diffuse\" \"bool twosided\"", "\"true\"", "[ \"true\" ]"},
        {"Material \"diffuse\" \"texture reflectance\"", "\"t\"", "[ \"t\" ]"},
        {"Material \"diffuse\" \"spectrum reflectance\"", "\"a.spd\"", "[\"a.spd\"]"},
        {"Texture \"f\" \"float\" \"constant\" \"float value\"", "+.5e0", "[ +.5e0]"},
        {"Texture \"f\" \"float\" \"checkerboard\" \"integer dimension\"", "3", "[3]"},
        {"Texture \"f\" \"float\" \"bilerp\" \"vector3 v1\"", nullptr, "[ 1 0 0 ]"},
        {"Texture \"f\" \"float\" \"bilerp\" \"string mapping\"", "\"planar\"", "[ \"planar\" ]"},
        {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"point2 uv\"", nullptr,
         "[ 0 0 1 0 0 1 ]"},
        {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\"", nullptr,
         "[ 0 0 1 0 0 1 0 0 1 ]"},
        {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\"", nullptr,
         "[ 0 1 2 ]"},
    };
    const auto read = [&](const Value& value, const std::string& text) {
        return parse_scene("WorldBegin\n" + texture + value.declaration + " " + text,
                           folder.file("s.pbrt"));
    };
    for (const Value& value : values) {
        SCOPED_TRACE(value.declaration);
        const Scene bracketed = read(value, value.in_brackets);
        if (value.bare != nullptr) expect_same(read(value, value.bare), bracketed);
        // An empty array holds no value of any type, and a list that is not closed is seen.
        const std::string declared = value.declaration;
        EXPECT_TRUE(contains(world_error_of(texture + declared + " []"), "has 0 values"));
        EXPECT_TRUE(contains(world_error_of(texture + declared + " ["), "the end of the file"));
        EXPECT_TRUE(contains(world_error_of(texture + declared), "the end of the file"));
        EXPECT_TRUE(contains(world_error_of(texture + declared + " Shape"), "found"));
    }
}

TEST(Syntax, TruthIsATypeOfItsOwn) {
    const auto two_sided = [](const std::string& value) {
        return world_of("AreaLightSource \"diffuse\" \"bool twosided\" " + value +
                        " Shape \"disk\"")
            .area_lights.at(0)
            .two_sided;
    };
    EXPECT_TRUE(two_sided("true") && two_sided("\"true\"") && two_sided("[ true ]"));
    EXPECT_FALSE(two_sided("false") || two_sided("\"false\"") || two_sided("[ \"false\" ]"));
    for (const char* value : {"1", "yes", "True", "\"TRUE\"", "[ true true ]"}) {
        EXPECT_FALSE(
            world_error_of(std::string("AreaLightSource \"diffuse\" \"bool twosided\" ") + value)
                .empty());
    }
}

// The same text with something between its words, outside of strings.
std::string between_words(const std::string& text, const std::string& filler) {
    std::string result;
    bool in_string = false, in_comment = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') {
            result += c;
            result += text[++i];
            continue;
        }
        if (c == '"' && !in_comment) in_string = !in_string;
        if (c == '#' && !in_string) in_comment = true;
        if (c == '\n' && in_comment) {
            result += c;
            in_comment = false;
        }
        if (!in_string && !in_comment && (c == ' ' || c == '\n')) {
            result += filler;
        } else {
            result += c;
        }
    }
    return result;
}

TEST(Syntax, CommentsAndLineEndsStandAnywhere) {
    for (const std::string& text : seed_texts()) {
        const Scene plain = scene_of(text);
        expect_same(scene_of(between_words(text, " # ] \" [ WorldEnd \\\n")), plain);
        expect_same(scene_of(between_words(text, "#\n")), plain);
        expect_same(scene_of(between_words(text, "\r\n")), plain);
        expect_same(scene_of(between_words(text, "\t\f\v ")), plain);
        expect_same(scene_of("\xef\xbb\xbf" + text), plain);
        // Without the last line's end, and with a comment there that has none.
        expect_same(scene_of(text.substr(0, text.find_last_not_of(" \n") + 1)), plain);
        expect_same(scene_of(text + "# \xc3\xa4"), plain);
    }
}

TEST(Syntax, WindowsLinesAreCountedOnce) {
    EXPECT_PLACE_AND_TEXT(error_of("WorldBegin\r\n# c\r\n\r\n Shpae\r\n"), "t.pbrt:4:2", "Shpae");
    EXPECT_PLACE_AND_TEXT(error_of("\xef\xbb\xbfShpae"), "t.pbrt:1:1", "Shpae");
}

TEST(Syntax, BytesOfZeroAreOrdinaryAndWrong) {
    const std::string zero(1, '\0');
    EXPECT_EQ(world_of("Shape \"sphere\" # " + zero + "\n" + "Shape \"disk\"").shapes.size(), 2u);
    EXPECT_PLACE_AND_TEXT(world_error_of(zero), "t.pbrt:2:1", "'\\x00'");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape" + zero + " \"sphere\""), "t.pbrt:2:1", "\\x00");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape \"sphere" + zero + "\""), "t.pbrt:2:7", "\\x00");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape \"sphere\" \"float radius\" 1" + zero),
                          "t.pbrt:2:31", "1\\x00");
    EXPECT_PLACE_AND_TEXT(world_error_of("Shape \"sphere\" \"float radius" + zero + "\" x"),
                          "t.pbrt:2:32", "radius\\x00");
    EXPECT_PLACE_AND_TEXT(world_error_of("Include \"a" + zero + ".pbrt\""), "t.pbrt:2:9",
                          "cannot be the name of a file");
}

TEST(Syntax, AnOptionTakesAValueOfEveryType) {
    EXPECT_EQ(scene_of("Option \"seed\" 5 WorldBegin").seed, 5u);
    EXPECT_EQ(scene_of("Option \"integer seed\" 6 WorldBegin").seed, 6u);
    EXPECT_EQ(scene_of("Option \"seed\" \"7\" WorldBegin").seed, 7u);
    EXPECT_TRUE(scene_of("Option \"wavefront\" false WorldBegin").warnings.empty());
    for (const char* option :
         {"\"disablepixeljitter\" true", "\"bool disable-pixel-jitter\" \"true\"",
          "\"float displacementedgescale\" 0.5", "\"displacement_edge_scale\" 2",
          "\"string msereferenceimage\" \"a b.exr\"", "\"renderCoordSys\" \"camera\""}) {
        const std::string text = std::string("Option ") + option + "\nWorldBegin";
        EXPECT_EQ(scene_of(text).stand_ins.size(), 1u) << option;
    }
    EXPECT_PLACE_AND_TEXT(error_of("Option \"flaot seed\" 5"), "t.pbrt:1:1",
                          "did you mean 'float'?");
    EXPECT_PLACE_AND_TEXT(error_of("Option \"seed\" [ 5 ]"), "t.pbrt:1:15", "found '['");
    EXPECT_PLACE_AND_TEXT(error_of("Option \"seed\""), "t.pbrt:1:14", "expected a value");
    EXPECT_PLACE_AND_TEXT(error_of("Option \"seed\" -1"), "t.pbrt:1:1", "0 or more");
    EXPECT_PLACE_AND_TEXT(error_of("Option seed 1"), "t.pbrt:1:8", "in quotes");
    EXPECT_PLACE_AND_TEXT(error_of("WorldBegin Option \"seed\" 1"), "t.pbrt:1:12", "before");
}

TEST(Syntax, AnAttributeMayBeEmptyAndOfEveryKind) {
    for (const char* kind : {"shape", "light", "material", "medium", "texture"}) {
        const std::string attribute = std::string("Attribute \"") + kind + "\"";
        EXPECT_TRUE(world_of(attribute + " Shape \"sphere\"").warnings.empty());
        EXPECT_FALSE(world_error_of(attribute + " \"float nothing\" 1").empty());
    }
    EXPECT_PLACE_AND_TEXT(world_error_of("Attribute shape"), "t.pbrt:2:11", "in quotes");
    EXPECT_PLACE_AND_TEXT(world_error_of("Attribute"), "t.pbrt:2:10", "the end of the file");
}

TEST(Syntax, MatricesWantTheirBracketsAndVectorsHaveNone) {
    const std::string sixteen = "1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1";
    const Scene scene = world_of("Transform[" + sixteen + "]ConcatTransform # twice\n[ " + sixteen +
                                 " ]Shape\"sphere\"");
    EXPECT_EQ(x_of(scene.shapes.at(0)), 10);
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform " + sixteen), "t.pbrt:2:11", "expected '['");
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform [ " + sixteen + " 1 ]"), "t.pbrt:2:45",
                          "expected ']'");
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform [ 1 0 ]"), "t.pbrt:2:17", "a finite number");
    EXPECT_PLACE_AND_TEXT(world_error_of("Translate [ 1 0 0 ]"), "t.pbrt:2:11", "a finite number");
    EXPECT_PLACE_AND_TEXT(world_error_of("Scale 1 1"), "t.pbrt:2:10", "the end of the file");
    EXPECT_PLACE_AND_TEXT(world_error_of("Rotate 1e999 0 0 1"), "t.pbrt:2:8", "a finite number");
}

TEST(Syntax, FilesStandInTheMiddleOfABlock) {
    TemporaryFolder folder;
    write(folder.file("open.pbrt"),
          "\xef\xbb\xbf"
          "AttributeBegin Translate 1 0 0");
    write(folder.file("close.pbrt"), "Shape \"sphere\" AttributeEnd # no end of line");
    write_gz(folder.file("import.pbrt.gz"),
             "Translate 5 0 0 Shape \"sphere\" ColorSpace \"rec2020\"");
    const Scene scene = parse_scene(
        "WorldBegin Include \"open.pbrt\" Import \"import.pbrt.gz\" Include \"close.pbrt\"\n"
        "Material \"diffuse\" \"rgb reflectance\" [ 1 0 0 ] Shape \"sphere\"",
        folder.file("s.pbrt"));
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_EQ(x_of(scene.shapes[0]), 6);
    EXPECT_EQ(x_of(scene.shapes[1]), 1);
    EXPECT_EQ(x_of(scene.shapes[2]), 0);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

}  // namespace
}  // namespace drude
