// Texture "imagemap": pixels, filters, wraps, encodings, damaged files.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/crc32.h"
#include "base/executor.h"
#include "image/image.h"
#include "image/srgb.h"
#include "render/textures.h"
#include "temporary_folder.h"

namespace drude {
namespace {

constexpr int width = 4, height = 3;

// The byte of channel c in column x of row y from the top.
int byte_at(int x, int y, int c) {
    return (37 + 50 * x + 23 * y + 90 * c) % 256;
}

// A folder with p.png, and p.exr with the same numbers / 255 undecoded.
class ImageTextures : public testing::Test {
  protected:
    void SetUp() override {
        std::vector<float> rgb;
        Image image;
        image.width = width;
        image.height = height;
        for (const char* name : {"B", "G", "R"}) image.add(name);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const float value = static_cast<float>(byte_at(x, y, c)) / 255;
                    rgb.push_back(linear_from_srgb(value));
                    image.find(std::string(1, "RGB"[c]))->data[static_cast<size_t>(y * width + x)] =
                        value;
                }
            }
        }
        write_png(folder_.file("p.png"), width, height, rgb);
        write_exr(folder_.file("p.exr"), image, Compression::zip);
    }

    // A picture with the parameters; number and colour.
    struct Picture {
        Scene scene;
        NumberTextures numbers;
        explicit Picture(Scene s) : scene(std::move(s)), numbers(scene) {}
        double number(double u, double v) const {
            return numbers.value({0, 0}, {{0, 0, 0}, {0, 0, 1}, {u, v}});
        }
        double spectrum(double u, double v, double nm) const {
            return spectrum_texture_value(scene, numbers, {{}, 0}, {{0, 0, 0}, {0, 0, 1}, {u, v}},
                                          nm);
        }
    };
    Picture picture(const std::string& file, const std::string& parameters = "") const {
        const std::string texture =
            fmt::format("\"imagemap\" \"string filename\" \"{}\" {}\n", file, parameters);
        return Picture(parse_scene("WorldBegin\nTexture \"n\" \"float\" " + texture +
                                       "Texture \"s\" \"spectrum\" " + texture,
                                   folder_.file("t.pbrt")));
    }

    static double red(int x, int y) { return byte_at(x, y, 0) / 255.0; }
    // The middle of a pixel; y counts from the top, v from the bottom.
    static double u_of(double x) { return (x + 0.5) / width; }
    static double v_of(double y) { return 1 - (y + 0.5) / height; }

    TemporaryFolder folder_;
};

TEST_F(ImageTextures, MiddlesOfPixelsGiveTheirValuesInEveryEncoding) {
    const Picture srgb = picture("p.png"),
                  linear = picture("p.png", "\"string encoding\" \"linear\""),
                  gamma = picture("p.png", "\"string encoding\" \"gamma 1.8\""),
                  exr = picture("p.exr", "\"string encoding\" \"sRGB\"");
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double u = u_of(x), v = v_of(y);
            const double code = red(x, y);
            const double expected =
                code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(srgb.number(u, v), expected, 1e-6);
            EXPECT_NEAR(linear.number(u, v), code, 1e-6);
            EXPECT_NEAR(gamma.number(u, v), std::pow(code, 1.8), 1e-6);
            EXPECT_NEAR(exr.number(u, v), code, 1e-6);  // floats are not encoded
            double colour = 0;
            for (int c = 0; c < 3; ++c) {
                colour += byte_at(x, y, c) / 255.0 * mallett_yuksel_basis()[c][100];
            }
            EXPECT_NEAR(linear.spectrum(u, v, 480), colour, 1e-6);
        }
    }
}

TEST_F(ImageTextures, BilinearLiesBetweenThePixelsAndPointDoesNot) {
    const Picture bilinear = picture("p.exr"),
                  point = picture("p.exr", "\"string filter\" \"point\"");
    for (const double a : {0.1, 0.5, 0.8}) {
        for (const double b : {0.2, 0.7}) {
            const double u = u_of(1 + a), v = v_of(0 + b);
            const double expected = (1 - b) * ((1 - a) * red(1, 0) + a * red(2, 0)) +
                                    b * ((1 - a) * red(1, 1) + a * red(2, 1));
            EXPECT_NEAR(bilinear.number(u, v), expected, 1e-6);
            const int x = a < 0.5 ? 1 : 2, y = b < 0.5 ? 0 : 1;
            EXPECT_NEAR(point.number(u_of(a == 0.5 ? 1.6 : 1 + a), v), red(x, y), 1e-6);
        }
    }
}

