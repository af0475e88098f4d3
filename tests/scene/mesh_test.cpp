#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

#include "scene/builders.h"
#include "scene/ply.h"
#include "scene_text.h"
#include "temporary_folder.h"

namespace drude {
namespace {

// Bytes of a PLY body in either order.
class Bytes {
  public:
    explicit Bytes(bool big) : big_(big) {}
    template <class T>
    Bytes& add(T value) {
        char buffer[sizeof(T)];
        std::memcpy(buffer, &value, sizeof(T));
        const uint16_t probe = 1;
        const bool native_big = *reinterpret_cast<const unsigned char*>(&probe) == 0;
        if (native_big != big_) std::reverse(buffer, buffer + sizeof(T));
        text.append(buffer, sizeof(T));
        return *this;
    }
    std::string text;

  private:
    bool big_;
};

const char* const header_body =
    "comment made by hand\n"
    "element vertex 4\nproperty float x\nproperty double y\nproperty float32 z\n"
    "property uchar red\nproperty float nx\nproperty float ny\nproperty float nz\n"
    "property float u\nproperty float v\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty short flags\n"
    "element edge 1\nproperty list uint8 uint16 nodes\nend_header\n";

std::string ascii_ply() {
    return std::string("ply\r\nformat ascii 1.0\r\n") + header_body +
           "0 0 0 255 0 0 1 0 0\n1 0 0 255 0 0 1 1 0\n1 1 0 255 0 0 1 1 1\n0 1 0 255 0 0 1 0 1\n"
           "4 0 1 2 3 7\n3 0 2 3 7\n2 5 6\n";
}

std::string binary_ply(bool big) {
    Bytes bytes(big);
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        bytes.add(static_cast<float>(x)).add(static_cast<double>(y)).add(0.0f);
        bytes.add(static_cast<unsigned char>(255)).add(0.0f).add(0.0f).add(1.0f);
        bytes.add(static_cast<float>(x)).add(static_cast<float>(y));
    }
    bytes.add(static_cast<unsigned char>(4));
    for (const int i : {0, 1, 2, 3}) bytes.add(static_cast<int32_t>(i));
    bytes.add(static_cast<int16_t>(7));
    bytes.add(static_cast<unsigned char>(3));
    for (const int i : {0, 2, 3}) bytes.add(static_cast<int32_t>(i));
    bytes.add(static_cast<int16_t>(7));
    bytes.add(static_cast<unsigned char>(2)).add(static_cast<uint16_t>(5));
    bytes.add(static_cast<uint16_t>(6));
    return std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" +
           header_body + bytes.text;
}

void expect_square(const TriangleMesh& mesh) {
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    ASSERT_EQ(mesh.normals.size(), 4u);
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
    ASSERT_EQ(mesh.uv.size(), 4u);
    EXPECT_EQ(mesh.uv[3], glm::vec2(0, 1));
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
    EXPECT_EQ(mesh.triangles[2], glm::uvec3(0, 2, 3));
}

TriangleMesh mesh_of(const std::string& bytes) {
    Messages messages;
    return parse_ply(bytes, "m.ply", messages);
}

std::string ply_error(const std::string& bytes) {
    try {
        mesh_of(bytes);
    } catch (const Error& error) {
        return error.message();
    }
    ADD_FAILURE() << "nothing thrown";
    return {};
}

TEST(Ply, AllThreeFormatsGiveTheSameMesh) {
    expect_square(mesh_of(ascii_ply()));
    expect_square(mesh_of(binary_ply(false)));
    expect_square(mesh_of(binary_ply(true)));
}

TEST(Ply, IsReadFromASceneAndPacked) {
    TemporaryFolder folder;
    write(folder.file("a.ply"), binary_ply(false));
    write_gz(folder.file("b.ply.gz"), binary_ply(true));
    const Scene scene = parse_scene(
        "WorldBegin Shape \"plymesh\" \"string filename\" \"a.ply\"\n"
        "Shape \"plymesh\" \"string filename\" \"b.ply.gz\"",
        folder.file("s.pbrt"));
    ASSERT_EQ(scene.shapes.size(), 2u);
    for (const Shape& shape : scene.shapes) expect_square(std::get<TriangleMesh>(shape.geometry));
}

TEST(Ply, EveryTruncationIsAnError) {
    for (const std::string& whole : {ascii_ply(), binary_ply(false), binary_ply(true)}) {
        // The last number of the ascii file may lose digits and its line end without harm.
        const size_t end = whole == ascii_ply() ? whole.size() - 3 : whole.size();
        for (size_t size = 0; size < end; ++size) {
            EXPECT_THROW(mesh_of(whole.substr(0, size)), Error) << size;
        }
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

TEST(Ply, ErrorsHaveTheirPlace) {
    const std::string good = ascii_ply();
    EXPECT_PLACE_AND_TEXT(ply_error("plx\n"), "m.ply:1", "no PLY file");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "ascii", "binary")), "m.ply:2", "format");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "float x", "flaot x")), "m.ply:5",
                          "did you mean 'float'?");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "vertex 4", "vertex -4")), "m.ply:4", "count");
    // A count that the file cannot hold claims no memory.
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "vertex 4", "vertex 4000000000000")), "m.ply:4",
                          "count that the file can hold");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "4 0 1 2 3", "4000 1 2 3")), "m.ply:24",
                          "a list of 4000");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "4 0 1 2 3", "4 0 1 2 4")), "m.ply:24",
                          "index 4; expected 0 to 3");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "4 0 1 2 3", "4 0 1 2 -1")), "m.ply:24",
                          "index -1");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "1 1 0 255", "1 nan 0 255")), "m.ply:22",
                          "found nan");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "1 1 0 255", "1 x 0 255")), "m.ply:22",
                          "found 'x'");
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "double y", "double yy")), "m.ply:4",
                          "without x, y and z");
    // A list is no coordinate.
    EXPECT_PLACE_AND_TEXT(ply_error(replaced(good, "float x", "list uchar float x")), "m.ply:4",
                          "a list 'x'; expected one number");
    EXPECT_PLACE_AND_TEXT(
        ply_error("ply\nformat ascii 1.0\nelement a 99999999999999\nend_header\n"), "m.ply:3",
        "without properties");
    EXPECT_PLACE_AND_TEXT(ply_error("ply\nformat ascii 1.0\nend_header\n"), "m.ply", "no triangle");
}

