// "auto" takes the cheapest transport only where it is exact.
#include "render/transport_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/test_scenes.h"

namespace drude {
namespace {

constexpr const char* floor_quad =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "\"point3 P\" [-3 -3 -1.2  3 -3 -1.2  3 3 -1.2  -3 3 -1.2]\n";
const std::string copper = "Material \"conductor\" \"string material\" \"Cu\"\n";
const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";

Scene scene_of(const std::string& world, const std::string& settings = "",
               const std::string& look_at = "LookAt 0 -5 1  0 0 0  0 0 1") {
    return parse_scene(look_at + "\nCamera \"perspective\" \"float fov\" 40\n" + settings +
                           "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
                           "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 6\n"
                           "WorldBegin\n" +
                           world,
                       "choice.pbrt");
}

// The largest relative difference of a pixel's G between two transports at the same samples.
double difference(const Scene& scene, Transport a, Transport b) {
    const auto picture = [&](Transport transport) {
        RenderOptions options;
        options.samples_per_pixel = 256;
        options.transport = transport;
        options.quiet = true;
        return render(scene, options).image.at("G", "test").data;
    };
    const std::vector<float> one = picture(a), other = picture(b);
    double worst = 0;
    for (size_t i = 0; i < one.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(one[i] - other[i]) /
                                                    std::max(1e-3f, std::abs(other[i]))));
    }
    return worst;
}

void expect_cheap_and_exact(const Scene& scene) {
    const TransportChoice choice = cheapest_exact_transport(scene, scene.max_depth);
    EXPECT_EQ(choice.transport, Transport::scalar) << choice.reason;
    EXPECT_FALSE(choice.reason.empty());
    // The same random numbers: all that differs is rounding.
    EXPECT_LT(difference(scene, Transport::scalar, Transport::intensity), 1e-4);
}

void expect_rich_where_needed(const Scene& scene) {
    const TransportChoice choice = cheapest_exact_transport(scene, scene.max_depth);
    EXPECT_EQ(choice.transport, Transport::intensity) << choice.reason;
    EXPECT_GT(difference(scene, Transport::scalar, Transport::intensity), 2e-3)
        << "scalar would have done";
}

TEST(TransportChoice, IsScalarForOneConvexMetal) {
    expect_cheap_and_exact(scene_of(sky + copper + "Shape \"sphere\""));
    // Depolarisers around it change nothing.
    expect_cheap_and_exact(
        scene_of(sky + "Material \"diffuse\"\n" + floor_quad + copper + "Shape \"sphere\""));
    expect_cheap_and_exact(scene_of(sky + copper + floor_quad));
    expect_cheap_and_exact(scene_of(sky + copper + "Shape \"disk\" \"float radius\" 1"));
    // A closed box, corners shared or not.
    expect_cheap_and_exact(scene_of(
        sky + copper +
        "Shape \"trianglemesh\" \"point3 P\" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  "
        "1 1 1  -1 1 1] \"integer indices\" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  "
        "2 3 7 2 7 6  3 0 4 3 4 7]"));
}

TEST(TransportChoice, IsScalarWithoutMetal) {
    expect_cheap_and_exact(scene_of(sky + "Material \"diffuse\"\nShape \"sphere\""));
    expect_cheap_and_exact(scene_of(sky + "Material \"coateddiffuse\"\nShape \"sphere\""));
}

TEST(TransportChoice, IsRichBetweenTwoMetals) {
    expect_rich_where_needed(
        scene_of(sky + copper + floor_quad + "Shape \"sphere\" \"float radius\" 1.1"));
}

// The open half-sphere: from above its rim the inside does not show, from below it does.
TEST(TransportChoice, LooksIntoTheOpenHalfSphere) {
    const std::string dome = sky + copper + "Shape \"sphere\" \"float zmin\" 0";
    expect_cheap_and_exact(scene_of(dome));
    expect_rich_where_needed(scene_of(dome, "", "LookAt 0 -2 -3  0 0 0.4  0 0 1"));
    // A floor of plaster may send paths up into it.
    const Scene on_floor = scene_of(
        dome + "\nMaterial \"diffuse\"\nTranslate 0 0 -1\nShape \"disk\" \"float radius\" 9");
    EXPECT_EQ(cheapest_exact_transport(on_floor, 6).transport, Transport::intensity);
    // Nor may its camera stand anywhere but at one point.
    EXPECT_EQ(cheapest_exact_transport(
                  scene_of(dome, "Camera \"perspective\" \"float lensradius\" 0.1\n"), 6)
                  .transport,
              Transport::intensity);
}

TEST(TransportChoice, RefusesOpenAndConcaveMeshes) {
    // The box without its lid.
    expect_rich_where_needed(scene_of(
        sky + copper +
            "Shape \"trianglemesh\" \"point3 P\" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 "
            "-1 "
            "1  1 1 1  -1 1 1] \"integer indices\" [0 2 1 0 3 2  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 "
            "7 6  3 0 4 3 4 7]",
        "", "LookAt 0 -3 4  0 0 0  0 0 1"));
    // Two walls at right angles.
    expect_rich_where_needed(
        scene_of(sky + copper +
                 "Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0  1 1 2  -1 1 "
                 "2] \"integer indices\" [0 1 2 0 2 3  3 2 4 3 4 5]"));
}

TEST(TransportChoice, IsRichForPolarisedLight) {
    expect_rich_where_needed(
        scene_of("LightSource \"infinite\" \"rgb L\" [1 1 1] \"float dop\" 1 \"float aolp\" 30\n" +
                 copper + "Shape \"sphere\""));
    expect_rich_where_needed(scene_of(sky + copper + "Shape \"sphere\"",
                                      "Camera \"perspective\" \"float analyser\" 45\n"));
    expect_rich_where_needed(scene_of(sky + "Material \"dielectric\"\nShape \"sphere\""));
}

// Crossed polarisers before a light: scalar sees a quarter of it, intensity nothing.
TEST(TransportChoice, IsRichForCrossedPolarisers) {
    const Scene scene = scene_of(
        sky +
        "Material \"linearpolariser\" \"float axis\" 0\nAttributeBegin\nTranslate 0 -3 0.6\n"
        "Rotate 90 1 0 0\nShape \"disk\" \"float radius\" 9\nAttributeEnd\n"
        "Material \"linearpolariser\" \"float axis\" 90\nAttributeBegin\nTranslate 0 -2 0.4\n"
        "Rotate 90 1 0 0\nShape \"disk\" \"float radius\" 9\nAttributeEnd\n");
    EXPECT_EQ(cheapest_exact_transport(scene, 6).transport, Transport::intensity);
    const auto mean = [&](Transport transport) {
        RenderOptions options;
        options.samples_per_pixel = 64;
        options.transport = transport;
        options.quiet = true;
        double sum = 0;
        const RenderResult result = render(scene, options);
        const std::vector<float>& g = result.image.at("G", "test").data;
        for (const float v : g) sum += static_cast<double>(v) / static_cast<double>(g.size());
        return sum;
    };
    EXPECT_NEAR(mean(Transport::scalar), 0.25, 1e-3);
    // Rays that are not at right angles to both leave a little.
    EXPECT_LT(mean(Transport::intensity), 0.01);
}

}  // namespace
}  // namespace drude
