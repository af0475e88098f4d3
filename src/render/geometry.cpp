#include "render/geometry.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/executor.h"
#include "render/optical_elements.h"
#include "render/partial_cylinder.h"
#include "render/partial_disk.h"
#include "render/partial_sphere.h"
#include "render/round_geometry.h"
#include "scene/builders.h"

namespace drude {

namespace {

// World-space vertices and normals of one mesh, in the layout Embree reads.
struct WorldMesh {
    int shape;
    std::vector<glm::vec3> positions, normals;
    const TriangleMesh* own;  // triangles and uv
    bool flip;                // reversed orientation or a mirroring transform, not both
};

bool mirrors(const glm::dmat4& m) {
    return glm::determinant(glm::dmat3(m)) < 0;
}

}  // namespace

struct Geometry::Impl {
    const Scene* scene;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;
    std::vector<WorldMesh> meshes;  // geometry id = index
    RoundGeometry<PartialSphere> spheres;
    RoundGeometry<PartialDisk> disks;
    RoundGeometry<PartialCylinder> cylinders;
    std::vector<unsigned> index_of_shape;  // in the list of its kind

    const ShapeGeometry& own(int shape) const { return scene->shapes[shape].geometry; }
    const WorldMesh& mesh(int shape) const { return meshes[index_of_shape[shape]]; }
    // Calls body(RoundGeometry, index) for a shape that is no mesh.
    template <class Body>
    auto with_round(int shape, const Body& body) const {
        const unsigned index = index_of_shape[shape];
        if (std::holds_alternative<Sphere>(own(shape))) return body(spheres, index);
        if (std::holds_alternative<Disk>(own(shape))) return body(disks, index);
        return body(cylinders, index);
    }

