// The three transports against the reference integrator: S0..S3 in spectral bins, within noise.
#include "render/reference.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/files.h"
#include "reference_comparison.h"
#include "render/transport_choice.h"
#include "test_scenes.h"

namespace drude {
namespace {

using Directions = ReferenceOptions::Directions;

Scene small_scene(const std::string& name, int width, int height, int max_depth,
                  const std::string& before = "") {
    const std::string path = std::string(DRUDE_SOURCE_DIR) + "/scenes/" + name;
    Scene scene = parse_scene(before + "\n" + read_file(path), path);
    scene.film.width = width;
    scene.film.height = height;
    scene.max_depth = max_depth;
    return scene;
}

// What a mirror makes of a picture: columns swapped (blocks of them), S2 and S3 of the other sign.
BlockMeans mirrored(const BlockMeans& means, int across, int down) {
    BlockMeans result = means;
    for (int y = 0; y < down; ++y) {
        for (int x = 0; x < across; ++x) {
            for (size_t b = 0; b < compared_bin_count; ++b) {
                const size_t to = static_cast<size_t>(y * across + x) * compared_bin_count + b;
                const size_t from =
                    static_cast<size_t>(y * across + across - 1 - x) * compared_bin_count + b;
                result.mean[to] = means.mean[from];
                result.variance[to] = means.variance[from];
            }
        }
    }
    for (auto& mean : result.mean) {
        mean[2] = -mean[2];
        mean[3] = -mean[3];
    }
    return result;
}

TEST(Reference, AgreesOnTwoMetalsThatSeeEachOther) {
    const Scene scene = small_scene("two-metals.pbrt", 32, 20, 4);
    // Between the spheres the sun is seen over two narrow lobes: rare, bright, and so in need of
    // many samples before its noise is that of a normal distribution.
    const BlockMeans reference = reference_blocks(scene, 2048, 4, Directions::lobe, 5);
    const BlockMeans stokes = rendered_blocks(scene, Transport::stokes, 256, 4, 12);
    expect_agreement(stokes, reference, 4);
    expect_agreement(rendered_blocks(scene, Transport::intensity, 256, 4, 12), reference, 1);
    // Reflected twice, unpolarised light is circularly polarised, too: S3 is there to be compared.
    double largest = 0;
    for (size_t k = 0; k < stokes.mean.size(); ++k) {
        largest = std::max(largest, std::abs(stokes.mean[k][3]) / std::sqrt(stokes.variance[k][3]));
    }
    EXPECT_GT(largest, 10);

    // The same scene through a mirrored world is the mirrored scene.
    const Scene other = small_scene("two-metals.pbrt", 32, 20, 4, "Scale -1 1 1");
    const BlockMeans turned = rendered_blocks(other, Transport::stokes, 256, 4, 12);
    expect_agreement(turned, mirrored(reference, 8, 5), 4);
    EXPECT_LT(agreement(turned, reference, 4).p, 1e-6);
}

TEST(Reference, AgreesInABoxOfMetals) {
    const Scene scene = small_scene("cornell-metals.pbrt", 16, 16, 5);
    const BlockMeans reference = reference_blocks(scene, 1024, 4, Directions::lobe, 2);
    expect_agreement(rendered_blocks(scene, Transport::stokes, 64, 4, 12), reference, 4);
    expect_agreement(rendered_blocks(scene, Transport::intensity, 64, 4, 12), reference, 1);
}

// Every scene of the repository, a few pixels of it: the meshes are tried triangle by triangle.
class EveryScene : public testing::TestWithParam<const char*> {};
TEST_P(EveryScene, AgreesWithTheReference) {
    const Scene scene = small_scene(GetParam(), 6, 6, 4);
    const BlockMeans reference = reference_blocks(scene, 512, 3, Directions::lobe, 3);
    const Agreement stokes =
        agreement(rendered_blocks(scene, Transport::stokes, 64, 3, 12), reference, 4, 1e-4);
    EXPECT_GT(stokes.p, 1e-4) << stokes.tests << " tests; " << stokes.worst;
    const TransportChoice cheapest = cheapest_exact_transport(scene, scene.max_depth);
    const Agreement automatic =
        agreement(rendered_blocks(scene, cheapest.transport, 64, 3, 12), reference, 1, 1e-4);
    EXPECT_GT(automatic.p, 1e-4) << automatic.tests << " tests; " << automatic.worst;
}
INSTANTIATE_TEST_SUITE_P(Reference, EveryScene,
                         testing::Values("cornell-metals.pbrt", "crossed-polarisers.pbrt",
                                         "furnace.pbrt", "gold-teapot.pbrt", "half-sphere.pbrt",
                                         "material-orb.pbrt", "two-metals.pbrt"),
                         [](const auto& name) {
                             std::string text = name.param;
                             std::replace(text.begin(), text.end(), '-', '_');
                             return text.substr(0, text.size() - 5);
                         });

// Two polarising surfaces in a row are beyond the scalar transport, and the comparison is fine
// enough to show it: of two glass plates near Brewster's angle it misses half the light.
TEST(Reference, TellsTheScalarTransportFromTheOthers) {
    const Scene scene = parse_scene(
        "LookAt 0 -1.5 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 8\n"
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 3\nWorldBegin\n"
        "LightSource \"infinite\"\nMaterial \"conductor\" \"spectrum eta\" [300 1.5 900 1.5] "
        "\"spectrum k\" [300 0 900 0]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point3 P\" [-1 -0.7 0  1 -0.7 0  1 0.7 0  -1 0.7 0]\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point3 P\" [-1 0.8 1  1 0.8 1  1 2.2 1  -1 2.2 1]\n",
        "glass.pbrt");
    const BlockMeans reference = reference_blocks(scene, 512, 4, Directions::lobe, 5);
    expect_agreement(rendered_blocks(scene, Transport::intensity, 64, 4, 12), reference, 1);
    const BlockMeans scalar = rendered_blocks(scene, Transport::scalar, 64, 4, 12);
    EXPECT_LT(agreement(scalar, reference, 1).p, 1e-6);
    EXPECT_NEAR(scalar.mean[0][0] / reference.mean[0][0], 0.5, 0.02);
}

// A picture of `width` x `height` texels: a gradient of colours and one bright texel.
std::shared_ptr<const Image> sky_picture(int width, int height) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    for (const char* name : {"R", "G", "B"}) {
        Channel& channel = image->add(name);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float u = static_cast<float>(x) / static_cast<float>(width);
                const float v = static_cast<float>(y) / static_cast<float>(height);
                const float value = *name == 'R' ? u : *name == 'G' ? v : 1 - u * v;
                channel.data[static_cast<size_t>(y) * width + x] = 0.1f + value * value;
            }
        }
        channel.data[static_cast<size_t>(height / 4) * width + width / 3] = 12;
    }
    return image;
}

