#include <gtest/gtest.h>

#include "scene_text.h"
#include "temporary_folder.h"

namespace drude {
namespace {

double x_of(const Shape& shape) {
    return shape.world_from_object[3][0];
}

TEST(Grammar, AnEmptyWorldHasPbrtsDefaults) {
    const Scene scene = scene_of("WorldBegin");
    EXPECT_EQ(scene.film.width, 1280);
    EXPECT_EQ(scene.film.height, 720);
    EXPECT_EQ(scene.max_depth, 5);
    EXPECT_EQ(scene.samples_per_pixel, 16);
    EXPECT_EQ(scene.filter.kind, FilterKind::gaussian);
    EXPECT_EQ(scene.camera.fov_deg, 90);
    EXPECT_NEAR(scene.camera.screen_window[1], 1280.0 / 720, 1e-15);
    EXPECT_EQ(scene.camera.screen_window[3], 1);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.sha256.size(), 64u);
}

TEST(Grammar, ValuesWithAndWithoutBracketsAndCommentsAnywhere) {
    const Scene scene = scene_of(
        "Film # the picture\n \"rgb\" \"integer xresolution\" # so wide\n 300\n"
        "\"integer yresolution\" [ # so high\n 200 ]#end\nWorldBegin#\n"
        "Shape \"sphere\" \"float radius\"[2]\"float zmin\"-1 \"float zmax\" [ +.5e0 ] "
        "\" float \t phimax \" 90");
    EXPECT_EQ(scene.film.width, 300);
    EXPECT_EQ(scene.film.height, 200);
    const Sphere& sphere = std::get<Sphere>(scene.shapes.at(0).geometry);
    EXPECT_EQ(sphere.radius, 2);
    EXPECT_EQ(sphere.z_min, -1);
    EXPECT_EQ(sphere.z_max, 0.5);
    EXPECT_EQ(sphere.phi_max_deg, 90);
}

TEST(Grammar, SettingsAreRead) {
    const Scene scene = scene_of(
        "Option \"seed\" 5\nColorSpace \"srgb\"\n"
        "Film \"gbuffer\" \"integer xresolution\" 100 \"integer yresolution\" 200 "
        "\"string filename\" \"o.exr\" \"bool savefp16\" false\n"
        "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5\n"
        "PixelFilter \"mitchell\" \"float xradius\" 1.5 \"float B\" 0.2\n"
        "Integrator \"volpath\" \"integer maxdepth\" 33\nAccelerator \"bvh\" \"integer "
        "maxnodeprims\" 2\n"
        "Camera \"perspective\" \"float screenwindow\" [ -1 2 -3 4 ] \"float lensradius\" 0.1\n"
        "WorldBegin");
    EXPECT_EQ(scene.film.filename, "o.exr");
    EXPECT_EQ(scene.samples_per_pixel, 15);
    EXPECT_EQ(scene.seed, 5u);
    EXPECT_EQ(scene.filter.kind, FilterKind::mitchell);
    EXPECT_EQ(scene.filter.radius_x, 1.5);
    EXPECT_EQ(scene.filter.radius_y, 2);
    EXPECT_EQ(scene.filter.b, 0.2);
    EXPECT_EQ(scene.filter.c, 1.0 / 3);
    EXPECT_EQ(scene.max_depth, 33);
    EXPECT_EQ(scene.camera.screen_window[2], -3);
    EXPECT_EQ(scene.camera.lens_radius, 0.1);
    EXPECT_EQ(scene.camera.focal_distance, 1e6);
    EXPECT_TRUE(scene.film.gbuffer);
    EXPECT_TRUE(warns(scene, "'savefp16' is known to pbrt-v4 and has no effect"));
    EXPECT_TRUE(warns(scene, "Sampler \"stratified\": the project's own"));
    EXPECT_EQ(scene.stand_ins.size(), 1u);
}

TEST(Grammar, ThePortraitFilmHasItsShorterSideFromMinusOneToOne) {
    const Scene scene = scene_of(
        "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 250\nWorldBegin");
    EXPECT_EQ(scene.camera.screen_window[1], 1);
    EXPECT_EQ(scene.camera.screen_window[3], 2.5);
}

TEST(Grammar, AttributesAreRestored) {
    const Scene scene = world_of(
        "Material \"diffuse\" \"rgb reflectance\" [ .1 .1 .1 ]\n"
        "AttributeBegin Translate 1 0 0 ReverseOrientation Material \"interface\" "
        "Shape \"sphere\" AttributeEnd Shape \"sphere\"\n"
        "TransformBegin Translate 2 0 0 Shape \"sphere\" TransformEnd Shape \"sphere\"");
    ASSERT_EQ(scene.shapes.size(), 4u);
    EXPECT_EQ(scene.shapes[0].material, -1);
    EXPECT_TRUE(scene.shapes[0].reverse_orientation);
    EXPECT_EQ(x_of(scene.shapes[0]), 1);
    EXPECT_EQ(scene.shapes[1].material, 1);
    EXPECT_FALSE(scene.shapes[1].reverse_orientation);
    EXPECT_EQ(x_of(scene.shapes[1]), 0);
    EXPECT_EQ(x_of(scene.shapes[2]), 2);
    EXPECT_EQ(x_of(scene.shapes[3]), 0);
}

TEST(Grammar, AttributeGivesDefaultsThatParametersOverrule) {
    const Scene scene = world_of(
        "AttributeBegin Attribute \"shape\" \"float radius\" 3 \"float phimax\" 90\n"
        "Attribute \"shape\" \"float phimax\" 60\n"
        "Shape \"sphere\" Shape \"sphere\" \"float radius\" 1 Shape \"trianglemesh\" "
        "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] AttributeEnd Shape \"sphere\"");
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(0).geometry).radius, 3);
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(0).geometry).phi_max_deg, 60);
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(1).geometry).radius, 1);
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(3).geometry).radius, 1);
    EXPECT_PLACE_AND_TEXT(world_error_of("Attribute \"shape\" \"float radios\" 3"), "t.pbrt:2:19",
                          "did you mean 'radius'?");
    EXPECT_PLACE_AND_TEXT(world_error_of("Attribute \"shapes\""), "t.pbrt:2:1",
                          "did you mean 'shape'?");
}