    ~Impl() {
        if (embree) rtcReleaseScene(embree);
        if (device) rtcReleaseDevice(device);
    }
};

namespace {

WorldMesh to_world(const TriangleMesh& mesh, const Shape& shape, int index) {
    WorldMesh world;
    world.shape = index;
    world.own = &mesh;
    world.flip = shape.reverse_orientation != mirrors(shape.world_from_object);
    const glm::dmat3 normal_matrix =
        glm::transpose(glm::inverse(glm::dmat3(shape.world_from_object)));
    world.positions.reserve(mesh.positions.size() + 1);
    for (const glm::vec3& p : mesh.positions) {
        world.positions.emplace_back(shape.world_from_object * glm::dvec4(p, 1));
    }
    const double side = shape.reverse_orientation ? -1 : 1;
    for (const glm::vec3& n : mesh.normals) {
        world.normals.emplace_back(side * glm::normalize(normal_matrix * glm::dvec3(n)));
    }
    return world;
}

// What Embree chooses when it may: pictures have the same bits on the same set only. The device
// says how wide its packets are; AVX2 and SSE4.2 it does not tell from their elders.
std::string best_isa(RTCDevice device) {
    const auto has = [&](RTCDeviceProperty p) { return rtcGetDeviceProperty(device, p) != 0; };
    if (has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return "avx512";
    if (has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) {
        return __builtin_cpu_supports("avx2") ? "avx2" : "avx";
    }
    return __builtin_cpu_supports("sse4.2") ? "sse4.2" : "sse2";
}

Hit triangle_hit(const WorldMesh& mesh, unsigned primitive, float v, float w) {
    const glm::uvec3 t = mesh.own->triangles[primitive];
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const float u = 1 - v - w;
    Hit hit;
    hit.p = u * a + v * b + w * c;
    // Seven roundings on sums of this size (Pharr, Jakob & Humphreys, section 6.8.5).
    const glm::vec3 size = glm::abs(a) + glm::abs(b) + glm::abs(c);
    hit.error = std::max(7 * FLT_EPSILON * std::max({size.x, size.y, size.z}), least_hit_error);
    // In double: the fourth power of a triangle's size leaves the range of float at 1e-10 and 1e9.
    const glm::dvec3 corner(a);
    const glm::dvec3 across = glm::cross(glm::dvec3(b) - corner, glm::dvec3(c) - corner);
    hit.ng = glm::vec3((mesh.flip ? -1.0 : 1.0) * glm::normalize(across));
    hit.ns = hit.ng;
    if (!mesh.normals.empty()) {
        const glm::vec3 n = u * mesh.normals[t.x] + v * mesh.normals[t.y] + w * mesh.normals[t.z];
        const float size2 = glm::dot(n, n);
        if (size2 > 1e-12f) hit.ns = n / std::sqrt(size2);
        if (glm::dot(hit.ns, hit.ng) < 0) hit.ng = -hit.ng;
    }
    hit.shape = mesh.shape;
    hit.primitive = primitive;
    hit.barycentric = {v, w};
    return hit;
}

}  // namespace

Geometry::Geometry(const Scene& scene, const std::string& isa,
                   const std::function<bool(const Shape&)>& wanted)
    : impl_(std::make_unique<Impl>()) {
    impl_->scene = &scene;
    impl_->index_of_shape.assign(scene.shapes.size(), 0);
    // "threads" limits TBB's pool for as long as the device lives, not the building of this tree.
    std::string config = uses_tbb_pool() ? "" : "threads=1";
    if (!isa.empty()) config += fmt::format("{}isa={}", config.empty() ? "" : ",", isa);
    impl_->device = rtcNewDevice(config.c_str());
    if (!impl_->device) outside_error("Embree cannot start (configuration '{}')", config);
    impl_->embree = rtcNewScene(impl_->device);
    rtcSetSceneFlags(impl_->embree, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->embree, RTC_BUILD_QUALITY_HIGH);

    for (size_t i = 0; i < scene.shapes.size(); ++i) {
        const Shape& shape = scene.shapes[i];
        const int index = static_cast<int>(i);
        if (shape.material < 0) continue;
        if (wanted ? !wanted(shape) : is_optical_element(scene, shape)) continue;
        const auto add_round = [&](auto& round, const auto& own) {
            impl_->index_of_shape[i] = static_cast<unsigned>(round.members.size());
            round.members.push_back(
                {index, {own, shape.world_from_object}, shape.reverse_orientation});
        };
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            impl_->index_of_shape[i] = static_cast<unsigned>(impl_->meshes.size());
            impl_->meshes.push_back(to_world(*mesh, shape, index));
        } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
            add_round(impl_->spheres, *sphere);
        } else if (const auto* disk = std::get_if<Disk>(&shape.geometry)) {
            add_round(impl_->disks, *disk);
        } else {
            add_round(impl_->cylinders, std::get<Cylinder>(shape.geometry));
        }
    }
    for (WorldMesh& mesh : impl_->meshes) {
        const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at the last vertex; the reserve above left room.
        mesh.positions.emplace_back(0.0f);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(glm::vec3),
                                   mesh.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.own->triangles.data(), 0, sizeof(glm::uvec3),
                                   mesh.own->triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(impl_->embree, geometry,
                              static_cast<unsigned>(&mesh - impl_->meshes.data()));
        rtcReleaseGeometry(geometry);
    }
    const auto first_id = static_cast<unsigned>(impl_->meshes.size());
    impl_->spheres.attach(impl_->device, impl_->embree, first_id);
    impl_->disks.attach(impl_->device, impl_->embree, first_id + 1);
    impl_->cylinders.attach(impl_->device, impl_->embree, first_id + 2);
    // The tree, and with it the order of equal hits, must not depend on timing.
    on_one_pool_thread([this] { rtcCommitScene(impl_->embree); });
    if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) {
        outside_error("Embree cannot build the scene; is there enough memory?");
    }
    RTCBounds bounds;
    rtcGetSceneBounds(impl_->embree, &bounds);
    if (bounds.lower_x <= bounds.upper_x) {  // an empty scene's are the wrong way round
        const glm::vec3 low(bounds.lower_x, bounds.lower_y, bounds.lower_z);
        const glm::vec3 high(bounds.upper_x, bounds.upper_y, bounds.upper_z);
        centre_ = 0.5f * (low + high);
        radius_ = 0.5f * glm::length(high - low);
    }
    isa_ = isa.empty() ? best_isa(impl_->device) : isa;
}

Geometry::~Geometry() = default;

