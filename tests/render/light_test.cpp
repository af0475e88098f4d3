// Lights with closed forms on a diffuse floor, and shadows close to a far light.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/scalar.h"
#include "render/geometry.h"
#include "render/lights.h"
#include "render/reference_light.h"
#include "render/sampler.h"
#include "temporary_folder.h"
#include "test_scenes.h"

namespace drude {
namespace {

// The radiance (G) of a floor of reflectance 1/2 at the origin, facing +z, and its standard error.
struct Measured {
    double value, error;
};
Measured floor_radiance(const std::string& lights, int samples) {
    const Scene scene = parse_scene(
        "LookAt 3 0 0.6  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 0.01\n"
        "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
        "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 1\nWorldBegin\n"
        "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point3 P\" [-3 -3 0  4 -3 0  4 3 0  -3 3 0]\n" +
            lights,
        "floor.pbrt");
    const RenderResult result = render_quietly(scene, samples);
    const double variance = result.image.find("variance.G")->data[0];
    return {result.image.find("G")->data[0], std::sqrt(variance)};
}

void expect_measured(const Measured& measured, double expected) {
    EXPECT_NEAR(measured.value, expected, 4 * measured.error + 1e-5 * expected);
    EXPECT_LT(measured.error, 0.005 * expected);
}

// From a point to a parallel rectangle whose corner is above it (Siegel & Howell, Thermal
// Radiation Heat Transfer, appendix C, configuration 2).
double corner_form_factor(double x, double y) {
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * pi);
}

TEST(Lights, ASquareHasItsFormFactor) {
    const double half = 0.8, height = 1.1;
    const std::string light =
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nShape \"trianglemesh\" "
        "\"integer indices\" [0 2 1 0 3 2] \"point3 P\" "
        "[-0.8 -0.8 1.1  0.8 -0.8 1.1  0.8 0.8 1.1  -0.8 0.8 1.1]\n";
    expect_measured(floor_radiance(light, 4096),
                    0.5 * 4 * corner_form_factor(half / height, half / height));
}

TEST(Lights, ADiskAndASphereHaveTheirFormFactors) {
    const std::string disk =
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nTranslate 0 0 1.5\nReverseOrientation\n"
        "Shape \"disk\" \"float radius\" 0.7\n";
    expect_measured(floor_radiance(disk, 4096), 0.5 * 0.49 / (0.49 + 2.25));
    // A sphere overhead: the square of its radius over its distance.
    const std::string sphere =
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nTranslate 0 0 1.5\n"
        "Shape \"sphere\" \"float radius\" 0.7\n";
    expect_measured(floor_radiance(sphere, 4096), 0.5 * 0.49 / 2.25);
}

TEST(Lights, ADistantLightFallsWithTheCosine) {
    for (const double angle : {0.0, 30.0, 75.0}) {
        const double t = angle * pi / 180;
        const Measured measured = floor_radiance(
            fmt::format("LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [0 {} {}] "
                        "\"point3 to\" [0 0 0]\n",
                        std::sin(t), std::cos(t)) +
                "LightSource \"distant\" \"point3 from\" [0 0 -1] "
                "\"point3 to\" [0 0 0]\n",  // from below: nothing
            8192);
        expect_measured(measured, 0.5 * 2 * std::cos(t) / pi);
    }
}

TEST(Lights, APointLightFallsWithTheSquareAndTheCosine) {
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 2), glm::dvec3(0.5, -1, 0.7)}) {
        const double d2 = glm::dot(at, at);
        const std::string from = fmt::format("\"point3 from\" [{} {} {}]", at.x, at.y, at.z);
        const double expected = 0.5 * at.z / (d2 * std::sqrt(d2)) / pi;
        expect_measured(floor_radiance("LightSource \"point\" \"rgb I\" [3 3 3] " + from, 4096),
                        3 * expected);
        expect_measured(floor_radiance("LightSource \"point\" \"float power\" 50 " + from, 4096),
                        50 / (4 * pi) * expected);
        // Below the floor, and behind a disk.
        EXPECT_EQ(floor_radiance("Scale 1 1 -1 LightSource \"point\" " + from, 64).value, 0);
        EXPECT_EQ(floor_radiance("LightSource \"point\" " + from +
                                     fmt::format(" Translate {} {} {} Shape \"disk\" "
                                                 "\"float radius\" 0.01",
                                                 at.x / 2, at.y / 2, at.z / 2),
                                 64)
                      .value,
                  0);
    }
}