TEST(Grammar, NamedMaterialsMayFollowTheirUse) {
    const Scene scene = world_of(
        "NamedMaterial \"b\" Shape \"sphere\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ]\n"
        "MakeNamedMaterial \"none\" \"string type\" [ \"interface\" ]\n"
        "NamedMaterial \"none\" Shape \"sphere\"");
    EXPECT_EQ(scene.shapes.at(0).material, 1);
    EXPECT_EQ(scene.shapes.at(1).material, -1);
    EXPECT_PLACE_AND_TEXT(
        world_error_of("MakeNamedMaterial \"gold\" \"string type\" \"diffuse\"\n NamedMaterial "
                       "\"glod\""),
        "t.pbrt:3:2", "did you mean 'gold'?");
}

TEST(Grammar, InstancesAreCopiesUnderTheirTransformation) {
    const Scene scene = world_of(
        "Translate 100 0 0\n"
        "ObjectBegin \"o\" Translate 1 0 0 Shape \"sphere\" Shape \"sphere\" ObjectEnd\n"
        "Identity Scale 2 2 2 ObjectInstance \"o\" Translate 1 0 0 ObjectInstance \"o\"");
    ASSERT_EQ(scene.shapes.size(), 4u);
    EXPECT_EQ(x_of(scene.shapes[0]), 202);
    EXPECT_EQ(x_of(scene.shapes[3]), 204);
    EXPECT_PLACE_AND_TEXT(world_error_of("ObjectInstance \"x\""), "t.pbrt:2:1", "no object 'x'");
    EXPECT_PLACE_AND_TEXT(world_error_of("ObjectBegin \"x\" AttributeEnd"), "t.pbrt:2:17",
                          "closes the ObjectBegin");
}

