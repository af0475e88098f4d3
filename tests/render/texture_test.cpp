// Textures against their definitions, point by point.
#include "render/textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/executor.h"
#include "materials/scalar.h"

namespace drude {
namespace {

// The last "float" and the last "spectrum" texture of a scene.
class Drawn {
  public:
    explicit Drawn(const std::string& world, const std::string& file = "t.pbrt")
        : scene_(parse_scene("WorldBegin\n" + world, file)),
          numbers_(scene_),
          spectra_(scene_, numbers_) {}

    double number(const TexturePoint& at) const { return numbers_.value(last_number(), at); }
    double number(double u, double v) const { return number({{0, 0, 0}, {0, 0, 1}, {u, v}}); }
    double number(const glm::dvec3& p, const glm::dvec3& n = {0, 0, 1}) const {
        return number(TexturePoint{p, n, {0, 0}});
    }
    double spectrum(const TexturePoint& at, double nm) const {
        return spectrum_texture_value(scene_, numbers_, last_spectrum(), at, nm);
    }
    Packet<8> packet(const TexturePoint& at, int phase) const {
        return spectra_.value(spectra_.pack(last_spectrum()), at, phase);
    }
    Packet<8> reflectance(const TexturePoint& at, int phase) const {
        return spectra_.reflectance(spectra_.pack(last_spectrum()), at, phase);
    }
    const Scene& scene() const { return scene_; }
    const NumberTextures& numbers() const { return numbers_; }