TEST_F(ImageTextures, WrapSaysWhatLiesOutside) {
    const Picture repeat = picture("p.exr"), clamp = picture("p.exr", "\"string wrap\" \"clamp\""),
                  black = picture("p.exr", "\"string wrap\" \"black\"");
    // Two pixels to the left of column 0, and so one before the last; one row below the last.
    const double u = u_of(-2), v = v_of(3);
    EXPECT_NEAR(repeat.number(u, v), red(2, 0), 1e-6);
    EXPECT_NEAR(clamp.number(u, v), red(0, 2), 1e-6);
    EXPECT_EQ(black.number(u, v), 0);
    // On the edge half of what a bilinear filter sees is the other side.
    const double edge = v_of(1);
    EXPECT_NEAR(repeat.number(0, edge), (red(0, 1) + red(3, 1)) / 2, 1e-6);
    EXPECT_NEAR(clamp.number(0, edge), red(0, 1), 1e-6);
    EXPECT_NEAR(black.number(0, edge), red(0, 1) / 2, 1e-6);
    // Far away, and where there is no number.
    EXPECT_NEAR(repeat.number(u_of(1) - 1000, v_of(1) + 77), red(1, 1), 1e-5);
    EXPECT_NEAR(clamp.number(1e30, 1e30), red(3, 0), 1e-6);
    EXPECT_EQ(black.number(1e30, 0.5), 0);
    EXPECT_TRUE(std::isfinite(repeat.number(std::nan(""), 1e308 * 10)));
}

TEST_F(ImageTextures, ScaleComesBeforeInvert) {
    const Picture scaled = picture("p.exr", "\"float scale\" 1.5");
    const Picture inverted = picture("p.exr", "\"float scale\" 1.5 \"bool invert\" true");
    int clipped = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double value = 1.5 * red(x, y);
            EXPECT_NEAR(scaled.number(u_of(x), v_of(y)), value, 1e-6);
            EXPECT_NEAR(inverted.number(u_of(x), v_of(y)), std::max(0.0, 1 - value), 1e-6);
            clipped += value > 1;
        }
    }
    EXPECT_GT(clipped, 0);
}

TEST_F(ImageTextures, GreyPicturesAreFlatSpectra) {
    Image grey;
    grey.width = grey.height = 1;
    grey.add("Y").data[0] = 0.3f;
    write_exr(folder_.file("y.exr"), grey, Compression::none);
    const Picture one = picture("y.exr");
    EXPECT_NEAR(one.number(0.2, 0.9), 0.3, 1e-6);
    for (const double nm : {400.0, 555.5, 700.0}) {
        EXPECT_NEAR(one.spectrum(0.2, 0.9, nm), 0.3, 1e-6);
    }
}

// What a camera sees of a quad is the picture, upright and not mirrored.
TEST_F(ImageTextures, AQuadShowsThePicture) {
    const Scene scene = parse_scene(
        "WorldBegin\nTexture \"n\" \"float\" \"imagemap\" \"string filename\" \"p.exr\"\n"
        "Material \"diffuse\"\nShape \"bilinearmesh\" \"point3 P\" [-2 -1 0  2 -1 0  -2 1 0  2 1 "
        "0]",
        folder_.file("t.pbrt"));
    const Geometry geometry(scene);
    const NumberTextures numbers(scene);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float px = -2 + 4 * static_cast<float>(u_of(x));
            const float py = -1 + 2 * static_cast<float>(v_of(y));  // y up
            Hit hit;
            ASSERT_TRUE(geometry.intersect({px, py, -5}, {0, 0, 1}, &hit));
            EXPECT_NEAR(numbers.value({0, 0}, TexturePoint(geometry, hit)), red(x, y), 1e-5);
        }
    }
}

