// The project's own scenes, scenes that nobody here wrote, and scenes that make no sense.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <random>
#include <stdexcept>

#include "base/files.h"
#include "scene/ply.h"
#include "scene_text.h"
#include "shared_data.h"

namespace drude {
namespace {

const std::string scenes = DRUDE_SOURCE_DIR "/scenes/";

TEST(OwnScenes, AreReadWithoutStandIns) {
    for (const char* name :
         {"half-sphere.pbrt", "furnace.pbrt", "cornell-metals.pbrt", "two-metals.pbrt",
          "gold-teapot.pbrt", "material-orb.pbrt", "crossed-polarisers.pbrt"}) {
        const Scene scene = read_scene(scenes + name);
        EXPECT_TRUE(scene.stand_ins.empty()) << name << ": " << scene.stand_ins[0];
        EXPECT_FALSE(scene.shapes.empty()) << name;
    }
}

TEST(OwnScenes, TheHalfSphereShowsOnlyItsOutside) {
    const Scene scene = read_scene(scenes + "half-sphere.pbrt");
    ASSERT_EQ(scene.shapes.size(), 1u);
    const Sphere& sphere = std::get<Sphere>(scene.shapes[0].geometry);
    EXPECT_EQ(sphere.radius, 1);
    EXPECT_EQ(sphere.z_min, 0);
    const glm::dvec3 eye(scene.camera.world_from_camera[3]);
    const glm::dvec3 up(scene.camera.world_from_camera[1]);
    // Above the rim, so that the inside is hidden; the dome points up in world and picture.
    EXPECT_GT(eye.z, 0.0);
    EXPECT_LT(eye.z, 0.5);
    EXPECT_GT(up.z, 0.99);
    EXPECT_EQ(scene.film.width, 512);
    EXPECT_EQ(scene.film.height, 512);
    EXPECT_EQ(scene.filter.kind, FilterKind::box);
    EXPECT_EQ(scene.max_depth, 10);
    // The whole sphere is within the picture: its angular radius below half of the field of view.
    EXPECT_LT(std::asin(1 / glm::length(eye)) * 57.29577951, scene.camera.fov_deg / 2);
    const auto& metal = std::get<ConductorMaterial>(
        scene.materials.at(static_cast<size_t>(scene.shapes[0].material)));
    EXPECT_EQ(metal.surface.lobe, Lobe::blinn_phong);
    EXPECT_EQ(metal.surface.masking, Masking::v_groove);
    EXPECT_EQ(metal.surface.beta, 0.011774);
}

TEST(OwnScenes, TheLightOfTheBoxFacesDown) {
    const Scene scene = read_scene(scenes + "cornell-metals.pbrt");
    const TriangleMesh& mesh = std::get<TriangleMesh>(scene.shapes.at(0).geometry);
    ASSERT_GE(scene.shapes[0].area_light, 0);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        EXPECT_LT(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a).z, 0);
    }
}

const TriangleMesh& mesh_of(const Scene& scene, size_t at_least) {
    for (const Shape& shape : scene.shapes) {
        const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
        if (mesh && mesh->triangles.size() >= at_least) return *mesh;
    }
    throw std::runtime_error("no such mesh");
}

// Every triangle's winding and its corners' normals point to the same side.
void expect_consistent(const TriangleMesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        const glm::vec3 n =
            glm::normalize(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
        for (const unsigned corner : {t.x, t.y, t.z}) {
            ASSERT_NEAR(glm::length(mesh.normals[corner]), 1, 1e-5);
            ASSERT_GT(glm::dot(n, mesh.normals[corner]), 0.7f);
        }
    }
}

// The normal of a vertex at p, or zero.
glm::vec3 normal_at(const TriangleMesh& mesh, const glm::vec3& p) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        if (glm::length(mesh.positions[i] - p) < 1e-5f) return mesh.normals[i];
    }
    return glm::vec3(0);
}