// The floor's point is at an angle from the spot's axis that runs from inside the falloff to
// outside; and all of its light together is its power.
TEST(Lights, ASpotFallsOffByASmoothStepOfTheCosine) {
    const double end = 40, start = 25;
    for (const double angle : {0.0, 20.0, 28.0, 33.0, 39.0, 41.0, 120.0}) {
        const double low = std::cos(end * degree), high = std::cos(start * degree);
        const double t = std::clamp((std::cos(angle * degree) - low) / (high - low), 0.0, 1.0);
        const double falloff = t * t * (3 - 2 * t);
        const Measured measured = floor_radiance(
            fmt::format("LightSource \"spot\" \"rgb I\" [2 2 2] \"point3 from\" [0 0 2] "
                        "\"point3 to\" [0 {} {}] \"float coneangle\" {} "
                        "\"float conedeltaangle\" {}\n",
                        std::sin(angle * degree), 2 - std::cos(angle * degree), end, end - start),
            4096);
        if (falloff > 0) {
            expect_measured(measured, 0.5 * 2 * falloff / 4 / pi);
        } else {
            EXPECT_EQ(measured.value, 0);
        }
    }
    const Scene scene = parse_scene(
        "WorldBegin Rotate 30 1 1 0 LightSource \"spot\" \"float power\" 70 \"float coneangle\" 50 "
        "\"float conedeltaangle\" 20 \"point3 from\" [1 2 3] \"point3 to\" [2 2 -3]",
        "spot.pbrt");
    const PointLight& spot = scene.point_lights.at(0);
    double sum = 0;
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 400; ++j) {
            const double z = (i + 0.5) / 200 - 1, phi = (j + 0.5) / 200 * pi;
            const double r = std::sqrt(1 - z * z);
            sum += intensity_towards(
                       spot, spot.position + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z),
                       550) *
                   4 * pi / 160000;
        }
    }
    EXPECT_NEAR(sum / spectrum_at(spot.intensity, 550) * spectrum_to_xyz(spot.intensity)[1], 70,
                0.05);
}

// A picture's illuminance is what an upward patch under it receives.
TEST(Lights, APictureIsScaledToItsIlluminance) {
    for (const int width : {16, 8}) {
        TemporaryFolder folder;
        Image image;
        image.width = width;
        image.height = 8;
        for (const char* name : {"R", "G", "B"}) {
            Channel& channel = image.add(name);
            for (size_t i = 0; i < channel.data.size(); ++i) {
                channel.data[i] = static_cast<float>(i % 7 + (*name == 'G' ? 1 : 0));
            }
        }
        write_exr(folder.file("sky.exr"), image, Compression::none);
        const Scene scene = parse_scene(
            "LookAt 3 0 0.6  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 0.01\n"
            "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
            "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 1\nWorldBegin\n"
            "LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float illuminance\" 5\n"
            "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\nShape \"disk\"\n",
            folder.file("sky.pbrt"));
        const RenderResult result = render_quietly(scene, 16384);
        const double y =
            rgb_to_xyz({result.image.find("R")->data[0], result.image.find("G")->data[0],
                        result.image.find("B")->data[0]})[1];
        EXPECT_NEAR(y, 0.5 * 5 / pi, 0.005) << width;
    }
}

// Two distant lights, of which power says almost nothing of the weaker, and of the brighter there
// is a thing before it: what is not lost is the weaker.
TEST(Lights, NoDistantLightIsTooWeakToBePicked) {
    const std::string lights =
        "LightSource \"distant\" \"rgb L\" [1e12 1e12 1e12] \"point3 from\" [0 0 -1] "
        "\"point3 to\" [0 0 0]\n"
        "LightSource \"distant\" \"rgb L\" [1 1 1] \"point3 from\" [0 0 1] "
        "\"point3 to\" [0 0 0]\n";
    const Measured measured = floor_radiance(lights, 65536);
    EXPECT_NEAR(measured.value, 0.5 / pi, 0.02);
}

TEST(Lights, AShadeCloseToAFarLampHidesIt) {
    const auto panel = [](double half, double z) {
        return fmt::format(
            "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2] \"point3 P\" "
            "[-{0} -{0} {1}  {0} -{0} {1}  {0} {0} {1}  -{0} {0} {1}]\n",
            half, z);
    };
    const std::string lamp =
        "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1e6 1e6 1e6]\n" + panel(0.5, 1000) +
        "AttributeEnd\n";
    EXPECT_GT(floor_radiance(lamp, 64).value, 0.01);
    EXPECT_EQ(floor_radiance(lamp + panel(1, 999.97), 64).value, 0);
}

// The density that a lobe sample is told for a point of a light is the one of sampling that point.
TEST(Lights, DensityIsThatOfTheSample) {
    const Scene scene = parse_scene(
        "WorldBegin\nMaterial \"diffuse\"\nLightSource \"infinite\"\n"
        "AreaLightSource \"diffuse\" \"bool twosided\" true\nRotate 40 1 2 3\nScale -2 0.5 0.2\n"
        "Shape \"sphere\" \"float zmin\" -0.5 \"float phimax\" 200\nTranslate 0 8 0\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point3 P\" [-1 -1 1  1 -1 1  1 2 1  -1 1 1]\n",
        "lights.pbrt");
    const Geometry geometry(scene);
    const Lights lights(scene, geometry);
    int compared = 0;
    for (int i = 0; i < 4096; ++i) {
        Sampler sampler(7, 0, 0, static_cast<uint32_t>(i / 256), static_cast<uint32_t>(i % 256),
                        largest_batch);
        const glm::vec3 at(0.3f, -9.0f, 1.0f);
        const float choice = sampler.next_1d();
        const Lights::Sample s = lights.sample(at, choice, sampler.next_2d());
        Hit hit;
        if (s.kind != Lights::Kind::area || !(s.pdf > 0)) continue;
        if (!geometry.intersect(at, s.d, &hit)) continue;
        if (std::abs(glm::length(hit.p - at) - s.distance) > 1e-4f) continue;  // hidden
        ++compared;
        EXPECT_NEAR(lights.area_pdf(hit, s.d, s.distance) / s.pdf, 1, 0.01);
    }
    EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace drude
