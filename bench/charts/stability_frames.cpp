// Frames of polarised light where they have no meaning of their own: reflection straight back, on
// through where nothing bends, and along the surface. The renderer's beam of floats against dense
// matrices in double, for the same rays.
//
// Straight back the plane of incidence is undefined, and the s axis of a float is any direction
// within 6e-8 over the angle of incidence. It does no harm: what depends on the axis, B and C + A,
// vanishes as the square of that angle.
#include <algorithm>
#include <cmath>

#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/dielectric.h"
#include "materials/torrance_sparrow.h"
#include "render/beam.h"

namespace drude {

namespace {

using FastBeam = Beam<Transport::stokes, 8>;
using P = Packet<8>;

// The columns one by one: each is brought to the place of S0.
Mueller<double> matrix_of(const Throughput<Transport::stokes, 8>& throughput) {
    Mueller<double> result;
    for (int column = 0; column < 4; ++column) {
        Mueller<float> bring = Mueller<float>::diagonal(0, 0, 0, 0);
        bring.m[column][0] = 1;
        Throughput<Transport::stokes, 8> moved = throughput;
        moved.apply(bring);
        const auto first = moved.unpolarised(P(1.0f));
        for (int row = 0; row < 4; ++row) {
            result.m[row][column] = static_cast<double>(first.s[row][0]);
        }
    }
    return result;
}

// A ray along `arriving` that leaves along `out` at a facet of normal m, between frames of x axes
// x_in and x_out.
struct Event {
    Vec3<float> arriving, out, m, x_in, x_out;
};

Mueller<double> fast(const Event& e, const Reflection<P>& r) {
    FastBeam beam{{}, e.x_out};
    beam.scatter(e.out, e.arriving, e.m, r, 1, -1);
    // From the frame of the light to that which the beam has arrived at.
    beam.throughput.apply(mueller(rotation_between(e.arriving, e.x_in, beam.x, -1.0f)));
    return matrix_of(beam.throughput);
}

Mueller<double> exact(const Event& e, const Reflection<double>& r) {
    const Vec3<double> arriving = glm::normalize(Vec3<double>(e.arriving)),
                       out = glm::normalize(Vec3<double>(e.out)),
                       m = glm::normalize(Vec3<double>(e.m));
    const Vec3<double> s = s_axis(arriving, m);
    return mueller(inverse(rotation_between(out, Vec3<double>(e.x_out), s, -1.0))) * mueller(r) *
           mueller(rotation_between(arriving, Vec3<double>(e.x_in), s, -1.0));
}

double largest_difference(const Mueller<double>& a, const Mueller<double>& b) {
    double worst = 0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) keep_worst(std::abs(a.m[i][j] - b.m[i][j]), &worst);
    }
    return worst;
}

// Unit, across k, turned by `turn` radians from where any_perpendicular() points.
Vec3<float> frame_across(const Vec3<double>& k, double turn) {
    const Vec3<double> x = any_perpendicular(k), y = glm::cross(k, x);
    return Vec3<float>(std::cos(turn) * x + std::sin(turn) * y);
}

// Normals in general position, and those at which bases of other people's making break.
const Vec3<double> normals[] = {{0, 0, 1}, {0, 0, -1}, {0.6, 0, 0.8}, {-0.36, 0.48, -0.8},
                                {1, 0, 0}, {0.577, 0.577, -0.578}};

// Light at `angle` (radians) to the normal, turned around it by 1 radian.
struct Ray {
    Vec3<double> in, m;
};
Ray ray_at(const Vec3<double>& normal, double angle) {
    const Vec3<double> m = glm::normalize(normal);
    const Vec3<double> x = any_perpendicular(m), y = glm::cross(m, x);
    return {std::cos(angle) * m + std::sin(angle) * (std::cos(1.0) * x + std::sin(1.0) * y), m};
}

