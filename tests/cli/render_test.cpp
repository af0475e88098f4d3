// `drude render` from outside: what its options do to the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "program.h"

namespace drude {
namespace {

constexpr const char* scene =
    "LookAt 0 0 -4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 32\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\n"
    "PixelFilter \"box\"\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
    "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" "
    "\"float beta\" 0\nShape \"sphere\"\n";

// Copper takes blue away; the sky is white.
void sphere_extent(const Image& image, int* width, int* height) {
    int x0 = image.width, x1 = -1, y0 = image.height, y1 = -1;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const size_t pixel = static_cast<size_t>(y) * image.width + x;
            if (image.find("B")->data[pixel] > 0.85f) continue;
            x0 = std::min(x0, x), x1 = std::max(x1, x);
            y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
    }
    *width = x1 - x0 + 1;
    *height = y1 - y0 + 1;
}

TEST(RenderCommand, AnotherResolutionKeepsCirclesRound) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    for (const char* resolution : {"64x64", "128x64", "48x96"}) {
        SCOPED_TRACE(resolution);
        const ProgramRun run = run_drude(
            folder, std::string("render s.pbrt --spp 128 -q -o a.exr --resolution ") + resolution);
        ASSERT_EQ(run.status, 0) << run.err;
        int width = 0, height = 0;
        sphere_extent(read_exr(folder.file("a.exr")), &width, &height);
        EXPECT_GT(width, 30);
        EXPECT_LT(width, 62);
        EXPECT_LE(std::abs(width - height), 2);
    }
}

TEST(RenderCommand, SaysWhyTheTransportIsExact) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    const ProgramRun run = run_drude(folder, "render s.pbrt --spp 1 -q -o a.exr");
    EXPECT_NE(run.out.find("transport scalar: the only surface that polarises"), std::string::npos)
        << run.out;
    const ProgramRun forced =
        run_drude(folder, "render s.pbrt --spp 1 -q --stokes --transport scalar -o a.exr");
    EXPECT_EQ(forced.status, 2);
    EXPECT_NE(forced.err.find("does not carry them"), std::string::npos) << forced.err;
}

// Same seed, same bits; the picture says what it was made from.
TEST(RenderCommand, PicturesAreReproducibleAndSayHowTheyWereMade) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    ASSERT_EQ(run_drude(folder, "render s.pbrt --spp 32 -q --threads 1 -o a.exr").status, 0);
    ASSERT_EQ(run_drude(folder, "render s.pbrt --spp 32 -q --threads 2 -o b.exr").status, 0);
    EXPECT_EQ(run_drude(folder, "compare a.exr b.exr --exact").status, 0);
    ASSERT_EQ(run_drude(folder, "render s.pbrt --spp 32 -q --seed 7 -o c.exr").status, 0);
    EXPECT_EQ(run_drude(folder, "compare a.exr c.exr --exact").status, 1);
    const Image image = read_exr(folder.file("a.exr"));
    for (const char* name : {"seed", "sampleRange", "sceneHash", "transport", "instructionSet",
                             "drudeVersion", "commandLine"}) {
        EXPECT_FALSE(image.text(name).empty()) << name;
    }
    EXPECT_EQ(image.number("samples", 0), 32);
    EXPECT_EQ(image.number("batches", 0), 2);
}

}  // namespace
}  // namespace drude