TEST(Reference, AgreesOnARoughMetalUnderAPicture) {
    for (const bool square : {false, true}) {
        SCOPED_TRACE(square ? "equal-area" : "lat-long");
        Scene scene = sphere_under_sky(
            "Material \"conductor\" \"string material\" \"Au\" \"string lobe\" \"beckmann\" "
            "\"float beta\" 0.3",
            16);
        scene.infinite_lights[0].picture = square ? sky_picture(16, 16) : sky_picture(24, 12);
        scene.infinite_lights[0].image = "made here";
        // Turned about two axes, and mirrored.
        scene.infinite_lights[0].world_from_light =
            glm::dmat4({0.6, 0.8, 0, 0}, {0, 0, -1, 0}, {0.8, -0.6, 0, 0}, {0, 0, 0, 1});
        // The directions know nothing of the lobe: its sampling is under test as well.
        const BlockMeans reference = reference_blocks(scene, 1024, 4, Directions::hemisphere, 3);
        for (const Transport t : {Transport::scalar, Transport::intensity, Transport::stokes}) {
            SCOPED_TRACE(transport_name(t));
            expect_agreement(rendered_blocks(scene, t, 32, 4, 8), reference,
                             t == Transport::stokes ? 4 : 1);
        }
    }
}

// A floor, a rough metal sphere, and one light of every kind of shape and transformation.
const char* zoo =
    "LookAt 0 -4 2.2  0 0 0.5  0 0 1\n"
    "Camera \"perspective\" \"float fov\" 50\n"
    "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 3\nWorldBegin\n"
    "LightSource \"distant\" \"rgb L\" [0.3 0.3 0.3] \"point3 from\" [1 -2 3]\n"
    "LightSource \"point\" \"rgb I\" [0.5 0.5 1] \"point3 from\" [-2 -1.5 2]\n"
    "LightSource \"spot\" \"rgb I\" [4 2 2] \"point3 from\" [2 2 3] \"point3 to\" [0 0 0]\n"
    "Material \"diffuse\" \"rgb reflectance\" [0.3 0.5 0.7]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point3 P\" [-3 -3 0  3 -3 0  3 3 0  -3 3 0]\n"
    "AttributeBegin\nMaterial \"conductor\" \"string material\" \"Cu\" \"string lobe\" "
    "\"gaussian\" \"float beta\" 0.3\nTranslate 0 0 0.6\nShape \"sphere\" \"float radius\" 0.6\n"
    "AttributeEnd\n"
    // An ellipsoid.
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 1 1]\nTranslate -1.4 0.3 0.9\n"
    "Rotate 30 1 1 0\nScale 0.7 0.3 0.15\nShape \"sphere\"\nAttributeEnd\n"
    // Mirrored, one side, facing down.
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 3 1]\nTranslate 1.4 0.6 1.4\n"
    "Scale -1 1 1\nReverseOrientation\nShape \"trianglemesh\" \"integer indices\" [0 1 2]\n"
    "  \"point3 P\" [-0.6 -0.4 0  0.6 -0.4 0.2  0 0.7 0.1]\nAttributeEnd\n"
    // Two-sided, upright.
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 4] \"bool twosided\" true\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point3 P\" [1.2 -1 0.2  1.2 -0.4 0.2  1.2 -0.4 0.8  1.2 -1 0.8]\nAttributeEnd\n"
    // A bowl that shines inwards.
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 1]\nTranslate -0.7 -1.2 1\n"
    "ReverseOrientation\nShape \"sphere\" \"float radius\" 0.4 \"float zmin\" 0.1 "
    "\"float zmax\" 0.4 \"float phimax\" 300\nAttributeEnd\n"
    // Vertex normals against the winding decide where it shines.
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\nTranslate 0 1.6 1.2\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2]\n"
    "  \"point3 P\" [-0.6 0 0  0.6 0 0  0 0.5 0.6] \"normal N\" [0 0.5 -1 0 0.5 -1 0 0.5 -1]\n"
    "AttributeEnd\n";

