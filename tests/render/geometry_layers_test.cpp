// The layers of Film "gbuffer" on a scene that is known on paper.
#include <gtest/gtest.h>

#include "materials/surface.h"
#include "render/geometry_layers.h"
#include "test_scenes.h"

namespace drude {
namespace {

Image layers_of(const Scene& scene, int threads = 0) {
    const Geometry geometry(scene);
    Image image;
    image.width = scene.film.width;
    image.height = scene.film.height;
    add_geometry_layers(scene, geometry, CameraRays(scene.camera, image.width, image.height),
                        threads, &image);
    return image;
}

// A disk with its lower half behind a tilted metal square, seen orthographically from (0, 0, -3)
// of the world in units of 2: camera z = (world z + 3) / 2.
const char* world =
    "Translate 0 0 1.5 Scale 0.5 0.5 0.5\nCamera \"orthographic\" \"float screenwindow\" "
    "[-1 1 -1 1]\nFilm \"gbuffer\" \"integer xresolution\" 4 \"integer yresolution\" 4 {}\n"
    "PixelFilter \"box\"\nWorldBegin\n"
    "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0.2 0.4 0.8]\nTranslate 0 0 1 "
    "Shape \"disk\" \"float radius\" 1.6 AttributeEnd\n"
    "Material \"conductor\" \"string material\" \"Cu\"\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-2 -2 -2 2 -2 -2 2 0 0 "
    "-2 0 0]\n";

TEST(GeometryLayers, HoldWhatTheCentresSee) {
    const Image image = layers_of(parse_scene(fmt::format(fmt::runtime(world), ""), "g.pbrt"));
    EXPECT_EQ(image.text("geometrySpace"), "camera");
    const auto at = [&](const char* name, int x, int y) {
        return static_cast<double>(image.find(name)->data[static_cast<size_t>(y) * 4 + x]);
    };
    // The corner sees nothing.
    for (const char* name : {"P.X", "P.Z", "Z", "N.Z", "Ns.Z", "u", "Albedo.R"}) {
        EXPECT_EQ(at(name, 0, 0), 0) << name;
    }
    EXPECT_EQ(at("Material", 0, 0), -1);
    // The disk, at world (0.5, 0.5, 1).
    EXPECT_NEAR(at("P.X", 2, 1), 0.25, 1e-6);
    EXPECT_NEAR(at("P.Y", 2, 1), 0.25, 1e-6);
    EXPECT_NEAR(at("P.Z", 2, 1), 2, 1e-6);
    EXPECT_NEAR(at("Z", 2, 1), 2, 1e-6);
    EXPECT_NEAR(at("N.Z", 2, 1), -1, 1e-6);
    EXPECT_NEAR(at("u", 2, 1), 0.125, 1e-6);
    EXPECT_NEAR(at("v", 2, 1), 1 - std::sqrt(0.5) / 1.6, 1e-6);
    EXPECT_NEAR(at("Albedo.R", 2, 1), 0.2, 3e-3);
    EXPECT_NEAR(at("Albedo.G", 2, 1), 0.4, 3e-3);
    EXPECT_NEAR(at("Albedo.B", 2, 1), 0.8, 3e-3);
    // The square, at world (0.5, -1.5, -1.5): its normal halfway between -z and +y.
    const double h = std::sqrt(0.5);
    EXPECT_NEAR(at("P.Z", 2, 3), 0.75, 1e-6);
    EXPECT_NEAR(at("N.X", 2, 3), 0, 1e-6);
    EXPECT_NEAR(at("N.Y", 2, 3), h, 1e-6);
    EXPECT_NEAR(at("Ns.Z", 2, 3), -h, 1e-6);
    EXPECT_EQ(at("Material", 2, 3), at("Material", 1, 2));
    EXPECT_GT(at("Material", 2, 3), at("Material", 2, 1));
    // Copper at 45 degrees, summed at 1 nm.
    const Scene scene = parse_scene(fmt::format(fmt::runtime(world), ""), "g.pbrt");
    const auto& copper =
        std::get<ConductorMaterial>(scene.materials[static_cast<size_t>(at("Material", 2, 3))]);
    DenseSpectrum reflected{}, white{};
    for (int i = 0; i < spectrum_size; ++i) {
        white[i] = illuminant_d65()[i];
        reflected[i] = white[i] * reflect(copper.surface, spectrum_first_nm + i, h).A();
    }
    const RGB rgb = xyz_to_rgb(spectrum_to_xyz(reflected));
    const double unit = xyz_to_rgb(spectrum_to_xyz(white))[1];
    EXPECT_NEAR(at("Albedo.R", 2, 3), rgb[0] / unit, 3e-3);
    EXPECT_NEAR(at("Albedo.G", 2, 3), rgb[1] / unit, 3e-3);
    EXPECT_NEAR(at("Albedo.B", 2, 3), rgb[2] / unit, 3e-3);
}

TEST(GeometryLayers, InTheWorldAndOnAnyNumberOfThreads) {
    const Scene scene = parse_scene(
        fmt::format(fmt::runtime(world), "\"string coordinatesystem\" \"world\""), "g.pbrt");
    const Image one = layers_of(scene, 1), three = layers_of(scene, 3);
    EXPECT_EQ(one.text("geometrySpace"), "world");
    EXPECT_NEAR(one.find("P.X")->data[6], 0.5, 1e-6);
    EXPECT_NEAR(one.find("P.Z")->data[6], 1, 1e-6);
    EXPECT_NEAR(one.find("Z")->data[6], 2, 1e-6);
    ASSERT_EQ(one.channels.size(), three.channels.size());
    for (size_t i = 0; i < one.channels.size(); ++i) {
        EXPECT_EQ(one.channels[i].data, three.channels[i].data) << one.channels[i].name;
    }
}

TEST(GeometryLayers, ASphericalPictureHasDistances) {
    const Scene scene = parse_scene(
        "Camera \"spherical\"\nFilm \"gbuffer\" \"integer xresolution\" 8 \"integer yresolution\" "
        "8\n"
        "WorldBegin Scale 5 5 5 Shape \"sphere\"",
        "g.pbrt");
    const Image image = layers_of(scene);
    for (const float depth : image.find("Z")->data) EXPECT_NEAR(depth, 5, 1e-5);
}

}  // namespace
}  // namespace drude