// Larger than a few tiles of the cache, read by several threads at once in any order.
TEST_F(ImageTextures, ThreadsDoNotChangeABit) {
    constexpr int size = 300;
    std::vector<float> rgb(3 * size * size);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(i * 7919 % 1000) / 1000;
    write_png(folder_.file("large.png"), size, size, rgb);
    constexpr size_t count = 20000;
    const auto values = [&](int threads) {
        const Picture large = picture("large.png");
        std::vector<double> result(count);
        parallel_for(count, threads, [&](size_t i) {
            const double u = std::fmod(static_cast<double>(i) * 0.618033988749895, 1);
            const double v = std::fmod(static_cast<double>(i) * 0.754877666246693, 1);
            result[i] = large.spectrum(u, v, 500);
        });
        return result;
    };
    const std::vector<double> one = values(1);
    EXPECT_EQ(one, values(2));
    EXPECT_EQ(one, values(7));
}

class BrokenPictures : public ImageTextures {
  protected:
    // The message of opening, or of reading everywhere; with its place.
    std::string message(const std::string& file) const {
        try {
            const Picture bad = picture(file);
            for (int i = 0; i < 1000; ++i) bad.number(i * 0.377, i * 0.001);
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            const std::string place = folder_.file("t.pbrt") + ":2:32: ";
            EXPECT_EQ(error.message().substr(0, place.size()), place);
            return error.message().substr(std::min(place.size(), error.message().size()));
        }
        return "nothing was thrown";
    }
    std::string bytes(const std::string& file) const {
        std::stringstream text;
        text << std::ifstream(folder_.file(file), std::ios::binary).rdbuf();
        return text.str();
    }
    void write(const std::string& file, const std::string& text) const {
        std::ofstream(folder_.file(file), std::ios::binary) << text;
    }
};

TEST_F(BrokenPictures, AreErrorsWithTheirPlace) {
    EXPECT_NE(message("none.png").find("picture of a texture not found"), std::string::npos);
    write("text.png", "no picture at all\n");
    EXPECT_NE(message("text.png").find("text.png: cannot read this picture"), std::string::npos)
        << message("text.png");
    write("empty.exr", "");
    EXPECT_NE(message("empty.exr").find("empty.exr: cannot read this picture"), std::string::npos)
        << message("empty.exr");
    constexpr int size = 200;
    std::vector<float> rgb(3 * size * size);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(i * 7919 % 1000) / 1000;
    write_png(folder_.file("whole.png"), size, size, rgb);
    const std::string whole = bytes("whole.png");
    write("half.png", whole.substr(0, whole.size() / 2));
    EXPECT_NE(message("half.png").find("half.png: cannot read this picture"), std::string::npos)
        << message("half.png");
    const std::string exr = bytes("p.exr");
    write("half.exr", exr.substr(0, exr.size() - 20));
    EXPECT_NE(message("half.exr").find("half.exr: cannot read this picture"), std::string::npos)
        << message("half.exr");
}

// A header that claims 40000 x 40000 pixels takes no memory.
TEST_F(BrokenPictures, HugeOnesAreRefused) {
    std::string png = bytes("p.png");
    const auto put = [&](size_t at, uint32_t value) {
        for (size_t i = 0; i < 4; ++i) png[at + i] = static_cast<char>(value >> (24 - 8 * i));
    };
    put(16, 40000);
    put(20, 40000);
    put(29, crc32(std::string_view(png).substr(12, 17)));
    write("huge.png", png);
    EXPECT_NE(message("huge.png").find("larger than 268435456 pixels"), std::string::npos)
        << message("huge.png");
}

TEST_F(BrokenPictures, ParametersAreChecked) {
    const auto parameters = [&](const std::string& text) -> std::string {
        try {
            picture("p.png", text);
        } catch (const Error& error) {
            return error.message();
        }
        return "nothing was thrown";
    };
    EXPECT_NE(parameters("\"string wrap\" \"reapeat\"").find("did you mean 'repeat'?"),
              std::string::npos);
    EXPECT_NE(parameters("\"string filter\" \"cubic\"").find("expected one of: point"),
              std::string::npos);
    EXPECT_NE(parameters("\"string encoding\" \"srgb\"").find("did you mean 'sRGB'?"),
              std::string::npos);
    EXPECT_NE(parameters("\"string encoding\" \"gamma 0\"").find("\"gamma X\""), std::string::npos);
}

}  // namespace
}  // namespace drude