TEST(OwnScenes, TheTeapotHasNewellsMeasuresAndOutwardNormals) {
    const Scene scene = read_scene(scenes + "gold-teapot.pbrt");
    const TriangleMesh& teapot = mesh_of(scene, 10000);
    expect_consistent(teapot);
    // Where two pieces of a profile meet in a straight line of control points, the surface has the
    // point and its normal is across that line.
    EXPECT_LT(glm::length(normal_at(teapot, {2, 0, 0.9f}) - glm::vec3(1, 0, 0)), 1e-4f);
    EXPECT_LT(glm::length(normal_at(teapot, {0, -2, 0.9f}) - glm::vec3(0, -1, 0)), 1e-4f);
    EXPECT_LT(glm::length(normal_at(teapot, {0, 0, 3.15f}) - glm::vec3(0, 0, 1)), 1e-4f);
    EXPECT_LT(glm::length(normal_at(teapot, {0, 0, 0}) - glm::vec3(0, 0, -1)), 1e-4f);
    // Upper handle meets lower handle at its back, going straight down.
    EXPECT_LT(glm::length(normal_at(teapot, {-3, 0, 1.8f}) - glm::vec3(-1, 0, 0)), 1e-4f);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : teapot.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_FLOAT_EQ(low.z, 0);
    EXPECT_FLOAT_EQ(high.z, 3.15f);
    EXPECT_FLOAT_EQ(low.y, -2);
    EXPECT_FLOAT_EQ(high.y, 2);
    EXPECT_FLOAT_EQ(low.x, -3);
}

TEST(OwnScenes, TheOrbsStandAndBackdropFaceOutwards) {
    const Scene scene = read_scene(scenes + "material-orb.pbrt");
    const TriangleMesh& stand = mesh_of(scene, 1000);
    expect_consistent(stand);
    // Outwards: the volume within is that of a solid, and positive (divergence theorem). A cup
    // with a foot of radius 1 is more than its stem and less than the cylinder around it.
    double volume = 0;
    for (const glm::uvec3& t : stand.triangles) {
        const glm::dvec3 a(stand.positions[t.x]), b(stand.positions[t.y]), c(stand.positions[t.z]);
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    EXPECT_GT(volume, 3.1415 * 0.33 * 0.33 * 0.42);
    EXPECT_LT(volume, 3.1415 * 0.5);
}

std::string message_of(const std::string& path) {
    try {
        read_scene(path);
    } catch (const Error& error) {
        return error.message();
    }
    return {};
}

TEST(Corpus, Version4ScenesStopAtTheirMissingFilesOnly) {
    const std::string orb = shared_data("scenes/pbrt-v4/lte-orb/lte-orb-silver.pbrt");
    const std::string gold = shared_data("scenes/pbrt-v4/killeroos/killeroo-gold.pbrt");
    DRUDE_NEED_SHARED(orb);
    DRUDE_NEED_SHARED(gold);
    const std::string of_orb = message_of(orb);
    EXPECT_TRUE(contains(of_orb, "lte-orb-silver.pbrt:40:9: scene file not found")) << of_orb;
    const std::string of_gold = message_of(gold);
    EXPECT_TRUE(contains(of_gold, "picture of a texture not found") &&
                contains(of_gold, "killeroo-gold.pbrt:43:9: "))
        << of_gold;
}

TEST(Corpus, OurKillerooWantsItsAnimalOnly) {
    const std::string animal = scenes + "geometry/killeroo3.pbrt";
    const std::string message = message_of(scenes + "killeroo-gold.pbrt");
    if (std::filesystem::exists(animal)) GTEST_SKIP() << "somebody has put the animal in its place";
    EXPECT_TRUE(contains(message, "killeroo-gold.pbrt:43:13: scene file not found") &&
                contains(message, "geometry/killeroo3.pbrt"))
        << message;
}

TEST(Corpus, OlderScenesAreNamed) {
    const std::string v3 = shared_data("scenes/pbrt-v3/killeroo-simple.pbrt");
    const std::string v2 = shared_data("scenes/pbrt-v2/metal.pbrt");
    DRUDE_NEED_SHARED(v3);
    DRUDE_NEED_SHARED(v2);
    const std::string of_v3 = message_of(v3);
    EXPECT_TRUE(contains(of_v3, "pbrt-v3 syntax")) << of_v3;
    EXPECT_TRUE(contains(of_v3, "Film \"image\" becomes Film \"rgb\"")) << of_v3;
    const std::string of_v2 = message_of(v2);
    EXPECT_TRUE(contains(of_v2, "pbrt-v2 syntax")) << of_v2;
    EXPECT_TRUE(contains(of_v2, "Renderer becomes Integrator")) << of_v2;
}

// Bytes of a good text changed at random: only Errors may come out.
template <class Parse>
void mutate(const std::string& good, int times, const Parse& parse) {
    std::mt19937 random(1);
    const auto below = [&](size_t limit) { return static_cast<size_t>(random() % limit); };
    const std::string letters = " \n\"[]#-.0129eETtx\\\xff";
    int errors = 0;
    for (int i = 0; i < times; ++i) {
        std::string text = good;
        for (size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
            const size_t at = below(text.size());
            const size_t length = std::min(text.size() - at, 1 + below(12));
            switch (below(5)) {
                case 0:
                    text[at] = letters[below(letters.size())];
                    break;
                case 1:
                    text[at] = static_cast<char>(below(256));
                    break;
                case 2:
                    text.erase(at, length);
                    break;
                case 3:
                    text.insert(below(text.size()), text.substr(at, length));
                    break;
                default:
                    text.resize(std::max<size_t>(1, at));
            }
        }
        try {
            parse(text);
        } catch (const Error& error) {
            ++errors;
            EXPECT_FALSE(error.message().empty());
        }
    }
    EXPECT_GT(errors, times / 10);
}

const char* const everything = R"(
LookAt 0 -5 1 0 0 0 0 0 1
Camera "perspective" "float fov" [ 40 ] "float lensradius" 0
Film "rgb" "integer xresolution" 32 "integer yresolution" [ 16 ] "string filename" "a\"b.exr"
Sampler "halton" "integer pixelsamples" 4
PixelFilter "triangle" "float xradius" 1
Integrator "path" "integer maxdepth" 3
Option "disablepixeljitter" true
WorldBegin # here
AttributeBegin
  Attribute "material" "float roughness" 0.1
  Texture "t" "spectrum" "scale" "rgb tex" [ .5 .4 .3 ] "float scale" 0.5
  MakeNamedMaterial "m" "string type" "diffuse" "texture reflectance" "t"
  CoordinateSystem "here" Rotate 30 1 2 3 Scale 1 2 3 CoordSysTransform "here"
  Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1 ] ReverseOrientation
  AreaLightSource "diffuse" "blackbody L" 3000 "float power" 10 "bool twosided" true
  NamedMaterial "m"
  Shape "trianglemesh" "integer indices" [ 0 1 2 2 3 0 ]
      "point3 P" [ 0 0 0 1 0 0 1 1 0 0 1 0 ] "point2 uv" [ 0 0 1 0 1 1 0 1 ]
