// A thousand reflections: the renderer's throughput of floats against powers of the Mueller matrix
// in double, and whole pictures of a mirrored room against the sum of its geometric series.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/mueller.h"
#include "render/render.h"

namespace drude {

namespace {

using P = Packet<8>;

// Two parallel mirrors, the plane of incidence turned by 17 degrees from each bounce to the next (a
// helix of rays in a mirrored pipe). Largest error of an element over M_00, so that S0..S3 of any
// light, and its degree of polarisation, are good to that.
double product_error(const ComplexIndex<double>& metal, double cosine, int bounces) {
    constexpr double turn = 2 * 17 * degree;
    const Rotation<double> exact_turn{std::cos(turn), std::sin(turn)};
    const Rotation<float> fast_turn{static_cast<float>(exact_turn.cos2),
                                    static_cast<float>(exact_turn.sin2)};
    const Reflection<double> exact_r = reflect(metal, cosine);
    const Reflection<P> fast_r = reflect(ComplexIndex<P>{P(metal.n), P(metal.k)}, P(cosine));
    const Mueller<double> bounce = mueller(inverse(exact_turn)) * mueller(exact_r);
    Mueller<double> exact = Mueller<double>::identity();
    Throughput<Transport::stokes, 8> fast;
    for (int i = 0; i < bounces; ++i) {
        exact = exact * bounce;
        // As roulette does it, and by a power of two: the throughput stays in range.
        const double scale = std::exp2(-std::round(std::log2(exact.m[0][0])));
        for (auto& row : exact.m) {
            for (double& element : row) element *= scale;
        }
        fast.reflect(fast_turn, fast_r, static_cast<float>(scale));
    }
    double worst = 0;
    for (int column = 0; column < 4; ++column) {
        Mueller<float> bring = Mueller<float>::diagonal(0, 0, 0, 0);
        bring.m[column][0] = 1;
        Throughput<Transport::stokes, 8> moved = fast;
        moved.apply(bring);
        const auto found = moved.unpolarised(P(1.0f));
        for (int row = 0; row < 4; ++row) {
            keep_worst(std::abs(static_cast<double>(found.s[row][0]) - exact.m[row][column]) /
                           exact.m[0][0],
                       &worst);
        }
    }
    return worst;
}

StabilityMap product_map(const std::vector<double>& bounces, int resolution) {
    StabilityMap map;
    map.id = "mirrors-product";
    map.title = "Many reflections";
    map.error = "largest error of an element of the product, over M_00";
    map.bound = 2e-3;
    map.domain = "everywhere";
    map.outside = "nothing is";
    map.caption =
        "Throughput of floats with its Fresnel equations against the power of one bounce in double; "
        "the worst of aluminium, silver, gold and copper. A bounce adds some 1e-6.";
    map.x = {"reflections", bounces};
    map.y = {"angle of incidence (degrees)", even_steps(0, 89, resolution)};
    fill_map(&map, [](double x, double y) {
        MapCell cell;
        for (const ComplexIndex<double>& metal :
             {ComplexIndex<double>{0.96, 6.69}, {0.05, 3.09}, {0.183, 3.43}, {1.04, 2.59}}) {
            keep_worst(product_error(metal, std::cos(y * degree), static_cast<int>(x)),
                       &cell.error);
        }
        return cell;
    });
    return map;
}

// A sphere that shines and reflects inside, radiance 1 from its wall: seen from within it has the
// radiance 1 + R + R^2 + ... + R^depth.
double room_error(double R, int depth, int samples) {
    const Scene scene = parse_scene(
        fmt::format("Camera \"perspective\" \"float fov\" 60\n"
                    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" {}\nWorldBegin\n"
                    "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n"
                    "Material \"conductor\" \"rgb reflectance\" [{} {} {}]\n"
                    "Translate 0.1 0.2 0\nShape \"sphere\"\n",
                    depth, R, R, R),
        "room.pbrt");
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.threads = 1;
    options.quiet = true;
    const RenderResult result = render(scene, options);
    double mean = 0;
    for (const float g : result.image.find("G")->data) {
        mean += static_cast<double>(g) / static_cast<double>(result.image.pixels());
    }
    double expected = 0;
    for (int k = depth; k >= 0; --k) expected = 1 + R * expected * (k < depth ? 1 : 0);
    return std::abs(mean / expected - 1);
}

StabilityMap room_map(const std::vector<double>& depths, int samples) {
    StabilityMap map;
    map.id = "mirrors-room";
    map.title = "A mirrored room";
    map.error = "relative error of S0";
    map.bound = 0.1;
    map.domain = "everywhere up to 1000 bounces";
    map.outside =
        "`drude render` warns of maxdepth above 1024: beyond, paths end at random however bright";
    map.caption = fmt::format(
        "Whole pictures (8 x 8 pixels, {} samples) from within a sphere that shines and reflects: "
        "the geometric series is known. Roulette leaves noise of about 1/64 where R is 0.999.",
        samples);
    map.x = {"maxdepth", depths};
    map.y = {"reflectance", {0.3, 0.9, 0.99, 0.999}};
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        cell.error = room_error(y, static_cast<int>(x), samples);
        return cell;
    });
    return map;
}

}  // namespace

std::vector<StabilityMap> mirror_maps(int resolution, int samples) {
    return {product_map({1, 3, 10, 30, 100, 300, 1000}, resolution),
            room_map({1, 10, 100, 1000}, samples)};
}

BenchItem mirror_stability_item() {
    return {"stability-mirrors", "Stability: a thousand reflections",
            "S0..S3 between mirrors against powers of the Mueller matrix, a mirrored room",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = options.quick ? mirror_maps(10, 16) : mirror_maps(40, 128);
                return result;
            }};
}

}  // namespace drude
