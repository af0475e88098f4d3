// Cameras, analysers, films and crops as a scene writes them.
#include <gtest/gtest.h>

#include "scene/resolution.h"
#include "scene_text.h"

namespace drude {
namespace {

Scene of(const std::string& settings) {
    return scene_of(settings + "\nWorldBegin\n");
}

TEST(CameraText, EveryKind) {
    const Scene flat =
        of("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50\n"
           "Camera \"orthographic\" \"float lensradius\" 0.5 \"float focaldistance\" 3");
    EXPECT_EQ(flat.camera.kind, CameraKind::orthographic);
    EXPECT_EQ(flat.camera.screen_window[1], 2);
    EXPECT_EQ(flat.camera.lens_radius, 0.5);
    EXPECT_EQ(flat.camera.focal_distance, 3);
    EXPECT_EQ(flat.stand_ins.size(), 1u);
    EXPECT_TRUE(warns(flat, "t.pbrt:2:23: Camera \"orthographic\": every point of the picture"));
    EXPECT_TRUE(of("Camera \"orthographic\" \"float screenwindow\" [-1 1 -2 2]").stand_ins.empty());

    const Scene ball = of("Camera \"spherical\" \"float lensradius\" 2 \"float focaldistance\" 1");
    EXPECT_EQ(ball.camera.kind, CameraKind::spherical);
    EXPECT_TRUE(ball.camera.equal_area);
    EXPECT_EQ(ball.camera.lens_radius, 0);
    EXPECT_EQ(ball.camera.screen_window[0], 0);
    EXPECT_EQ(ball.camera.screen_window[3], 1);
    EXPECT_TRUE(ball.stand_ins.empty());
    EXPECT_FALSE(
        of("Camera \"spherical\" \"string mapping\" \"equirectangular\"").camera.equal_area);
    EXPECT_PLACE_AND_TEXT(
        error_of("Camera \"spherical\" \"string mapping\" \"equirect\"\nWorldBegin"), "t.pbrt:1:20",
        "there is no mapping 'equirect'");
    EXPECT_PLACE_AND_TEXT(error_of("Camera \"perspective\" \"float lensradius\" 1 "
                                   "\"float focaldistance\" 0\nWorldBegin"),
                          "t.pbrt:1:65", "focaldistance is 0");
}

TEST(CameraText, Analysers) {
    EXPECT_FALSE(of("Camera \"perspective\"").camera.analyser);
    const auto plain = of("Camera \"perspective\" \"float analyser\" 30").camera.analyser;
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->axis_deg, 30);
    EXPECT_FALSE(plain->retarder);
    const auto circular = of("Camera \"spherical\" \"float analyser\" 0 \"float retarder\" 90 "
                             "\"float retarderaxis\" -45")
                              .camera.analyser;
    ASSERT_TRUE(circular && circular->retarder);
    EXPECT_EQ(circular->retarder->retardance_deg, 90);
    EXPECT_EQ(circular->retarder->fast_axis_deg, -45);
    for (const char* bad :
         {"\"float retarder\" 90", "\"float analyser\" 1 \"float retarderaxis\" 3",
          "\"float analyser\" 400", "\"float analyzer\" 30", "\"string analyser\" \"30\""}) {
        EXPECT_FALSE(
            error_of(std::string("Camera \"perspective\" ") + bad + "\nWorldBegin").empty());
    }
}

TEST(FilmText, WhatScenesWant) {
    EXPECT_FALSE(of("Film \"rgb\"").film.spectral);
    const Scene spectral = of("Film \"spectral\"");
    EXPECT_TRUE(spectral.film.spectral);
    EXPECT_TRUE(warns(spectral, "16 layers from 360 to 830 nm are not written; 40 layers"));
    EXPECT_EQ(spectral.stand_ins.size(), 1u);
    EXPECT_TRUE(of("Film \"spectral\" \"integer nbuckets\" 40 \"float lambdamin\" 380 "
                   "\"float lambdamax\" 780")
                    .stand_ins.empty());
    EXPECT_PLACE_AND_TEXT(error_of("Film \"spectral\" \"float lambdamax\" 300\nWorldBegin"),
                          "t.pbrt:1:17", "lambdamax 300");
    const Scene geometry = of("Film \"gbuffer\" \"string coordinatesystem\" \"world\"");
    EXPECT_TRUE(geometry.film.gbuffer);
    EXPECT_TRUE(geometry.film.gbuffer_in_world);
    EXPECT_FALSE(of("Film \"gbuffer\"").film.gbuffer_in_world);
    EXPECT_PLACE_AND_TEXT(
        error_of("Film \"gbuffer\" \"string coordinatesystem\" \"word\"\nWorldBegin"),
        "t.pbrt:1:16", "'world'");
}

const char* film = "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 ";

TEST(FilmText, Crops) {
    const auto expect_crop = [](const Scene& scene, int x0, int y0, int width, int height) {
        ASSERT_TRUE(scene.film.crop);
        EXPECT_EQ(scene.film.crop->x0, x0);
        EXPECT_EQ(scene.film.crop->y0, y0);
        EXPECT_EQ(scene.film.width, width);
        EXPECT_EQ(scene.film.height, height);
    };
    // Fractions are rounded up, as in pbrt-v4.
    const Scene window = of(std::string(film) + "\"float cropwindow\" [0.101 0.5 0.25 1]");
    expect_crop(window, 11, 13, 39, 37);
    EXPECT_TRUE(window.stand_ins.empty());
    EXPECT_TRUE(warns(window, "from (11, 13) are rendered, as a picture of 39 x 37"));
    // The shorter side of the whole picture runs from -1 to 1.
    EXPECT_NEAR(window.camera.screen_window[0], -2 + 0.44, 1e-12);
    EXPECT_NEAR(window.camera.screen_window[1], 0, 1e-12);
    EXPECT_NEAR(window.camera.screen_window[2], -1, 1e-12);
    EXPECT_NEAR(window.camera.screen_window[3], 1 - 0.52, 1e-12);
    const Scene pixels = of(std::string(film) + "\"integer pixelbounds\" [90 120 0 10]");
    expect_crop(pixels, 90, 0, 10, 10);
    EXPECT_TRUE(warns(pixels, "reach beyond the picture"));
    expect_crop(of(std::string(film) + "\"integer pixelbounds\" [1 2 3 4] "
                                       "\"float cropwindow\" [0 0.5 0 1]"),
                0, 0, 50, 50);
    EXPECT_FALSE(of(std::string(film) + "\"float cropwindow\" [0 1 0 1]").film.crop);
    for (const char* bad :
         {"\"float cropwindow\" [0 0.5 0.2]", "\"float cropwindow\" [0.5 0.5 0 1]",
          "\"float cropwindow\" [0 2 0 1]", "\"integer pixelbounds\" [5 2 0 1]",
          "\"integer pixelbounds\" [100 102 0 1]", "\"float cropwindow\" [0.991 0.999 0 1]"}) {
        EXPECT_FALSE(error_of(std::string(film) + bad + "\nWorldBegin").empty());
    }
}

// Another resolution is that of the whole picture; the part stays where it is.
TEST(FilmText, ACropKeepsItsPlaceAtAnotherResolution) {
    Scene scene = of(std::string(film) + "\"float cropwindow\" [0.25 0.5 0.5 1]");
    set_resolution("400x200", "size", &scene);
    EXPECT_EQ(scene.film.width, 100);
    EXPECT_EQ(scene.film.height, 100);
    EXPECT_EQ(scene.film.crop->x0, 100);
    EXPECT_NEAR(scene.camera.screen_window[0], -1, 1e-12);
    EXPECT_NEAR(scene.camera.screen_window[3], 0, 1e-12);
    // Of a single pixel one is left however small the picture.
    set_resolution("1x1", "size", &scene);
    EXPECT_EQ(scene.film.width, 1);
    EXPECT_EQ(scene.film.height, 1);
}

}  // namespace
}  // namespace drude