AttributeEnd
ObjectBegin "o" Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" [ 400 2 700 3 ]
  Shape "sphere" "float zmin" -.5 "float phimax" 270 Shape "disk" Shape "cylinder"
ObjectEnd
Translate 0 0 2 ObjectInstance "o"
LightSource "distant" "point3 from" [ 0 1 2 ] "rgb L" [ 1 2 3 ] "float scale" 2
LightSource "infinite" "spectrum L" [ 400 1 700 2 ] MediumInterface "" ""
)";

TEST(Mutations, OfASceneGiveOnlyErrors) {
    EXPECT_EQ(scene_of(everything).shapes.size(), 4u);
    mutate(everything, 2000, [](const std::string& text) { scene_of(text); });
}

TEST(Mutations, OfAMeshGiveOnlyErrors) {
    const std::string header =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string ascii = "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    std::string binary = "ply\nformat binary_little_endian 1.0\n" + header;
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    binary.append(reinterpret_cast<const char*>(positions), sizeof positions);
    const int indices[3] = {0, 1, 2};
    binary.push_back(3);
    binary.append(reinterpret_cast<const char*>(indices), sizeof indices);
    for (const std::string& good : {ascii, binary}) {
        mutate(good, 2000, [](const std::string& text) {
            Messages messages;
            parse_ply(text, "m.ply", messages);
        });
    }
}

}  // namespace
}  // namespace drude
