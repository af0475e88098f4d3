#include "render/geometry.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "render/embree.h"
#include "render/optical_elements.h"
#include "render/partial_sphere.h"

namespace drude {

namespace {

// World-space vertices and normals of one mesh, in the layout Embree reads.
struct WorldMesh {
    int shape;
    std::vector<glm::vec3> positions, normals;
    const std::vector<glm::uvec3>* triangles;
    bool flip;  // reversed orientation or a mirroring transform, not both
};

struct WorldSphere {
    int shape;
    PartialSphere sphere;
    bool flip;
};

bool mirrors(const glm::dmat4& m) {
    return glm::determinant(glm::dmat3(m)) < 0;
}

}  // namespace

struct Geometry::Impl {
    const Scene* scene;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;
    std::vector<WorldMesh> meshes;     // geometry id = index
    std::vector<WorldSphere> spheres;  // one user geometry, primitive id = index
    unsigned sphere_geometry = RTC_INVALID_GEOMETRY_ID;
    std::vector<int> mesh_of_shape, sphere_of_shape;

    ~Impl() {
        if (embree) rtcReleaseScene(embree);
        if (device) rtcReleaseDevice(device);
    }
};

namespace {

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
    const auto* impl = static_cast<const Geometry::Impl*>(args->geometryUserPtr);
    const PartialSphere& s = impl->spheres[args->primID].sphere;
    const double r = s.radius();
    // The widest circle between the cuts bounds x and y.
    const double widest = s.z_min() <= 0 && s.z_max() >= 0
                              ? r
                              : std::sqrt(std::max(0.0, r * r - std::min(s.z_min() * s.z_min(),
                                                                         s.z_max() * s.z_max())));
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? widest : -widest, corner & 2 ? widest : -widest,
                           corner & 4 ? s.z_max() : s.z_min());
        const glm::dvec3 w = s.to_world(p);
        low = glm::min(low, w);
        high = glm::max(high, w);
    }
    // Rounding to float must not cut anything off.
    const double slack = 1e-6 * (glm::length(low) + glm::length(high));
    RTCBounds* b = args->bounds_o;
    b->lower_x = static_cast<float>(low.x - slack);
    b->lower_y = static_cast<float>(low.y - slack);
    b->lower_z = static_cast<float>(low.z - slack);
    b->upper_x = static_cast<float>(high.x + slack);
    b->upper_y = static_cast<float>(high.y + slack);
    b->upper_z = static_cast<float>(high.z + slack);
}

double sphere_distance(const Geometry::Impl* impl, unsigned primitive, const RTCRay& ray) {
    return impl->spheres[primitive].sphere.intersect(
        {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar);
}

void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
    // Queries are single rays only, so N is 1 and the argument is an RTCRayHit.
    if (!args->valid[0]) return;
    auto* ray_hit = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const auto* impl = static_cast<const Geometry::Impl*>(args->geometryUserPtr);
    const double t = sphere_distance(impl, args->primID, ray_hit->ray);
    if (!(t > 0)) return;
    ray_hit->ray.tfar = static_cast<float>(t);
    ray_hit->hit.geomID = args->geomID;
    ray_hit->hit.primID = args->primID;
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    auto* ray = reinterpret_cast<RTCRay*>(args->ray);
    const auto* impl = static_cast<const Geometry::Impl*>(args->geometryUserPtr);
    if (sphere_distance(impl, args->primID, *ray) > 0) {
        ray->tfar = -std::numeric_limits<float>::infinity();
    }
}

WorldMesh to_world(const TriangleMesh& mesh, const Shape& shape, int index) {
    WorldMesh world;
    world.shape = index;
    world.triangles = &mesh.triangles;
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

// A surface through the world's origin still needs room to leave it.
constexpr float least_error = 1e-14f;

Hit sphere_hit(const WorldSphere& s, const glm::dvec3& object_point) {
    Hit hit;
    hit.p = glm::vec3(s.sphere.to_world(object_point));
    const double side = s.flip ? -1 : 1;
    hit.ng = glm::vec3(side * s.sphere.world_normal(object_point));
    hit.ns = hit.ng;
    hit.shape = s.shape;
    // The point is good to rounding in double; then comes one rounding to float a coordinate.
    const glm::vec3 size = glm::abs(hit.p);
    hit.error = 2 * FLT_EPSILON * std::max({size.x, size.y, size.z}) +
                static_cast<float>(s.sphere.rounding());
    hit.error = std::max(hit.error, least_error);
    return hit;
}

Hit triangle_hit(const WorldMesh& mesh, unsigned primitive, float v, float w) {
    const glm::uvec3 t = (*mesh.triangles)[primitive];
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const float u = 1 - v - w;
    Hit hit;
    hit.p = u * a + v * b + w * c;
    // Seven roundings on sums of this size (Pharr, Jakob & Humphreys, section 6.8.5).
    const glm::vec3 size = glm::abs(a) + glm::abs(b) + glm::abs(c);
    hit.error = std::max(7 * FLT_EPSILON * std::max({size.x, size.y, size.z}), least_error);
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
    return hit;
}

}  // namespace

