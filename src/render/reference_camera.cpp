#include "render/reference_camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "materials/scalar.h"

namespace drude {

namespace {

using Vec = glm::dvec3;

// The square's four corners lie at the nadir, its middle at the zenith; a quarter of it after the
// other: within the quarter, the upper hemisphere is the triangle at the middle, where the sum of
// the coordinates is the length of (x, y) in Lambert's equal-area map of the hemisphere and their
// share the azimuth; the lower hemisphere is the triangle at the corner, mirrored at the diagonal
// between the two. Zenith along +z.
Vec equal_area_quarter(double u, double v) {
    const double a = std::abs(2 * u - 1), b = std::abs(2 * v - 1);
    const bool below = a + b > 1;
    const double p = below ? 1 - b : a, q = below ? 1 - a : b;
    const double r = p + q;  // sqrt(1 - |z|)
    const double azimuth = r > 0 ? pi / 2 * q / r : 0;
    const double z = (1 - r * r) * (below ? -1 : 1), side = std::sqrt(1 - z * z);
    return {side * std::cos(azimuth) * (u < 0.5 ? -1 : 1),
            side * std::sin(azimuth) * (v < 0.5 ? -1 : 1), z};
}

// Across an edge the square goes on with itself turned by half a turn about the edge's middle.
void bring_inside(double* u, double* v) {
    if (*u < 0) *u = -*u, *v = 1 - *v;
    if (*u > 1) *u = 2 - *u, *v = 1 - *v;
    if (*v < 0) *v = -*v, *u = 1 - *u;
    if (*v > 1) *v = 2 - *v, *u = 1 - *u;
}

}  // namespace

ReferenceCamera::ReferenceCamera(const Scene& scene) : scene_(scene) {
    // What is seen at distance 1 moves to the right and up with the pixel; whether right, up and
    // ahead are a right-handed triple is how the picture shows the world. The point is no symmetric
    // one, so that it lies on no fold of a mapping.
    const double x = 0.37193 * scene.film.width, y = 0.41417 * scene.film.height;
    const double step = 1e-5;
    const auto seen = [&](double px, double py) {
        const ReferenceRay r = ray(px, py);
        return r.o + r.d;
    };
    const Vec right = seen(x + step, y) - seen(x - step, y);
    const Vec up = seen(x, y - step) - seen(x, y + step);
    handedness_ = glm::dot(glm::cross(right, up), ray(x, y).d) > 0 ? -1 : 1;
}

ReferenceRay ReferenceCamera::ray(double x, double y, double u1, double u2) const {
    const Camera& camera = scene_.camera;
    const double* w = camera.screen_window;
    const double right = w[0] + (w[1] - w[0]) * x / scene_.film.width;
    const double up = w[3] - (w[3] - w[2]) * y / scene_.film.height;
    // In camera space, the point that a ray starts from and one that it passes.
    Vec from(0), through(0);
    if (camera.kind == CameraKind::perspective) {
        const double tangent = std::tan(camera.fov_deg * pi / 360);
        through = {right * tangent, up * tangent, 1};
        through *= camera.focal_distance;
    } else if (camera.kind == CameraKind::orthographic) {
        from = {right, up, 0};
        through = {right, up, camera.focal_distance};
    } else if (camera.equal_area) {
        double u = right, v = 1 - up;
        bring_inside(&u, &v);
        const Vec zenith = equal_area_quarter(u, v);
        through = {zenith.x, zenith.z, zenith.y};
    } else {
        // Azimuth from camera x towards camera z; zenith camera y.
        const double azimuth = 2 * pi * right, elevation = pi * (up - 0.5);
        through = {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                   std::cos(elevation) * std::sin(azimuth)};
    }
    if (has_lens()) {
        const double r = camera.lens_radius * std::sqrt(u1), angle = 2 * pi * u2;
        from += Vec(r * std::cos(angle), r * std::sin(angle), 0);
    }
    const glm::dmat4& m = camera.world_from_camera;
    const glm::dmat3 axes(m);
    ReferenceRay ray;
    ray.o = Vec(m * glm::dvec4(from, 1));
    ray.d = glm::normalize(axes * (through - from));
    ray.horizontal = glm::cross(ray.d, glm::normalize(axes[1]));
    if (glm::length(ray.horizontal) < 1e-6) {
        ray.horizontal = axes[0] - glm::dot(axes[0], ray.d) * ray.d;
    }
    ray.horizontal = glm::normalize(ray.horizontal);
    return ray;
}

}  // namespace drude