TEST(Reference, AgreesOnEveryKindOfLight) {
    const Scene scene = parse_scene(zoo, "zoo.pbrt");
    const BlockMeans reference = reference_blocks(scene, 3072, 4, Directions::lobe, 4);
    for (const Transport t : {Transport::intensity, Transport::stokes}) {
        SCOPED_TRACE(transport_name(t));
        expect_agreement(rendered_blocks(scene, t, 64, 4, 12), reference,
                         t == Transport::stokes ? 4 : 1);
    }
}

TEST(Reference, IsTheSameOnAnyNumberOfThreads) {
    const Scene scene = small_scene("two-metals.pbrt", 8, 5, 4);
    ReferenceOptions options;
    options.bands_nm = {{450.0, 460.5}, {700}};
    options.samples_per_pixel = 8;
    options.threads = 1;
    const ReferenceResult one = render_reference(scene, options);
    options.threads = 3;
    const ReferenceResult three = render_reference(scene, options);
    ASSERT_EQ(one.values.size(), 8u * 5 * 2);
    for (size_t i = 0; i < one.values.size(); ++i) {
        EXPECT_EQ(one.values[i].mean, three.values[i].mean);
        EXPECT_EQ(one.values[i].standard_error, three.values[i].standard_error);
    }
    EXPECT_EQ(one.rays, three.rays);
}

TEST(Reference, RefusesWhatItDoesNotCover) {
    Scene scene = small_scene("two-metals.pbrt", 8, 5, 4);
    ReferenceOptions options;
    EXPECT_THROW(render_reference(scene, options), Error);  // no band
    options.bands_nm = {{}};
    EXPECT_THROW(render_reference(scene, options), Error);
    options.bands_nm = {{900}};
    EXPECT_THROW(render_reference(scene, options), Error);
    options.bands_nm = {{500}};
    options.samples_per_pixel = 1;
    EXPECT_THROW(render_reference(scene, options), Error);
    options.samples_per_pixel = 2;
    EXPECT_NO_THROW(render_reference(scene, options));
    scene.filter.kind = FilterKind::gaussian;
    EXPECT_THROW(render_reference(scene, options), Error);
}

}  // namespace
}  // namespace drude
