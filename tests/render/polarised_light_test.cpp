// Whole pictures under polarised lights, through lenses and other cameras, against the reference
// integrator; and the laws of Malus and of mirrors.
#include <gtest/gtest.h>

#include "reference_comparison.h"
#include "render/transport_choice.h"
#include "test_scenes.h"

namespace drude {
namespace {

using Directions = ReferenceOptions::Directions;

// A rough metal ball and a mirror on a floor under a clear sky, with a lamp of every kind.
std::string garden(const std::string& before, const std::string& camera) {
    return before + "\nLookAt 0.5 -4 2.2  0 0 0.5  0 0 1\nCamera " + camera +
           "\nFilm \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
           "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 3\nWorldBegin\n"
           "AttributeBegin Rotate 20 0 1 1 LightSource \"infinite\" \"rgb L\" [0.3 0.4 0.6] "
           "\"string polarisation\" \"rayleigh\" \"vector3 sun\" [1 -1 1] AttributeEnd\n"
           "LightSource \"distant\" \"rgb L\" [0.6 0.5 0.4] \"point3 from\" [1 -2 3] \"float dop\" "
           "0.5 \"float aolp\" 25\n"
           "LightSource \"spot\" \"rgb I\" [6 3 3] \"point3 from\" [-2 -2 3] \"point3 to\" [0 0 0] "
           "\"float dop\" 1 \"float aolp\" 70\n"
           "AttributeBegin Material \"diffuse\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 "
           "0 "
           "2 3] \"point3 P\" [-3 -3 0  3 -3 0  3 3 0  -3 3 0] AttributeEnd\n"
           "AttributeBegin Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" "
           "\"beckmann\" \"float beta\" 0.4 Translate 0.6 0 0.6 Shape \"sphere\" \"float radius\" "
           "0.6 AttributeEnd\n"
           "AttributeBegin Material \"conductor\" \"string material\" \"Ag\" Translate -0.9 0.5 "
           "0.7 "
           "Rotate 60 1 0.3 0 Shape \"disk\" \"float radius\" 0.7 AttributeEnd\n"
           "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [2 2 3] \"bool twosided\" true "
           "\"float dop\" 0.8 \"float aolp\" -40 Translate 0 1.2 1.6 Rotate 50 1 2 0 Shape "
           "\"disk\" "
           "\"float radius\" 0.5 AttributeEnd\n";
}

void expect_pictures_agree(const Scene& scene) {
    const BlockMeans reference = reference_blocks(scene, 2048, 4, Directions::lobe, 4);
    for (const Transport t : {Transport::intensity, Transport::stokes}) {
        SCOPED_TRACE(transport_name(t));
        expect_agreement(rendered_blocks(scene, t, 64, 4, 12), reference,
                         t == Transport::stokes ? 4 : 1);
    }
}

TEST(PolarisedLight, AgreesWithTheReferenceInBothWorlds) {
    for (const char* before : {"", "Scale -1 1 1"}) {
        SCOPED_TRACE(before);
        expect_pictures_agree(
            parse_scene(garden(before, "\"perspective\" \"float fov\" 50"), "garden.pbrt"));
    }
}

TEST(PolarisedLight, AgreesThroughOtherCameras) {
    for (const char* camera :
         {"\"perspective\" \"float fov\" 50 \"float lensradius\" 0.3 \"float focaldistance\" 3",
          "\"orthographic\" \"float screenwindow\" [-1.5 1.5 -1.5 1.5] \"float lensradius\" 0.1 "
          "\"float focaldistance\" 4",
          "\"spherical\"", "\"spherical\" \"string mapping\" \"equirectangular\""}) {
        SCOPED_TRACE(camera);
        expect_pictures_agree(parse_scene(garden("", camera), "garden.pbrt"));
    }
}

// Straight at a polarised sky through the camera's polariser: cos^2 of the angle between them; in a
// mirrored picture the angles are those that are seen.
TEST(PolarisedLight, MalusBeforeASky) {
    for (const char* before : {"", "Scale -1 1 1"}) {
        for (const double angle : {0.0, 40.0, 75.0, 130.0}) {
            const Scene scene = parse_scene(
                fmt::format("{}\nCamera \"perspective\" \"float fov\" 0.01 \"float analyser\" {}\n"
                            "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
                            "PixelFilter \"box\"\nWorldBegin\nRotate -90 1 0 0\n"
                            "LightSource \"infinite\" \"float dop\" 0.5 \"float aolp\" 40\n",
                            before, angle),
                "malus.pbrt");
            const RenderResult result = render_quietly(scene, 1024);
            EXPECT_EQ(result.transport, Transport::intensity);
            const double expected = 0.5 * (1 + 0.5 * std::cos(2 * (angle - 40) * degree));
            EXPECT_NEAR(result.image.find("G")->data[0], expected, 2e-3) << before << angle;
        }
    }
}

}  // namespace
}  // namespace drude