TEST(Meshes, NormalsOfLengthZeroAndFlatTrianglesAreMended) {
    const Scene scene = world_of(
        "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 2 0 1 "
        "1 ] \"normal N\" [ 0 0 0 0 0 1 0 0 1 ]");
    const TriangleMesh& mesh = std::get<TriangleMesh>(scene.shapes.at(0).geometry);
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_TRUE(warns(scene, "1 of 2 triangles have no area"));
    EXPECT_TRUE(warns(scene, "1 normals of length 0"));
}

double area(const std::string& world) {
    const Scene scene = world_of(world);
    const Shape& shape = scene.shapes.at(0);
    return surface_area(shape.geometry, shape.world_from_object);
}

TEST(Meshes, AreasAreKnown) {
    const double pi = 3.14159265358979323846;
    EXPECT_NEAR(area("Scale 3 3 3 Shape \"sphere\" \"float radius\" 2"), 4 * pi * 36, 1e-9);
    EXPECT_NEAR(area("Shape \"sphere\" \"float zmin\" 0 \"float phimax\" 90"), pi / 2, 1e-12);
    // A prolate spheroid of axes 1, 1, 2.
    const double e = std::sqrt(0.75);
    EXPECT_NEAR(area("Scale 1 1 2 Shape \"sphere\""), 2 * pi * (1 + 2 / e * std::asin(e)), 1e-3);
    EXPECT_NEAR(area("Shape \"disk\" \"float radius\" 2"), 4 * pi, 1e-12);
    EXPECT_NEAR(area("Shape \"disk\" \"float radius\" 2 \"float innerradius\" 1"), 3 * pi, 1e-12);
    EXPECT_NEAR(area("Shape \"cylinder\" \"float radius\" 2 \"float zmax\" 3"), 16 * pi, 1e-11);
    EXPECT_NEAR(area("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 2 0 0 0 3 0 2 3 0 ]"), 6, 1e-12);
}

}  // namespace
}  // namespace drude
