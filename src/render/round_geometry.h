// The spheres, disks or cylinders of a scene as one user geometry of Embree.
#pragma once

#include <algorithm>
#include <cfloat>
#include <limits>
#include <vector>

#include "render/embree.h"
#include "render/geometry.h"

namespace drude {

// `Surface` is PartialSphere, PartialDisk or PartialCylinder.
template <class Surface>
class RoundGeometry {
  public:
    struct Member {
        int shape;
        Surface surface;
        bool flip;  // of the surface's own normal
    };
    std::vector<Member> members;  // primitive id = index

    // Where there is any member. Embree keeps a pointer to this object.
    void attach(RTCDevice device, RTCScene scene, unsigned id) {
        if (members.empty()) return;
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(members.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcSetGeometryOccludedFunction(geometry, occluded);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
        id_ = id;
    }
    bool is(unsigned geometry_id) const { return geometry_id == id_; }

    // The hit of a member at a point near its surface, in the world.
    Hit hit_near(unsigned primitive, const glm::dvec3& p) const {
        const Surface& surface = members[primitive].surface;
        return hit_at(primitive, surface.on_surface(surface.to_object(p)));
    }
    // The same at a point of its surface, in its own space.
    Hit hit_at(unsigned primitive, const glm::dvec3& object_point) const {
        const Member& member = members[primitive];
        const Surface& surface = member.surface;
        Hit hit;
        hit.p = glm::vec3(surface.to_world(object_point));
        const double side = member.flip ? -1 : 1;
        hit.ng = glm::vec3(side * surface.world_normal(surface.normal(object_point)));
        hit.ns = hit.ng;
        hit.shape = member.shape;
        // The point is good to rounding in double; then comes one rounding to float a coordinate.
        const glm::vec3 size = glm::abs(hit.p);
        hit.error = 2 * FLT_EPSILON * std::max({size.x, size.y, size.z}) +
                    static_cast<float>(surface.rounding());
        hit.error = std::max(hit.error, least_hit_error);
        return hit;
    }
    // World area per area of the member's own space, where its point is.
    double stretch(unsigned primitive, const glm::dvec3& object_point) const {
        const Surface& surface = members[primitive].surface;
        return surface.area_stretch(glm::normalize(surface.normal(object_point)));
    }

  private:
    static const RoundGeometry& self(const void* pointer) {
        return *static_cast<const RoundGeometry*>(pointer);
    }

    static void bounds(const RTCBoundsFunctionArguments* args) {
        const Surface& surface = self(args->geometryUserPtr).members[args->primID].surface;
        const glm::dvec3 box[2] = {surface.low(), surface.high()};
        glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p =
                surface.to_world({box[corner & 1].x, box[(corner >> 1) & 1].y, box[corner >> 2].z});
            low = glm::min(low, p);
            high = glm::max(high, p);
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

    static double distance(const void* user, unsigned primitive, const RTCRay& ray) {
        return self(user).members[primitive].surface.intersect({ray.org_x, ray.org_y, ray.org_z},
                                                               {ray.dir_x, ray.dir_y, ray.dir_z},
                                                               ray.tnear, ray.tfar);
    }

    static void intersect(const RTCIntersectFunctionNArguments* args) {
        // Queries are single rays only, so N is 1 and the argument is an RTCRayHit.
        if (!args->valid[0]) return;
        auto* ray_hit = reinterpret_cast<RTCRayHit*>(args->rayhit);
        const double t = distance(args->geometryUserPtr, args->primID, ray_hit->ray);
        if (!(t > 0)) return;
        ray_hit->ray.tfar = static_cast<float>(t);
        ray_hit->hit.geomID = args->geomID;
        ray_hit->hit.primID = args->primID;
    }

    static void occluded(const RTCOccludedFunctionNArguments* args) {
        if (!args->valid[0]) return;
        auto* ray = reinterpret_cast<RTCRay*>(args->ray);
        if (distance(args->geometryUserPtr, args->primID, *ray) > 0) {
            ray->tfar = -std::numeric_limits<float>::infinity();
        }
    }

    unsigned id_ = RTC_INVALID_GEOMETRY_ID;
};

}  // namespace drude