// Off copper at 550 nm.
double reflection_error(double angle, double turn) {
    constexpr double n = 1.04, k = 2.59;
    double worst = 0;
    for (const Vec3<double>& normal : normals) {
        const Ray ray = ray_at(normal, angle);
        Event e;
        e.m = Vec3<float>(ray.m);
        const Vec3<float> i(ray.in);
        e.arriving = -i;
        e.out = glm::normalize(2 * glm::dot(i, e.m) * e.m - i);
        e.x_in = frame_across(ray.in, 0.3);
        e.x_out = frame_across(glm::normalize(Vec3<double>(e.out)), turn);
        const float cosine = std::min(1.0f, glm::dot(i, e.m));
        const double exact_cosine =
            std::min(1.0, glm::dot(glm::normalize(Vec3<double>(i)), ray.m));
        keep_worst(
            largest_difference(fast(e, reflect(ComplexIndex<P>{P(n), P(k)}, P(cosine))),
                               exact(e, reflect(ComplexIndex<double>{n, k}, exact_cosine))),
            &worst);
    }
    return worst;
}

// Through an interface of relative index 1 + bend.
double refraction_error(double angle, double bend) {
    double worst = 0;
    for (const Vec3<double>& normal : normals) {
        const Ray ray = ray_at(normal, angle);
        const double eta = 1 + bend, cosine = std::cos(angle);
        const double q = normal_component(ComplexIndex<double>{eta, 0}, cosine).re;
        Event e;
        e.m = Vec3<float>(ray.m);
        e.out = Vec3<float>(ray.in);
        // Along the ray that comes from behind the interface towards `out`.
        e.arriving = -Vec3<float>(glm::normalize((cosine - q) * ray.m - ray.in));
        e.x_in = frame_across(glm::normalize(Vec3<double>(e.arriving)), 0.3);
        e.x_out = frame_across(ray.in, 0.9);
        keep_worst(
            largest_difference(fast(e, divide_at_interface(P(eta), P(cosine)).transmitted),
                               exact(e, divide_at_interface(eta, cosine).transmitted)),
            &worst);
    }
    return worst;
}

}  // namespace

std::vector<StabilityMap> frame_maps(int resolution) {
    StabilityMap back;
    back.id = "frames-back";
    back.title = "Straight back";
    back.error = "largest error of a Mueller element";
    back.bound = 5e-6;
    back.domain = "everywhere, angle 0 included";
    back.outside = "nothing is";
    back.caption =
        "Reflection off copper between two fixed frames; the lowest angle stands for 0 as well. Six "
        "normals, among them those along the axes.";
    back.x = {"angle of incidence (degrees)", log_steps(1e-7, 45, resolution)};
    back.y = {"turn of the camera's frame (degrees)", even_steps(0, 180, resolution / 2 + 1)};
    fill_map(&back, [&](double x, double y) {
        MapCell cell;
        keep_worst(reflection_error(x * degree, y * degree), &cell.error);
        if (x == back.x.at.front()) keep_worst(reflection_error(0, y * degree), &cell.error);
        return cell;
    });

    StabilityMap along = back;
    along.id = "frames-along";
    along.title = "Along the surface";
    along.domain = "everywhere";
    along.caption =
        "The same towards grazing incidence, where the forward direction and the reflected one "
        "become one.";
    along.x = {"90 - angle of incidence (degrees)", log_steps(1e-4, 45, resolution)};
    fill_map(&along, [](double x, double y) {
        MapCell cell;
        keep_worst(reflection_error((90 - x) * degree, y * degree), &cell.error);
        return cell;
    });

    StabilityMap forward = back;
    forward.id = "frames-forward";
    forward.title = "Straight on";
    forward.bound = 5e-6;
    forward.domain = "everywhere, matched indices included";
    forward.caption =
        "Refraction where the indices nearly match and the ray is hardly bent: the s axis is that of "
        "the facet, so that forward is no special direction.";
    forward.x = {"relative index less 1", log_steps(1e-7, 1, resolution)};
    forward.y = {"angle of incidence (degrees)", log_steps(1e-6, 85, resolution)};
    fill_map(&forward, [](double x, double y) {
        MapCell cell;
        keep_worst(refraction_error(y * degree, x), &cell.error);
        return cell;
    });
    return {back, along, forward};
}

BenchItem frame_stability_item() {
    return {"stability-frames", "Stability: frames of collinear rays",
            "reflection straight back, along the surface and straight on",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = frame_maps(options.quick ? 10 : 40);
                return result;
            }};
}

}  // namespace drude