  private:
    NumberValue last_number() const {
        return {0, static_cast<int>(scene_.number_textures.size()) - 1};
    }
    SpectrumValue last_spectrum() const {
        return {{}, static_cast<int>(scene_.spectrum_textures.size()) - 1};
    }
    Scene scene_;
    NumberTextures numbers_;
    SpectrumTextures<8> spectra_;
};

// Bilinear corners that give back s, or t: they show what a mapping does.
std::string probe(const std::string& coordinate, const std::string& mapping) {
    const bool is_s = coordinate == "s";
    return std::string("Texture \"probe\" \"float\" \"bilerp\" \"float v00\" 0 \"float v11\" 1 ") +
           "\"float v10\" " + (is_s ? "1" : "0") + " \"float v01\" " + (is_s ? "0 " : "1 ") +
           mapping + "\n";
}

TEST(TextureMapping, UvIsScaledAndShifted) {
    const std::string mapping =
        "\"float uscale\" 3 \"float vscale\" -2 \"float udelta\" 0.25 "
        "\"float vdelta\" 7";
    const Drawn s(probe("s", mapping)), t(probe("t", mapping));
    for (const double u : {0.0, 0.3, 1.0}) {
        for (const double v : {0.0, 0.8, 1.0}) {
            EXPECT_NEAR(s.number(u, v), 3 * u + 0.25, 1e-12);
            EXPECT_NEAR(t.number(u, v), -2 * v + 7, 1e-12);
        }
    }
}

// A point at known spherical and cylindrical coordinates about the texture's own axis, seen in the
// world through the transformation that stood when the texture was named.
TEST(TextureMapping, SphericalCylindricalAndPlanarStandInTextureSpace) {
    for (const std::string transform :
         {"", "Translate 1 2 3\nRotate 50 1 -1 2\nScale 2 2 0.5\n", "Scale -1 1 1\n"}) {
        const std::string before = "AttributeBegin\n" + transform;
        const std::string after = "AttributeEnd\n";
        const auto drawn = [&](const char* coordinate, const std::string& mapping) {
            return Drawn(before + probe(coordinate, mapping) + after);
        };
        const Scene placed = parse_scene(
            "WorldBegin Material \"diffuse\"\n" + transform + "Shape \"sphere\"", "t.pbrt");
        const glm::dmat4 m = placed.shapes[0].world_from_object;
        const auto spherical = "\"string mapping\" \"spherical\"";
        const auto cylindrical = "\"string mapping\" \"cylindrical\"";
        const auto planar =
            "\"string mapping\" \"planar\" \"vector3 v1\" [2 0 1] "
            "\"vector3 v2\" [0 -1 3] \"float udelta\" 5 \"float vdelta\" -4";
        const Drawn sphere_s = drawn("s", spherical), sphere_t = drawn("t", spherical);
        const Drawn round_s = drawn("s", cylindrical), round_t = drawn("t", cylindrical);
        const Drawn plane_s = drawn("s", planar), plane_t = drawn("t", planar);
        for (const double theta : {0.3, 1.2, 2.9}) {
            for (const double phi : {0.1, 2.0, 3.5, 6.0}) {
                const double r = 1.7;
                const glm::dvec3 own(r * std::sin(theta) * std::cos(phi),
                                     r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
                const glm::dvec3 p(m * glm::dvec4(own, 1));
                EXPECT_NEAR(sphere_s.number(p), theta / pi, 1e-12);
                EXPECT_NEAR(sphere_t.number(p), phi / (2 * pi), 1e-12);
                // From the cut at -x, where atan2 jumps.
                const double turned = std::fmod(phi + pi, 2 * pi) / (2 * pi);
                EXPECT_NEAR(round_s.number(p), turned, 1e-12);
                EXPECT_NEAR(round_t.number(p), own.z, 1e-12);
                EXPECT_NEAR(plane_s.number(p), 5 + 2 * own.x + own.z, 1e-12);
                EXPECT_NEAR(plane_t.number(p), -4 - own.y + 3 * own.z, 1e-12);
            }
        }
    }
}

TEST(Checkerboard, SquaresAlternateOnBothSidesOfTheOrigin) {
    const Drawn board(
        "Texture \"c\" \"float\" \"checkerboard\" \"float tex1\" 2 \"float tex2\" 5 "
        "\"float uscale\" 4 \"float vscale\" 4 \"float udelta\" -2");
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            // s runs from -2 to 2.
            const double expected = (i + j) % 2 == 0 ? 2 : 5;
            EXPECT_EQ(board.number((i + 0.3) / 4, (j + 0.9) / 4), expected) << i << j;
        }
    }
}

TEST(Checkerboard, CubesAlternateInTextureSpace) {
    const Drawn board(
        "Scale 0.5 0.5 0.5\nTexture \"c\" \"float\" \"checkerboard\" "
        "\"integer dimension\" 3");
    for (int i = -2; i < 2; ++i) {
        for (int j = -2; j < 2; ++j) {
            for (int k = -2; k < 2; ++k) {
                const glm::dvec3 p = 0.5 * (glm::dvec3(i, j, k) + 0.4);
                EXPECT_EQ(board.number(p), (i + j + k) % 2 == 0 ? 1 : 0) << i << j << k;
            }
        }
    }
}

TEST(Textures, ScaleMixAndDirectionMixFollowTheirDefinitions) {
    const std::string s = probe("s", ""), t = "Texture \"t\" \"float\" \"bilerp\" \"float v00\" 0 "
                                              "\"float v10\" 0 \"float v01\" 1 \"float v11\" 1\n";
    const Drawn scale(s + t +
                      "Texture \"x\" \"float\" \"scale\" \"texture tex\" \"probe\" "
                      "\"texture scale\" \"t\"");
    const Drawn mix(s + t +
                    "Texture \"x\" \"float\" \"mix\" \"texture tex1\" \"probe\" "
                    "\"float tex2\" 10 \"texture amount\" \"t\"");
    const Drawn bilerp(
        "Texture \"b\" \"float\" \"bilerp\" \"float v00\" 1 \"float v01\" 2 "
        "\"float v10\" 4 \"float v11\" 8");
    for (const double u : {0.0, 0.2, 1.0}) {
        for (const double v : {0.0, 0.7, 1.0}) {
            EXPECT_NEAR(scale.number(u, v), u * v, 1e-12);
            EXPECT_NEAR(mix.number(u, v), u * (1 - v) + 10 * v, 1e-12);
            EXPECT_NEAR(bilerp.number(u, v),
                        (1 - u) * (1 - v) * 1 + (1 - u) * v * 2 + u * (1 - v) * 4 + u * v * 8,
                        1e-12);
        }
    }
    // The direction turns with the texture; both sides of a surface count alike.
    const Drawn direction(
        "Rotate 90 1 0 0\nTexture \"d\" \"float\" \"directionmix\" "
        "\"float tex1\" 3 \"float tex2\" 7");  // y becomes z
    for (const double angle : {0.0, 0.6, 1.5, 2.5}) {
        const glm::dvec3 n(std::sin(angle), 0, std::cos(angle));
        const double along = std::abs(std::cos(angle));
        EXPECT_NEAR(direction.number({1, 2, 3}, n), 3 * along + 7 * (1 - along), 1e-12);
    }
}

// Packets, and single wavelengths in double, of a texture of textures.
TEST(Textures, PacketsAgreeWithSingleWavelengths) {
    const Drawn drawn(
        probe("s", "") +
        "Texture \"a\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [0.9 0.2 0.1] "
        "\"spectrum tex2\" [400 0.1 600 0.8 700 0.3]\n"
        "Texture \"b\" \"spectrum\" \"bilerp\" \"rgb v00\" [1 0 0] \"rgb v01\" [0 1 0] "
        "\"rgb v10\" [0 0 1] \"rgb v11\" [1 1 1]\n"
        "Texture \"c\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\" "
        "\"texture amount\" \"probe\"\n"
        "Texture \"d\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"float scale\" 1.5");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1, 2);
    int above = 0, below = 0;
    for (int i = 0; i < 200; ++i) {
        const TexturePoint at({0, 0, 0}, {0, 0, 1}, {uniform(random), uniform(random)});
        const int phase = i % Wavelengths<8>::spacing;
        const Packet<8> packet = drawn.packet(at, phase), held = drawn.reflectance(at, phase);
        for (int lane = 0; lane < 8; ++lane) {
            const double exact = drawn.spectrum(at, Wavelengths<8>::nanometres(phase, lane));
            EXPECT_NEAR(packet[lane], exact, 3e-6);
            EXPECT_EQ(held[lane], std::clamp(packet[lane], 0.0f, 1.0f));
            above += exact > 1;
            below += exact < 0;
        }
    }
    EXPECT_GT(above, 20);
    EXPECT_GT(below, 20);
    // One value on paper: at (0.25, 0.5) the square is the first, s is 0.25.
    const TexturePoint at({0, 0, 0}, {0, 0, 1}, {0.25, 0.5});
    const auto& basis = mallett_yuksel_basis();
    const double red = basis[0][170], green = basis[1][170], blue = basis[2][170];
    const double a = 0.9 * red + 0.2 * green + 0.1 * blue;
    const double b = 0.375 * red + 0.375 * green + 0.125 * blue + 0.125 * (red + green + blue);
    EXPECT_NEAR(drawn.spectrum(at, 550), 1.5 * (0.75 * a + 0.25 * b), 1e-12);
}

