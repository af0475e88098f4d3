// Textures in pictures: a diffuse quad under a constant sky has its reflectance as radiance.
#include <gtest/gtest.h>

#include "test_scenes.h"

namespace drude {
namespace {

constexpr int columns = 8, rows = 4;

// Seen straight on, a pixel a square of the texture.
Scene quad(const std::string& material) {
    return parse_scene(
        "LookAt 0 0 -5  0 0 0  0 1 0\n"
        "Camera \"orthographic\" \"float screenwindow\" [-2 2 -1 1]\n"
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 4\n"
        "PixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5\n"
        "Integrator \"path\" \"integer maxdepth\" 1\nWorldBegin\n"
        "LightSource \"infinite\" \"rgb L\" [1 1 1]\n" +
            material + "Shape \"bilinearmesh\" \"point3 P\" [-2 -1 0  2 -1 0  -2 1 0  2 1 0]\n",
        "quad.pbrt");
}

const char* const board =
    "Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [0.8 0.2 0.1] "
    "\"rgb tex2\" [0.1 0.4 0.6] \"float uscale\" 8 \"float vscale\" 4\n";

// Mean over the pixels of one kind of square, R, G or B.
double mean_of(const Image& image, const char* channel, int parity) {
    double sum = 0;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            // v counts from the bottom, rows from the top.
            if ((x + (rows - 1 - y)) % 2 != parity) continue;
            sum += image.find(channel)->data[static_cast<size_t>(y * columns + x)];
        }
    }
    return sum / (columns * rows / 2);
}

TEST(TexturedPictures, ADiffuseQuadShowsItsCheckerboard) {
    const Scene scene =
        quad(std::string(board) + "Material \"diffuse\" \"texture reflectance\" \"c\"\n");
    const Image image = render_quietly(scene, 256).image;
    const double expected[2][3] = {{0.8, 0.2, 0.1}, {0.1, 0.4, 0.6}};
    for (int parity = 0; parity < 2; ++parity) {
        for (int c = 0; c < 3; ++c) {
            const std::string channel(1, "RGB"[c]);
            EXPECT_NEAR(mean_of(image, channel.c_str(), parity), expected[parity][c], 0.01);
        }
    }
}

TEST(TexturedPictures, AMetalsReflectanceChangesOverIt) {
    const Scene scene =
        quad(std::string(board) + "Material \"conductor\" \"texture reflectance\" \"c\"\n");
    const Image image = render_quietly(scene, 256).image;
    EXPECT_NEAR(mean_of(image, "R", 0), 0.8, 0.01);
    EXPECT_NEAR(mean_of(image, "B", 1), 0.6, 0.01);
}

TEST(TexturedPictures, HaveTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene =
        quad(std::string(board) + "Material \"diffuse\" \"texture reflectance\" \"c\"\n");
    const Image one = render_quietly(scene, 32, false, false, 1).image;
    const Image two = render_quietly(scene, 32, false, false, 2).image;
    for (const char* channel : {"R", "G", "B"}) {
        EXPECT_EQ(one.find(channel)->data, two.find(channel)->data);
    }
}

}  // namespace
}  // namespace drude
