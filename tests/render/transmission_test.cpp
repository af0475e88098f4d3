// Glass, coats and optical elements whose pictures are known on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/dielectric.h"
#include "render/test_scenes.h"

namespace drude {
namespace {

const std::string grey = "Material \"diffuse\"";

// A sphere of `material` under a sky of luminance 1.
Scene sphere_of(const SurfaceMaterial& material, int size = 24, int depth = 200) {
    Scene scene = sphere_under_sky(grey, size);
    scene.materials.at(1) = material;
    scene.max_depth = depth;
    return scene;
}

DielectricMaterial glass(double eta, double alpha = 0) {
    return {constant_spectrum(eta), alpha};
}

// Every pixel of R, G and B within `tolerance` of `value`, on average within `of_mean`.
void expect_even(const RenderResult& result, double value, double tolerance, double of_mean) {
    for (const char* name : {"R", "G", "B"}) {
        double mean = 0;
        const Channel& channel = result.image.at(name, "test");
        for (const float v : channel.data) {
            ASSERT_NEAR(v, value, tolerance) << name;
            mean += static_cast<double>(v) / static_cast<double>(channel.data.size());
        }
        EXPECT_NEAR(mean, value, of_mean) << name;
    }
    EXPECT_EQ(result.projections, 0u);
    EXPECT_EQ(result.not_finite, 0u);
}

// Clear glass takes nothing and adds nothing: under a constant sky it cannot be seen. Inside, light
// of a thousand reflections is met too.
TEST(Glass, IsNotSeenUnderAConstantSky) {
    for (const Transport transport : {Transport::scalar, Transport::intensity, Transport::stokes}) {
        RenderOptions options;
        options.samples_per_pixel = 256;
        options.transport = transport;
        options.quiet = true;
        expect_even(render(sphere_of(glass(1.5)), options), 1, 0.2, 6e-3);
    }
    ThinDielectricMaterial plate{constant_spectrum(1.5)};
    expect_even(render_quietly(sphere_of(plate), 256), 1, 0.3, 6e-3);
}

TEST(Glass, OfIndexOneIsNotThere) {
    expect_even(render_quietly(sphere_of(glass(1)), 64), 1, 1e-2, 1e-3);
}

TEST(Glass, ThatSeparatesColoursIsNotSeenEither) {
    DielectricMaterial flint;
    for (int i = 0; i < spectrum_size; ++i) flint.eta[i] = 1.7 + 0.0005 * (200 - i);
    const RenderResult result = render_quietly(sphere_of(flint), 1024);
    double mean = 0;
    const Channel& g = result.image.at("G", "test");
    for (const float v : g.data)
        mean += static_cast<double>(v) / static_cast<double>(g.data.size());
    // One lane in eight is left of a path.
    EXPECT_NEAR(mean, 1, 0.01);
}

// What a rough interface loses is single scattering's; it must never gain.
TEST(Glass, RoughGlassNeverGains) {
    for (const double alpha : {0.05, 0.3, 0.8}) {
        const RenderResult result = render_quietly(sphere_of(glass(1.5, alpha)), 256);
        double mean = 0;
        const Channel& g = result.image.at("G", "test");
        for (const float v : g.data) {
            mean += static_cast<double>(v) / static_cast<double>(g.data.size());
        }
        EXPECT_LT(mean, 1.005) << alpha;
        EXPECT_GT(mean, alpha < 0.1 ? 0.97 : 0.6) << alpha;
    }
}

TEST(Diffuser, ThatReflectsAndTransmitsAllIsNotSeen) {
    DiffuseTransmissionMaterial paper;
    paper.reflectance.constant = constant_spectrum(0.3);
    paper.transmittance.constant = constant_spectrum(0.7);
    expect_even(render_quietly(sphere_of(paper), 256), 1, 0.5, 0.01);
}

// The share of diffuse light within a medium of index eta that its surface throws back.
double internal_reflectance(double eta) {
    const int steps = 20000;
    double total = 0;
    for (int i = 0; i < steps; ++i) {
        const double c2 = (i + 0.5) / steps;  // cos^2: its density is even in diffuse light
        total += interface_reflectance(1 / eta, std::sqrt(c2)) / steps;
    }
    return total;
}

// Under a sky of radiance 1: what the surface reflects, and what comes out of the base, to which
// light goes back and forth (a geometric series, since the base forgets where it came from).
TEST(Coat, OverADiffuseBaseHasTheClosedForm) {
    const double eta = 1.5;
    for (const double rho : {1.0, 0.5}) {
        CoatedMaterial coat;
        coat.eta = constant_spectrum(eta);
        coat.base = DiffuseMaterial{{constant_spectrum(rho)}};
        // A quad that fills the picture, seen at right angles: the same cosine at every pixel.
        Scene scene = parse_scene(
            "LookAt 0 0 -400  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 0.1\n"
            "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
            "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 8\nWorldBegin\n"
            "LightSource \"infinite\" \"rgb L\" [1 1 1]\nMaterial \"diffuse\"\n"
            "Rotate 60 0 1 0\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
            "\"point3 P\" [-9 -9 0  -9 9 0  9 9 0  9 -9 0]\n",
            "coat.pbrt");
        scene.materials.at(1) = coat;
        const double F = interface_reflectance(eta, 0.5), inside = internal_reflectance(eta);
        const double base = rho * (1 - inside) / (1 - rho * inside);
        const double expected = F + (1 - F) * base;
        expect_even(render_quietly(scene, 1024), expected, 0.1, 3e-3);

        // A rough surface that is almost smooth takes the other way through the program.
        coat.alpha = 0.002;
        scene.materials.at(1) = coat;
        expect_even(render_quietly(scene, 1024), expected, 0.1, 4e-3);
        if (rho < 1) continue;
        // A thousand reflections under a tight lid end at the same.
        coat.alpha = 0;
        coat.eta = constant_spectrum(3.0);
        scene.materials.at(1) = coat;
        expect_even(render_quietly(scene, 1024), 1, 0.3, 8e-3);
    }
}

// A mirror of reflectance 1 under a coat: all comes back.
TEST(Coat, OverAPerfectMirrorReflectsAll) {
    CoatedMaterial coat;
    coat.eta = constant_spectrum(1.5);
    ConductorMaterial mirror;
    mirror.reflectance = SpectrumValue{constant_spectrum(1)};
    mirror.alpha = 0;
    coat.base = mirror;
    expect_even(render_quietly(sphere_of(coat), 64), 1, 0.3, 0.01);
}

// Absorption on the way: one passage down and one up at right angles, and so on.
TEST(Coat, AbsorbsByItsThickness) {
    CoatedMaterial coat;
    coat.eta = constant_spectrum(1.000001);
    coat.thickness = 0.5;
    ConductorMaterial mirror;
    mirror.reflectance = SpectrumValue{constant_spectrum(1)};
    mirror.alpha = 0;
    coat.base = mirror;
    const RenderResult result = render_quietly(sphere_of(coat, 25), 64);
    EXPECT_NEAR(result.image.at("G", "test").data[12 * 25 + 12], std::exp(-1.0), 2e-3);
}

// ---- optical elements

constexpr const char* wall_of_light =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nTranslate 0 0 2\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2]\n"
    "\"point3 P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]\nAttributeEnd\n";

// Elements before a wall of light, from the camera on: quads at right angles to the view.
Scene elements_before_light(const std::vector<OpticalElementMaterial>& elements,
                            const std::string& before = "") {
    std::string text = before +
                       "LookAt 0 0 -10  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
                       "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
                       "PixelFilter \"box\"\nWorldBegin\n";
    text += wall_of_light;
    for (size_t i = 0; i < elements.size(); ++i) {
        text += fmt::format(
            "MakeNamedMaterial \"e{}\" \"string type\" \"diffuse\"\nNamedMaterial \"e{}\"\n"
            "AttributeBegin\nTranslate 0 0 {}\nShape \"trianglemesh\" \"integer indices\" "
            "[0 2 1 0 3 2]\n\"point3 P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]\nAttributeEnd\n",
            i, i, -8.0 + static_cast<double>(i));
    }
    Scene scene = parse_scene(text, "elements.pbrt");
    size_t next = 0;
    for (Shape& shape : scene.shapes) {
        if (shape.area_light >= 0) continue;
        scene.materials.at(shape.material) = elements.at(next++);
    }
    return scene;
}

OpticalElementMaterial polariser(double axis) {
    OpticalElementMaterial e;
    e.axis_deg = axis;
    return e;
}

// Mean S0..S3 in the Y of linear RGB.
std::array<double, 4> stokes_of(const Scene& scene, int samples = 32) {
    const RenderResult result = render_quietly(scene, samples, true);
    std::array<double, 4> s{};
    for (int i = 0; i < 4; ++i) {
        const Channel& g = result.image.at(fmt::format("S{}.G", i), "test");
        for (const float v : g.data)
            s[i] += static_cast<double>(v) / static_cast<double>(g.data.size());
    }
    EXPECT_EQ(result.projections, 0u);
    return s;
}

TEST(OpticalElements, MalusLaw) {
    for (const double angle : {0.0, 30.0, 60.0, 90.0}) {
        const auto s = stokes_of(elements_before_light({polariser(0), polariser(angle)}));
        const double c = std::cos(angle * degree);
        EXPECT_NEAR(s[0], 0.5 * c * c, 2e-4) << angle;
        EXPECT_NEAR(s[1], s[0], 2e-4) << "the one before the camera decides";
        EXPECT_NEAR(s[2], 0, 2e-4);
    }
    const auto crossed =
        stokes_of(elements_before_light({polariser(0), polariser(45), polariser(90)}));
    EXPECT_NEAR(crossed[0], 0.125, 2e-4);
}

// Angles are counter-clockwise in the picture, in either world; seen from its front. The quads
// face the camera in an ordinary scene.
TEST(OpticalElements, AnglesAreThoseOfThePicture) {
    for (const std::string before : {"", "Scale -1 1 1\n"}) {
        Scene scene = elements_before_light({polariser(30)}, before);
        const auto s = stokes_of(scene);
        EXPECT_NEAR(s[0], 0.5, 2e-4);
        // In the mirrored world the object's x axis points to the left of the picture, and the
        // angle still grows counter-clockwise from it.
        EXPECT_NEAR(s[1], 0.5 * std::cos(60 * degree), 2e-4);
        EXPECT_NEAR(s[2], 0.5 * std::sin(60 * degree), 2e-4);
    }
}

// Horizontal light behind a quarter-wave plate at +45 degrees has S3 > 0 (optical_elements.h).
TEST(OpticalElements, MakeCircularLight) {
    OpticalElementMaterial plate = polariser(45);
    plate.kind = OpticalElementMaterial::Kind::retarder;
    plate.retardance_deg = 90;
    const auto s = stokes_of(elements_before_light({plate, polariser(0)}));
    EXPECT_NEAR(s[0], 0.5, 2e-4);
    EXPECT_NEAR(s[3], 0.5, 2e-4);
    OpticalElementMaterial right = polariser(0);
    right.kind = OpticalElementMaterial::Kind::circular_polariser;
    for (const bool right_handed : {true, false}) {
        right.right_handed = right_handed;
        const auto through = stokes_of(elements_before_light({right, plate, polariser(0)}));
        EXPECT_NEAR(through[0], right_handed ? 0.5 : 0.0, 2e-4);
    }
}

// A floor under a sun and a wall of light, with a polariser over it: what comes by light sampling
// comes through the element, and a second one at right angles leaves nothing.
TEST(OpticalElements, LightSamplingSeesThroughThem) {
    const auto floor = [](const std::string& light, const std::vector<double>& angles) {
        std::string text =
            "LookAt 0 -4 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 4\n"
            "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
            "PixelFilter \"box\"\nWorldBegin\n" +
            light +
            "Material \"diffuse\" \"rgb reflectance\" [1 1 1]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
            "\"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0]\n";
        for (size_t i = 0; i < angles.size(); ++i) {
            text += fmt::format(
                "AttributeBegin\nMakeNamedMaterial \"e{}\" \"string type\" \"diffuse\"\n"
                "NamedMaterial \"e{}\"\nTranslate 0 0 {}\n"
                "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
                "\"point3 P\" [-50 -50 0  50 -50 0  50 50 0  -50 50 0]\nAttributeEnd\n",
                i, i, 1.5 + 0.1 * static_cast<double>(i));
        }
        Scene scene = parse_scene(text, "floor.pbrt");
        for (size_t i = 1; i < scene.shapes.size(); ++i) {
            if (scene.shapes[i].area_light >= 0) continue;
            scene.materials.at(scene.shapes[i].material) =
                polariser(angles.at(i - (scene.shapes.size() - angles.size())));
        }
        return stokes_of(scene, 256)[0];
    };
    for (const std::string light : {"LightSource \"distant\" \"rgb L\" [3 3 3] \"point3 from\" [0 "
                                    "0 1] \"point3 to\" [0 0 0]\n",
                                    "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"}) {
        const double bare = floor(light, {});
        EXPECT_GT(bare, 0.1);
        EXPECT_NEAR(floor(light, {20}), bare / 2, bare * 0.01);
        // Right angles to each other for light from straight above alone.
        if (light.find("distant") != std::string::npos) {
            EXPECT_NEAR(floor(light, {20, 110}), 0, 2e-4);
            EXPECT_NEAR(floor(light, {20, 65}), bare / 4, bare * 1e-4);
        }
    }
}

}  // namespace
}  // namespace drude