Geometry::Geometry(const Scene& scene, const std::string& isa,
                   const std::function<bool(const Shape&)>& wanted)
    : impl_(std::make_unique<Impl>()) {
    impl_->scene = &scene;
    impl_->mesh_of_shape.assign(scene.shapes.size(), -1);
    impl_->sphere_of_shape.assign(scene.shapes.size(), -1);
    // One build thread: the tree, and with it the order of equal hits, must not depend on timing.
    const std::string config = isa.empty() ? "threads=1" : fmt::format("threads=1,isa={}", isa);
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
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            impl_->mesh_of_shape[i] = static_cast<int>(impl_->meshes.size());
            impl_->meshes.push_back(to_world(*mesh, shape, index));
        } else {
            impl_->sphere_of_shape[i] = static_cast<int>(impl_->spheres.size());
            impl_->spheres.push_back(
                {index, PartialSphere(std::get<Sphere>(shape.geometry), shape.world_from_object),
                 shape.reverse_orientation});
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
                                   mesh.triangles->data(), 0, sizeof(glm::uvec3),
                                   mesh.triangles->size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(impl_->embree, geometry,
                              static_cast<unsigned>(&mesh - impl_->meshes.data()));
        rtcReleaseGeometry(geometry);
    }
    if (!impl_->spheres.empty()) {
        const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(impl_->spheres.size()));
        rtcSetGeometryUserData(geometry, impl_.get());
        rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
        rtcSetGeometryOccludedFunction(geometry, sphere_occluded);
        rtcCommitGeometry(geometry);
        impl_->sphere_geometry = static_cast<unsigned>(impl_->meshes.size());
        rtcAttachGeometryByID(impl_->embree, geometry, impl_->sphere_geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl_->embree);
    if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) {
        outside_error("Embree cannot build the scene; is there enough memory?");
    }
    if (!impl_->meshes.empty() || !impl_->spheres.empty()) {
        RTCBounds bounds;
        rtcGetSceneBounds(impl_->embree, &bounds);
        const glm::vec3 low(bounds.lower_x, bounds.lower_y, bounds.lower_z);
        const glm::vec3 high(bounds.upper_x, bounds.upper_y, bounds.upper_z);
        centre_ = 0.5f * (low + high);
        radius_ = 0.5f * glm::length(high - low);
    }
    isa_ = isa.empty() ? best_isa(impl_->device) : isa;
}

Geometry::~Geometry() = default;

void Geometry::triangle(int shape, unsigned primitive, glm::vec3 corners[3]) const {
    const WorldMesh& mesh = impl_->meshes[impl_->mesh_of_shape[shape]];
    const glm::uvec3 t = (*mesh.triangles)[primitive];
    for (int i = 0; i < 3; ++i) corners[i] = mesh.positions[t[i]];
}

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

    if (query.hit.geomID == impl_->sphere_geometry) {
        const WorldSphere& s = impl_->spheres[query.hit.primID];
        const glm::dvec3 near = glm::dvec3(o) + static_cast<double>(query.ray.tfar) * glm::dvec3(d);
        *hit = sphere_hit(s, s.sphere.on_surface(s.sphere.to_object(near)));
    } else {
        *hit = triangle_hit(impl_->meshes[query.hit.geomID], query.hit.primID, query.hit.u,
                            query.hit.v);
    }
    return true;
}

Hit Geometry::on_triangle(int shape, unsigned primitive, float v, float w) const {
    return triangle_hit(impl_->meshes[impl_->mesh_of_shape[shape]], primitive, v, w);
}

Hit Geometry::on_sphere(int shape, const glm::dvec3& object_point) const {
    return sphere_hit(impl_->spheres[impl_->sphere_of_shape[shape]], object_point);
}

double Geometry::area_stretch(int shape, const glm::dvec3& n) const {
    return impl_->spheres[impl_->sphere_of_shape[shape]].sphere.area_stretch(n);
}

double Geometry::area_stretch_at(int shape, const glm::vec3& p) const {
    const PartialSphere& sphere = impl_->spheres[impl_->sphere_of_shape[shape]].sphere;
    return sphere.area_stretch(glm::normalize(sphere.to_object(p)));
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

}  // namespace drude
