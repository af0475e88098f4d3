#include "render/geometry_layers.h"

#include "base/executor.h"
#include "render/albedo.h"
#include "render/vertex.h"

namespace drude {

namespace {

enum Layer { px, py, pz, z, nx, ny, nz, sx, sy, sz, u, v, red, green, blue, material, layers };
constexpr const char* names[layers] = {"P.X",      "P.Y",      "P.Z",      "Z",       "N.X", "N.Y",
                                       "N.Z",      "Ns.X",     "Ns.Y",     "Ns.Z",    "u",   "v",
                                       "Albedo.R", "Albedo.G", "Albedo.B", "Material"};

}  // namespace

void add_geometry_layers(const Scene& scene, const Geometry& geometry, const CameraRays& camera,
                         int threads, Image* image) {
    const Albedos albedos(scene);
    const size_t first = image->channels.size();
    for (const char* name : names) image->add(name);
    float* data[layers];
    for (size_t i = 0; i < layers; ++i) data[i] = image->channels[first + i].data.data();
    const bool world = scene.film.gbuffer_in_world;
    image->attributes["geometrySpace"] = std::string(world ? "world" : "camera");

    const glm::dmat4 camera_from_world = glm::inverse(scene.camera.world_from_camera);
    // Normals are turned by the inverse transpose.
    const glm::dmat3 normals = glm::transpose(glm::dmat3(scene.camera.world_from_camera));
    const auto width = static_cast<size_t>(image->width);
    parallel_for(static_cast<size_t>(image->height), threads, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            const size_t pixel = y * width + x;
            const auto set = [&](Layer layer, double value) {
                data[layer][pixel] = static_cast<float>(value);
            };
            const CameraRay ray =
                camera(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            Hit hit;
            if (!geometry.intersect(ray.o, ray.d, &hit)) {
                set(material, -1);
                continue;
            }
            const Vertex vertex(hit, ray.d);
            const auto set_vector = [&](Layer layer, const glm::dvec3& value) {
                for (int c = 0; c < 3; ++c) set(static_cast<Layer>(layer + c), value[c]);
            };
            const auto set_normal = [&](Layer layer, const glm::vec3& n) {
                set_vector(layer, world ? glm::dvec3(n) : glm::normalize(normals * glm::dvec3(n)));
            };
            const glm::dvec3 seen(camera_from_world * glm::dvec4(glm::dvec3(hit.p), 1));
            set_vector(px, world ? glm::dvec3(hit.p) : seen);
            set(z, scene.camera.kind == CameraKind::spherical ? glm::length(seen) : seen.z);
            set_normal(nx, vertex.hit.ng);
            set_normal(sx, vertex.hit.ns);
            const TexturePoint at(geometry, hit);
            set(u, at.uv().x);
            set(v, at.uv().y);
            const int index = scene.shapes[hit.shape].material;
            const auto cosine = static_cast<double>(glm::dot(vertex.hit.ns, vertex.out));
            set_vector(red, albedos(index, at, cosine));
            set(material, index);
        }
    });
}

}  // namespace drude