TEST(Grammar, IncludesAreReadBesideTheSceneOrTheIncludingFile) {
    TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    // pbrt's way: relative to the scene, even from within sub/; and beside the file itself, packed.
    write(folder.file("main.pbrt"), "WorldBegin\nInclude \"sub/a.pbrt\" Shape \"sphere\"\n");
    write(folder.file("sub/a.pbrt"),
          "Translate 1 0 0\nInclude \"sub/b.pbrt\"\nInclude \"c.pbrt.gz\"");
    write(folder.file("sub/b.pbrt"), "Shape \"sphere\"");
    write_gz(folder.file("sub/c.pbrt.gz"), "Translate 1 0 0 Shape \"sphere\"");
    const Scene scene = read_scene(folder.file("main.pbrt"));
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_EQ(x_of(scene.shapes[0]), 1);
    EXPECT_EQ(x_of(scene.shapes[1]), 2);
    EXPECT_EQ(x_of(scene.shapes[2]), 2);
    // What is included counts into the hash, names do not.
    write(folder.file("sub/b.pbrt"), "Shape \"sphere\" ");
    EXPECT_NE(read_scene(folder.file("main.pbrt")).sha256, scene.sha256);
    write(folder.file("sub/b.pbrt"), "Shape \"sphere\"");
    std::filesystem::rename(folder.file("main.pbrt"), folder.file("other.pbrt"));
    EXPECT_EQ(read_scene(folder.file("other.pbrt")).sha256, scene.sha256);
}

TEST(Grammar, AnImportLeavesNoTraceInTheState) {
    TemporaryFolder folder;
    write(folder.file("main.pbrt"),
          "WorldBegin\nImport \"a.pbrt\" Shape \"sphere\" NamedMaterial \"m\"");
    write(folder.file("a.pbrt"),
          "Translate 1 0 0 Shape \"sphere\" MakeNamedMaterial \"m\" \"string type\" \"diffuse\"");
    const Scene scene = read_scene(folder.file("main.pbrt"));
    EXPECT_EQ(x_of(scene.shapes.at(0)), 1);
    EXPECT_EQ(x_of(scene.shapes.at(1)), 0);
    write(folder.file("a.pbrt"), "AttributeBegin");
    try {
        read_scene(folder.file("main.pbrt"));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_TRUE(contains(error.message(), "a.pbrt:1:1: AttributeBegin is not closed"));
    }
    EXPECT_PLACE_AND_TEXT(error_of("Import \"x\""), "t.pbrt:1:1", "before WorldBegin");
}

TEST(Grammar, IncludesThatNeverEndAreErrors) {
    TemporaryFolder folder;
    const auto message = [&] {
        try {
            read_scene(folder.file("main.pbrt"));
        } catch (const Error& error) {
            return error.message();
        }
        return std::string();
    };
    write(folder.file("main.pbrt"), "WorldBegin\n  Include \"a.pbrt\"");
    write(folder.file("a.pbrt"), "Include \"./main.pbrt\"");
    EXPECT_TRUE(contains(message(), "a.pbrt:1:9: ")) << message();
    EXPECT_TRUE(contains(message(), "includes itself")) << message();
    write(folder.file("a.pbrt"), "Include \"missing.pbrt\"");
    EXPECT_TRUE(contains(message(), "scene file not found")) << message();
    write(folder.file("a.pbrt"), "Include \"..\"");
    EXPECT_TRUE(contains(message(), "not a regular file")) << message();
    write(folder.file("main.pbrt"), "Include \"0.pbrt\"");
    for (int i = 0; i < 80; ++i) {
        write(folder.file(std::to_string(i) + ".pbrt"),
              "Include \"" + std::to_string(i + 1) + ".pbrt\"");
    }
    EXPECT_TRUE(contains(message(), "too much is included")) << message();
}

TEST(Grammar, MediaStandAsVacuum) {
    const Scene scene = world_of(
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"float scale\" 2\n"
        "MediumInterface \"fog\" \"\" Shape \"sphere\" MediumInterface \"\" Shape \"sphere\"");
    EXPECT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.stand_ins.size(), 2u);
    EXPECT_PLACE_AND_TEXT(world_error_of("MediumInterface \"fog\""), "t.pbrt:2:1", "no medium");
}

TEST(Grammar, MessagesAreGivenOnce) {
    const Scene scene = world_of(
        "Shape \"curve\" \"point3 P\" [0 0 0]\nShape \"curve\" \"point3 P\" [0 0 0]\nShape "
        "\"curve\" \"point3 P\" [0 0 0]");
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "t.pbrt:2:1: Shape \"curve\" is not modelled; it is left out (and 2 more places like "
              "it)");
}

}  // namespace
}  // namespace drude