TEST(Textures, WhatIsTheSameEverywhereIsAConstant) {
    const Scene scene = parse_scene(
        "WorldBegin\nTexture \"a\" \"float\" \"constant\" \"float value\" 3\n"
        "Texture \"b\" \"float\" \"scale\" \"texture tex\" \"a\" \"float scale\" 0.5\n"
        "Texture \"c\" \"float\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\"\n"
        "Texture \"d\" \"float\" \"checkerboard\"\n"
        "Texture \"e\" \"float\" \"mix\" \"texture tex1\" \"c\" \"texture tex2\" \"d\" "
        "\"float amount\" 0",
        "t.pbrt");
    EXPECT_EQ(scene.number_textures.size(), 1u);
    EXPECT_TRUE(scene.spectrum_textures.empty());
}

TEST(Textures, ValuesThatAreNotFiniteAreZero) {
    const Drawn drawn(
        "Texture \"a\" \"float\" \"bilerp\" \"float uscale\" 1e9 "
        "\"float v10\" 1e14 \"float v11\" 1e14\n");
    EXPECT_EQ(drawn.number(1e305, 0.5), 0);
    const Drawn colour(
        "Texture \"a\" \"spectrum\" \"bilerp\" \"float uscale\" 1e9 "
        "\"rgb v10\" [1e14 1e14 1e14] \"rgb v11\" [1 0 0]\n");
    const Packet<8> held = colour.reflectance({{0, 0, 0}, {0, 0, 1}, {1e305, 0.5}}, 3);
    for (int lane = 0; lane < 8; ++lane) EXPECT_TRUE(held[lane] >= 0 && held[lane] <= 1);
}

