// Plugins in a scene: found, loaded, refused with a reason, given their parameters.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.h"
#include "plugin_path.h"
#include "scene_text.h"
#include "temporary_folder.h"

namespace drude {
namespace {

namespace fs = std::filesystem;

const std::string built = DRUDE_BINARY_DIR "/test_plugins";

std::string material(const std::string& name, const std::string& parameters = "") {
    return "Material \"" + name + "\" " + parameters + "\nShape \"sphere\"";
}

TEST(Plugins, AreFoundUnderBothNames) {
    const PluginPath path("/nowhere::" + built);
    for (const std::string name : {"lambert", "prefixed", "libprefixed", "plain"}) {
        const Scene scene = world_of(material(name));
        const auto* plugin = std::get_if<PluginMaterial>(&scene.materials.back());
        ASSERT_NE(plugin, nullptr) << name;
        EXPECT_EQ(plugin->name, name);
        EXPECT_TRUE(scene.warnings.empty());
    }
    const Scene named = world_of(
        "MakeNamedMaterial \"m\" \"string type\" \"lambert\"\nNamedMaterial \"m\"\nShape "
        "\"sphere\"");
    EXPECT_TRUE(std::holds_alternative<PluginMaterial>(named.materials.back()));
}

TEST(Plugins, UnknownNames) {
    {
        const PluginPath path("/nowhere:" + built);
        const std::string message = world_error_of(material("lamberd"));
        EXPECT_PLACE_AND_TEXT(message, "t.pbrt:2:10", "did you mean 'lambert'?");
        EXPECT_TRUE(contains(message, "neither lamberd.so nor liblamberd.so in /nowhere, " + built))
            << message;
        // What is no plain name never becomes a path.
        EXPECT_PLACE_AND_TEXT(world_error_of(material("../test_plugins/lambert")), "t.pbrt:2:10",
                              "is not known");
        // pbrt-v3's names keep their advice.
        EXPECT_PLACE_AND_TEXT(world_error_of(material("plastic")), "t.pbrt:2:10", "pbrt-v");
    }
    const std::string message = world_error_of(material("lambert"));
    EXPECT_PLACE_AND_TEXT(message, "t.pbrt:2:10", "is not known");
    EXPECT_TRUE(contains(message, "lambert.so in a folder of DRUDE_PLUGIN_PATH, which is not set"))
        << message;
}

TEST(Plugins, BuiltInNamesWin) {
    const TemporaryFolder folder;
    fs::copy_file(built + "/metal.so", folder.file("diffuse.so"));
    const PluginPath path(folder.path().string());
    const Scene scene = world_of(material("diffuse") + "\n" + material("diffuse"));
    EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(scene.materials.back()));
    EXPECT_TRUE(warns(scene, "diffuse.so is never used under this name"));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(Plugins, RefusedFiles) {
    const TemporaryFolder folder;
    const std::string whole = read_file(built + "/lambert.so");
    write_file(folder.file("text.so"), "not a program");
    write_file(folder.file("empty.so"), "");
    const PluginPath path(folder.path().string());
    for (const std::string name : {"text", "empty"}) {
        EXPECT_PLACE_AND_TEXT(world_error_of(material(name)), "t.pbrt:2:1",
                              "is not a whole shared object");
    }
    // Cut anywhere: the loader alone would end the program.
    for (size_t eighths = 0; eighths < 8; ++eighths) {
        const std::string name = "cut" + std::to_string(eighths);
        write_file(folder.file(name + ".so"), whole.substr(0, 20 + whole.size() * eighths / 8));
        EXPECT_PLACE_AND_TEXT(world_error_of(material(name)), "t.pbrt:2:1",
                              "is not a whole shared object");
    }
}

TEST(Plugins, RefusedTables) {
    const PluginPath path;
    const auto refused = [](const std::string& name, const std::string& why) {
        const std::string message = world_error_of(material(name));
        EXPECT_PLACE_AND_TEXT(message, "t.pbrt:2:1", why);
        EXPECT_TRUE(contains(message, name + ".so")) << message;
    };
    refused("old_version", "version 99");
    refused("wrong_size", "its table has 8 bytes; expected 72");
    refused("unknown_isa", "'avx512vmbi' (did you mean 'avx512vbmi'?)");
    refused("no_isa", "no 'instruction_set'");
    refused("no_symbol", "does not export drude_surface_plugin()");
    refused("no_table", "gave nothing");
    refused("no_evaluate", "no 'evaluate'");
    refused("no_type", "declares \"reflectance\"; expected \"TYPE NAME\"");
    refused("wrong_type", "(did you mean 'float'?)");
    refused("twice", "declares 'n' twice");
    refused("spectra", "expected one spectrum");
}

TEST(Plugins, InstructionsThatTheProcessorLacks) {
    const PluginPath path;
    // AMD's of 2011 to 2015.
    if (__builtin_cpu_supports("xop")) GTEST_SKIP() << "this processor has them";
    EXPECT_PLACE_AND_TEXT(world_error_of(material("other_isa")), "t.pbrt:2:1",
                          "is compiled for avx xop, and this processor has no ");
}

TEST(Plugins, Parameters) {
    const PluginPath path;
    const TemporaryFolder folder;
    write_file(folder.file("t.txt"), "1");
    const auto given = [&](const std::string& parameters) {
        try {
            parse_scene("WorldBegin\n" + material("fails", parameters), folder.file("s.pbrt"));
        } catch (const Error& error) {
            return error.message();
        }
        ADD_FAILURE() << "a surface of " << parameters;
        return std::string();
    };
    const std::string all = given(
        "\"float alpha\" 0.25 \"integer count\" -3 \"bool flag\" true \"rgb tint\" [ .1 .2 .3 ] "
        "\"spectrum colour\" [ 300 2 900 2 ] \"string label\" \"a b\" \"string table\" \"t.txt\" "
        "\"float list\" [ 1 2 3 4 ] \"rgb rgbs\" [ 1 2 3 4 5 6 ]");
    for (const std::string part :
         {" alpha=0.25,", " count=-3,", " flag=1,", " tint=0.1,0.2,0.3,", " colour=401*2,2,",
          " label=a b,", "/t.txt,", " list=1,2,3,4,", " rgbs=1,2,3,4,5,6,"}) {
        EXPECT_TRUE(contains(all, part)) << all;
    }
    EXPECT_FALSE(contains(all, " n=")) << all;
    EXPECT_TRUE(contains(all, "s.pbrt:2:1: ")) << all;

    // Colours come in linear sRGB: .5 * 1.6605 - .4 * .5876 - .3 * .0728 is 0.573.
    EXPECT_TRUE(contains(
        world_error_of("ColorSpace \"rec2020\" " + material("fails", "\"rgb tint\" [ .5 .4 .3 ]")),
        " tint=0.573"));

    const auto refused = [&](const std::string& parameters, const std::string& why) {
        const std::string message = given(parameters);
        EXPECT_TRUE(contains(message, "s.pbrt:2:")) << message;
        EXPECT_TRUE(contains(message, why)) << message;
    };
    refused("\"float alhpa\" 1", "no parameter 'alhpa' (did you mean 'alpha'?)");
    refused("\"string alpha\" \"1\"", "expected \"float alpha\"");
    refused("\"float alpha\" [ 1 2 ]", "2 values; expected 1");
    refused("\"rgb tint\" [ 1 2 3 4 5 6 ]", "6 values; expected 3");
    refused("\"string table\" \"gone.txt\"", "not found");
    refused(std::string("\"string label\" \"a\0b\"", 20), "bytes of 0");
}

TEST(Plugins, ReasonsOfFailure) {
    const PluginPath path;
    EXPECT_PLACE_AND_TEXT(world_error_of(material("silent")), "t.pbrt:2:1", "gave no reason");
    EXPECT_PLACE_AND_TEXT(world_error_of(material("throws")), "t.pbrt:2:1", "thrown by the plugin");
    EXPECT_PLACE_AND_TEXT(world_error_of(material("long_message")), "t.pbrt:2:1",
                          std::string(1000, 'x'));
}

TEST(Plugins, CountIntoTheHash) {
    const TemporaryFolder folder;
    fs::copy_file(built + "/lambert.so", folder.file("mine.so"));
    const auto hash = [&](const std::string& table) {
        write_file(folder.file("t.txt"), table);
        const PluginPath path(folder.path().string());
        return parse_scene("WorldBegin\n" + material("mine", "\"string table\" \"t.txt\""),
                           folder.file("s.pbrt"))
            .sha256;
    };
    const std::string one = hash("1");
    EXPECT_NE(hash("2"), one);
    EXPECT_EQ(hash("1"), one);
    // In a folder of its own: the loader keeps what it has loaded under a name.
    const TemporaryFolder other;
    fs::copy_file(built + "/metal.so", other.file("mine.so"));
    write_file(other.file("t.txt"), "1");
    const PluginPath path(other.path().string());
    EXPECT_NE(parse_scene("WorldBegin\n" + material("mine", "\"string table\" \"t.txt\""),
                          other.file("s.pbrt"))
                  .sha256,
              one);
}

}  // namespace
}  // namespace drude
