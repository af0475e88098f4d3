#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/files.h"
#include "base/module.h"
#include "image/image.h"
#include "image/oiio_loader.h"
#include "image/srgb.h"
#include "temporary_folder.h"

namespace drude {
namespace {

std::vector<float> ramp(int width, int height) {
    std::vector<float> rgb;
    for (int i = 0; i < width * height * 3; ++i) {
        rgb.push_back(static_cast<float>(i) / static_cast<float>(width * height * 3));
    }
    return rgb;
}

TEST(Srgb, KnownPointsAndRoundTrip) {
    EXPECT_EQ(srgb_byte(0.0F), 0);
    EXPECT_EQ(srgb_byte(1.0F), 255);
    EXPECT_EQ(srgb_byte(0.2158605F), 128);  // ((128/255 + 0.055)/1.055)^2.4
    EXPECT_EQ(srgb_byte(0.18F), 118);
    EXPECT_EQ(srgb_byte(-3.0F), 0);
    EXPECT_EQ(srgb_byte(7.0F), 255);
    EXPECT_EQ(srgb_byte(std::nanf("")), 0);
    for (int i = 0; i <= 255; ++i) {
        EXPECT_EQ(srgb_byte(linear_from_srgb(static_cast<float>(i) / 255.0F)), i);
    }
}

TEST(Png, IsWrittenAndReadBackWithinItsEightBits) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.png");
    const std::vector<float> rgb = ramp(17, 9);
    write_png(path, 17, 9, rgb);
    const std::string bytes = read_file(path);
    EXPECT_EQ(bytes, encode_png(17, 9, rgb));
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    const Image image = read_image(path);
    ASSERT_EQ(image.width, 17);
    ASSERT_EQ(image.height, 9);
    ASSERT_EQ(image.channels.size(), 3U);
    EXPECT_EQ(image.channels[0].name, "R");
    const std::vector<float> back = rgb_values(image, path);
    for (size_t i = 0; i < rgb.size(); ++i) {
        EXPECT_NEAR(srgb_from_linear(back[i]), srgb_from_linear(rgb[i]), 0.502 / 255.0) << i;
    }
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST(Png, FullDiskIsAnOutsideErrorAndLeavesNothingBehind) {
    const TemporaryFolder folder;
    oiio_module();  // loading may itself write (caches); only the picture is to be limited
    const auto old_handler = signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    rlimit limited = old_limit;
    limited.rlim_cur = 50;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
    int cause = 0;
    try {
        write_png(folder.file("a.png"), 40, 40, ramp(40, 40));
    } catch (const Error& error) {
        cause = static_cast<int>(error.cause());
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old_limit), 0);
    signal(SIGXFSZ, old_handler);
    EXPECT_EQ(cause, 3);
    EXPECT_EQ(folder.names().size(), 0U);
}

// Radiance's format written by hand: four flat pixels, no run lengths. A mantissa m with exponent
// e is m/256 2^(e-128), linear, and must not be decoded as sRGB.
TEST(ReadImage, FloatFormatsStayLinear) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.hdr");
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
    for (int i = 0; i < 4; ++i) bytes += std::string("\x80\x40\x20\x83", 4);
    write_file(path, bytes);
    const Image image = read_image(path);
    ASSERT_EQ(image.pixels(), 4U);
    EXPECT_NEAR(image.at("R", path).data[3], 4.0F, 0.04F);
    EXPECT_NEAR(image.at("G", path).data[3], 2.0F, 0.04F);
    EXPECT_NEAR(image.at("B", path).data[3], 1.0F, 0.04F);
}

TEST(ReadImage, SixteenBitGreyIsDecoded) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.pgm");
    // 16-bit PGM, most significant byte first: half of the display range.
    write_file(path, std::string("P5\n1 1\n65535\n\x80\x00", 15));
    const Image image = read_image(path);
    EXPECT_NEAR(image.at("Y", path).data[0], 0.2140F, 2e-4F);
}

TEST(ReadImage, ContentDecidesNotTheName) {
    const TemporaryFolder folder;
    Image image;
    image.width = image.height = 1;
    image.add("Q").data[0] = 5.0F;
    write_exr(folder.file("lying.png"), image, Compression::none);
    EXPECT_EQ(read_image(folder.file("lying.png")).at("Q", "q").data[0], 5.0F);
}

TEST(ReadImage, BadFilesAreUserErrors) {
    const TemporaryFolder folder;
    const std::string png = encode_png(30, 30, ramp(30, 30));
    write_file(folder.file("empty.png"), "");
    write_file(folder.file("text.png"), "no picture");
    write_file(folder.file("cut.png"), png.substr(0, 40));
    for (const char* name : {"absent.png", "empty.png", "text.png", "cut.png", ""}) {
        try {
            read_image(folder.file(name));
            ADD_FAILURE() << name << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user) << error.message();
            EXPECT_NE(error.message().find(folder.file(name)), std::string::npos);
        }
    }
}

TEST(Module, IsLookedForInTheFoldersOfTheEnvironmentFirst) {
    ASSERT_EQ(setenv("DRUDE_MODULE_PATH", "/first/place:/second/place", 1), 0);
    const std::vector<std::string> candidates = module_candidates(oiio_module_file);
    unsetenv("DRUDE_MODULE_PATH");
    ASSERT_GE(candidates.size(), 4U);
    EXPECT_EQ(candidates[0], "/first/place/drude-oiio.so");
    EXPECT_EQ(candidates[1], "/second/place/drude-oiio.so");
    EXPECT_EQ(candidates[2], std::string(DRUDE_BINARY_DIR) + "/drude-oiio.so");
}

// In a process of its own, since a module that was loaded once stays loaded.
TEST(ModuleDeathTest, ThatDoesNotLoadIsAnOutsideErrorWithAdvice) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const TemporaryFolder folder;
    write_file(folder.file("drude-oiio.so"), "no library");
    const std::string place = std::filesystem::path(folder.file("x")).parent_path().string();
    EXPECT_EXIT(
        {
            setenv("DRUDE_MODULE_PATH", place.c_str(), 1);
            try {
                oiio_module();
                std::_Exit(10);
            } catch (const Error& error) {
                const bool advice = error.message().find("libopenimageio") != std::string::npos;
                std::_Exit(error.cause() == Cause::outside && advice ? 42 : 11);
            }
        },
        testing::ExitedWithCode(42), "");
}

}  // namespace
}  // namespace drude