TEST(Roughness, IsHeldAndRemapped) {
    const Drawn drawn(probe("s", ""));
    const auto at = [](double u) { return TexturePoint({0, 0, 0}, {0, 0, 1}, {u, 0}); };
    const NumberValue textured{0, 0};
    EXPECT_DOUBLE_EQ(drawn.numbers().alpha({textured, true}, at(0.09)), 0.3);
    EXPECT_DOUBLE_EQ(drawn.numbers().alpha({textured, false}, at(0.09)), 0.09);
    EXPECT_EQ(drawn.numbers().alpha({textured, true}, at(-1)), 0);
    EXPECT_EQ(drawn.numbers().alpha({textured, false}, at(1000)), 10);
    EXPECT_DOUBLE_EQ(drawn.numbers().alpha({{0.25, -1}, true}, at(0)), 0.5);
    EXPECT_EQ(drawn.numbers().fraction(textured, at(3)), 1);
    EXPECT_EQ(drawn.numbers().fraction(textured, at(-3)), 0);
}

std::string error_of(const std::string& world) {
    try {
        parse_scene("WorldBegin\n" + world, "t.pbrt");
    } catch (const Error& error) {
        return error.message();
    }
    return "nothing was thrown";
}

TEST(Textures, MistakesHaveTheirPlace) {
    const auto begins = [](const std::string& world, const std::string& expected) {
        const std::string message = error_of(world);
        EXPECT_EQ(message.substr(0, expected.size()), expected);
    };
    begins("Texture \"a\" \"float\" \"checkerboard\" \"string mapping\" \"sperical\"",
           "t.pbrt:2:53: Texture \"a\": mapping is 'sperical' (did you mean 'spherical'?)");
    begins("Texture \"a\" \"float\" \"checkerboard\" \"integer dimension\" 4",
           "t.pbrt:2:56: Texture \"a\": dimension is 4; expected 2 to 3");
    begins("Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\"",
           "t.pbrt:2:43: there is no float texture 'b'");
    begins("Texture \"a\" \"float\" \"directionmix\" \"vector3 dir\" [0 0 0]",
           "t.pbrt:2:36: Texture \"a\": dir has no direction");
    begins("Texture \"a\" \"float\" \"bilerp\" \"texture v00\" \"b\"", "t.pbrt:2:");
}

// Every texture uses the one before twice: 2^60 visits, were it not refused.
TEST(Textures, ExplodingOnesAreRefused) {
    std::string world = "Texture \"t0\" \"float\" \"checkerboard\"\n";
    for (int i = 1; i <= 60; ++i) {
        world += fmt::format(
            "Texture \"t{}\" \"float\" \"mix\" \"texture tex1\" \"t{}\" \"texture tex2\" \"t{}\"\n",
            i, i - 1, i - 1);
    }
    EXPECT_NE(error_of(world).find("t.pbrt:14:1: the texture 't12' is made of"), std::string::npos)
        << error_of(world);
}

}  // namespace
}  // namespace drude
