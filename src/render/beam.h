// A path's throughput together with the frame that its columns are in.
#pragma once

#include "materials/frame.h"
#include "render/plugin_scattering.h"
#include "render/throughput.h"

namespace drude {

template <Transport transport, int N>
struct Beam {
    Throughput<transport, N> throughput;
    glm::vec3 x{0};  // x axis of the columns' frame, across the ray that the path follows next

    // Light that arrives along `arriving` leaves along `out` over a facet of normal m (world,
    // unit); r is what happens in its s-p frame. Refraction too: s is common to both rays.
    void scatter(const glm::vec3& out, const glm::vec3& arriving, const glm::vec3& m,
                 const Reflection<Packet<N>>& r, float weight, float handedness) {
        const glm::vec3 s = s_axis(arriving, m);
        throughput.reflect(rotation_between(out, x, s, handedness), r, weight);
        x = s;
    }
    // The same for a perfect depolariser.
    void scatter(const glm::vec3&, const glm::vec3& arriving, const glm::vec3&,
                 const Packet<N>& reflectance, float weight, float) {
        throughput.depolarise(reflectance * Packet<N>(weight));
        x = any_perpendicular(arriving);
    }
    // The same for matrices that take this frame, on `out`, from one of their own.
    void scatter(const glm::vec3&, const glm::vec3&, const glm::vec3&, const DenseOptics<N>& r,
                 float weight, float) {
        throughput.apply(r.mueller);
        throughput.scale(weight);
        x = r.x_in;
    }
};

}  // namespace drude