bool Geometry::intersect(const glm::vec3& o, const glm::vec3& d, Hit* hit) const {
    alignas(16) RTCRayHit query;
    query.ray.org_x = o.x, query.ray.org_y = o.y, query.ray.org_z = o.z;
    query.ray.dir_x = d.x, query.ray.dir_y = d.y, query.ray.dir_z = d.z;
    query.ray.tnear = 0, query.ray.time = 0;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u, query.ray.id = 0, query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(impl_->embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const unsigned id = query.hit.geomID, primitive = query.hit.primID;
    if (id < impl_->meshes.size()) {
        *hit = triangle_hit(impl_->meshes[id], primitive, query.hit.u, query.hit.v);
        return true;
    }
    const glm::dvec3 near = glm::dvec3(o) + static_cast<double>(query.ray.tfar) * glm::dvec3(d);
    if (impl_->spheres.is(id)) {
        *hit = impl_->spheres.hit_near(primitive, near);
    } else if (impl_->disks.is(id)) {
        *hit = impl_->disks.hit_near(primitive, near);
    } else {
        *hit = impl_->cylinders.hit_near(primitive, near);
    }
    return true;
}

bool Geometry::occluded(const glm::vec3& o, const glm::vec3& d, float distance) const {
    alignas(16) RTCRay ray;
    ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
    ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
    ray.tnear = 0, ray.time = 0, ray.tfar = distance;
    ray.mask = ~0u, ray.id = 0, ray.flags = 0;
    embree_occluded(impl_->embree, &ray);
    return ray.tfar < 0;
}

glm::dvec2 Geometry::uv(const Hit& hit) const {
    if (!std::holds_alternative<TriangleMesh>(impl_->own(hit.shape))) {
        return impl_->with_round(hit.shape, [&](const auto& round, unsigned index) {
            const auto& surface = round.members[index].surface;
            return surface.uv(surface.to_object(hit.p));
        });
    }
    const double v = hit.barycentric.x, w = hit.barycentric.y;
    const TriangleMesh& own = *impl_->mesh(hit.shape).own;
    if (own.uv.empty()) return {v + w, w};
    const glm::uvec3 t = own.triangles[hit.primitive];
    return (1 - v - w) * glm::dvec2(own.uv[t.x]) + v * glm::dvec2(own.uv[t.y]) +
           w * glm::dvec2(own.uv[t.z]);
}

unsigned Geometry::primitives(int shape) const {
    const auto* mesh = std::get_if<TriangleMesh>(&impl_->own(shape));
    return mesh ? static_cast<unsigned>(mesh->triangles.size()) : 1;
}

double Geometry::area(int shape, unsigned primitive) const {
    const Shape& own = impl_->scene->shapes[shape];
    if (!std::holds_alternative<TriangleMesh>(own.geometry)) {
        return surface_area(own.geometry, own.world_from_object);
    }
    const WorldMesh& mesh = impl_->mesh(shape);
    const glm::uvec3 t = mesh.own->triangles[primitive];
    const glm::dvec3 a(mesh.positions[t.x]);
    return glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                  glm::dvec3(mesh.positions[t.z]) - a)) /
           2;
}

Geometry::AreaSample Geometry::sample(int shape, unsigned primitive, const glm::vec2& u) const {
    AreaSample sample;
    if (std::holds_alternative<TriangleMesh>(impl_->own(shape))) {
        const float root = std::sqrt(u.x);
        sample.hit = triangle_hit(impl_->mesh(shape), primitive, root * (1 - u.y), root * u.y);
    } else {
        sample.hit = impl_->with_round(shape, [&](const auto& round, unsigned index) {
            return round.hit_at(index, round.members[index].surface.sample(u));
        });
    }
    sample.density = density(sample.hit);
    return sample;
}

float Geometry::density(const Hit& hit) const {
    double size = 0;
    if (std::holds_alternative<TriangleMesh>(impl_->own(hit.shape))) {
        size = area(hit.shape, hit.primitive);
    } else {
        size = impl_->with_round(hit.shape, [&](const auto& round, unsigned index) {
            const auto& surface = round.members[index].surface;
            return surface.object_area() * round.stretch(index, surface.to_object(hit.p));
        });
    }
    return size > 0 ? static_cast<float>(1 / size) : 0;
}

}  // namespace drude
