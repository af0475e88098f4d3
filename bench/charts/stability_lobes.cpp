// The four lobes from polished to rough and from normal to grazing incidence: what floats make of
// the norm, of sampling, of the density that is stated for a sample, and of a white furnace.
//
// Lobes of beta below mirror_below_beta are drawn as mirrors, which say so (is_mirror(), and
// `drude render --explain`); above largest_beta they are refused. Both count as said.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/microfacet.h"

namespace drude {

namespace {

constexpr Lobe lobes[] = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                          Lobe::trowbridge_reitz};

std::vector<Masking> maskings_of(Lobe lobe) {
    if (lobe == Lobe::beckmann || lobe == Lobe::trowbridge_reitz) {
        return {Masking::v_groove, Masking::smith};
    }
    return {Masking::v_groove};
}

// Evenly spread points of the unit cube: multiples of powers of the root of x^4 = x + 1 (the
// lattice of Kronecker, with the generalised golden ratio).
std::array<double, 3> uniform_point(int i) {
    constexpr double root = 1.22074408460575947536;
    std::array<double, 3> u;
    double step = 1;
    for (double& value : u) {
        step /= root;
        const double turn = 0.5 + step * (i + 1);
        value = turn - std::floor(turn);
    }
    return u;
}

// What a cell of all maps of a lobe is about.
struct Setting {
    Lobe lobe;
    Masking masking;
    double beta;
    Vec3<float> o;
};

Vec3<float> direction(double from_grazing_deg) {
    // Not in a plane of coordinates.
    const double z = std::sin(from_grazing_deg * degree), r = std::cos(from_grazing_deg * degree);
    return {static_cast<float>(0.8 * r), static_cast<float>(0.6 * r), static_cast<float>(z)};
}

// How much of white light from everywhere comes back, of float less that of double, from the same
// uniform numbers; and how much more than all.
double furnace_error(const Setting& s, int samples) {
    const Microfacets<float> fast(s.lobe, s.masking, s.beta);
    const Microfacets<double> exact(s.lobe, s.masking, s.beta);
    double of_fast = 0, of_exact = 0;
    for (int i = 0; i < samples; ++i) {
        const auto u = uniform_point(i);
        const float f[3] = {static_cast<float>(u[0]), static_cast<float>(u[1]),
                            static_cast<float>(u[2])};
        of_fast += static_cast<double>(fast.sample(s.o, f[0], f[1], f[2]).weight) / samples;
        of_exact += exact.sample(Vec3<double>(s.o), u[0], u[1], u[2]).weight / samples;
    }
    double worst = 0;
    keep_worst(std::abs(of_fast - of_exact), &worst);
    keep_worst(std::max(0.0, of_fast - 1), &worst);
    return worst;
}

// The density of float samples against the one that is stated for them. The mean of q / pdf over
// samples of density pdf is the integral of q, for any q; here q is the density, in double, of the
// lobe of two thirds of the width. Its integral is the share of its samples that leave the
// surface.
double density_error(const Setting& s, int samples) {
    const Microfacets<float> fast(s.lobe, s.masking, s.beta);
    const Microfacets<double> narrow(s.lobe, s.masking, std::max(s.beta / 1.5, mirror_below_beta));
    double mean = 0, leaves = 0;
    for (int i = 0; i < samples; ++i) {
        const auto u = uniform_point(i);
        const auto drawn = fast.sample(s.o, static_cast<float>(u[0]), static_cast<float>(u[1]),
                                       static_cast<float>(u[2]));
        const Vec3<double> o(s.o);
        if (drawn.pdf > 0) {
            // By the facet, whose x and y hold the digits that a narrow lobe needs.
            const Vec3<double> m(drawn.m);
            const double q = narrow.D(m) * narrow.G1(o, m) / (4 * o.z);
            mean += q / static_cast<double>(drawn.pdf) / samples;
        }
        leaves += (narrow.sample(o, u[0], u[1], u[2]).pdf > 0 ? 1.0 : 0.0) / samples;
    }
    return std::abs(mean - leaves);
}

// A small round light of radiance 1 about the mirrored direction, twice beta in radius, seen in a
// white lobe with multiple importance sampling, the power heuristic of the renderer. `T` draws and
// weighs; whether a direction meets the light is asked in double.
template <class T>
double small_light(const Setting& s, int samples) {
    const Microfacets<T> lobe(s.lobe, s.masking, s.beta);
    const Vec3<T> o(s.o);
    const Vec3<double> axis(-static_cast<double>(s.o.x), -static_cast<double>(s.o.y),
                            static_cast<double>(s.o.z));
    const Vec3<double> across = glm::normalize(Vec3<double>(axis.z, 0, -axis.x));
    const Vec3<double> along = glm::cross(axis, across);
    const double radius = std::min(2 * s.beta, 1.5), half = std::sin(radius / 2);
    const auto light_pdf = static_cast<T>(1 / (4 * pi * half * half));
    const auto share = [](T a, T b) { return a * a / (a * a + b * b); };
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const auto u = uniform_point(i);
        const auto drawn =
            lobe.sample(o, static_cast<T>(u[0]), static_cast<T>(u[1]), static_cast<T>(u[2]));
        if (drawn.pdf > 0 && glm::length(Vec3<double>(drawn.i) - axis) < 2 * half) {
            sum += static_cast<double>(drawn.weight * share(drawn.pdf, light_pdf));
        }
        // Uniform in solid angle: 1 - cos by the half angle, which keeps a small light's digits.
        const double lack = 2 * half * half * u[0], z = 1 - lack;
        const double r = std::sqrt(lack * (2 - lack)), phi = 2 * pi * u[1];
        const Vec3<T> d(z * axis + r * std::cos(phi) * across + r * std::sin(phi) * along);
        const auto found = lobe.evaluate(o, d);
        if (found.value > 0) {
            sum += static_cast<double>(found.value / light_pdf * share(light_pdf, found.pdf));
        }
    }
    return sum / samples;
}
double small_light_error(const Setting& s, int samples) {
    return std::abs(small_light<float>(s, samples) - small_light<double>(s, samples));
}

StabilityMap lobe_map(Lobe lobe, const std::string& kind, int resolution, int samples,
                      double (*error)(const Setting&, int)) {
    StabilityMap map;
    map.id = fmt::format("lobes-{}-{}", kind, lobe_name(lobe));
    map.domain = fmt::format("beta from {} to {}, all angles", mirror_below_beta, largest_beta);
    map.outside = "below: a mirror, as --explain says; above: refused with the range";
    map.x = {"beta", log_steps(1e-6, 1.5, resolution)};
    for (const double edge : {mirror_below_beta, largest_beta}) map.x.at.push_back(edge);
    std::sort(map.x.at.begin(), map.x.at.end());
    map.y = {"90 - angle of the viewer (degrees)", log_steps(1e-3, 90, resolution * 2 / 3)};
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        cell.inside = x >= mirror_below_beta && x <= largest_beta;
        for (const Masking masking : maskings_of(lobe)) {
            try {
                if (Microfacets<float>(lobe, masking, x).is_mirror()) {
                    cell.refused = true;
                } else {
                    keep_worst(error({lobe, masking, x, direction(y)}, samples), &cell.error);
                }
            } catch (const Error&) {
                cell.refused = true;
            }
        }
        return cell;
    });
    return map;
}

StabilityMap norm_map(int resolution) {
    StabilityMap map;
    map.id = "lobes-norm";
    map.title = "The norm of the lobes";
    map.error = "error of the integral of D cos";
    map.bound = 1e-5;
    map.domain = fmt::format("beta from {} to {}", mirror_below_beta, largest_beta);
    map.outside = "below: a mirror, as --explain says; above: refused with the range";
    map.caption = "D of floats, integrated in double over the tangent from 1e-4 to 1e5 times beta.";
    map.x = {"beta", log_steps(1e-6, 1.5, resolution)};
    map.y = {"lobe", {1, 2, 3, 4}, {"Blinn-Phong", "Gaussian", "Beckmann", "Trowbridge-Reitz"}};
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        cell.inside = x >= mirror_below_beta && x <= largest_beta;
        const Lobe lobe = lobes[static_cast<int>(y) - 1];
        try {
            if (Microfacets<float>(lobe, Masking::v_groove, x).is_mirror()) {
                cell.refused = true;
                return cell;
            }
        } catch (const Error&) {
            cell.refused = true;
            return cell;
        }
        const LobeDensity<float> density(lobe, static_cast<float>(x));
        // Simpson's rule in the logarithm of the tangent.
        constexpr int steps = 4000;
        const double first = std::log(1e-4 * x), last = std::log(1e5 * std::max(x, 1e-3));
        const double h = (last - first) / steps;
        double total = 0;
        for (int i = 0; i <= steps; ++i) {
            const double t2 = std::exp(2 * (first + i * h));
            const double weight = (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * h / 3;
            const double D = static_cast<double>(density(static_cast<float>(t2)));
            total += weight * D * 2 * pi * t2 / ((1 + t2) * (1 + t2));
        }
        cell.error = std::abs(total - 1);
        return cell;
    });
    return map;
}

}  // namespace

std::vector<StabilityMap> lobe_maps(int resolution, int samples) {
    std::vector<StabilityMap> maps{norm_map(resolution)};
    for (const Lobe lobe : lobes) {
        const std::string name(lobe_name(lobe));
        StabilityMap furnace = lobe_map(lobe, "furnace", resolution, samples, furnace_error);
        furnace.title = fmt::format("White furnace, {}", name);
        furnace.error = "error of the share of white light that comes back";
        furnace.bound = 1e-5;
        furnace.caption = fmt::format(
            "{} samples of floats against double from the same uniform numbers, the worse of the "
            "maskings that the lobe has; more than all of the light counts as error too.",
            samples);
        maps.push_back(std::move(furnace));
        StabilityMap density = lobe_map(lobe, "density", resolution, samples, density_error);
        density.title = fmt::format("Samples against their density, {}", name);
        density.error = "error of an integral by importance sampling";
        density.bound = 0.03;
        density.caption = fmt::format(
            "The integral of the density of two thirds of the width by {} samples of floats; most "
            "of "
            "the error is that of so few samples.",
            samples);
        maps.push_back(std::move(density));
        StabilityMap light = lobe_map(lobe, "small-light", resolution, samples, small_light_error);
        light.title = fmt::format("A small light in a lobe, {}", name);
        light.error = "error of radiance, of 1";
        light.bound = 5e-3;
        light.caption = fmt::format(
            "A round light of radiance 1 about the mirrored direction, 2 beta in radius, by {} "
            "lobe "
            "samples and as many of the light with the power heuristic: floats against double from "
            "the same uniform numbers. A direction of floats is good to 6e-8, and the half vector "
            "of "
            "two of them to 6e-8 over the cosine, so that a lobe of beta = 1e-5 is seen blurred "
            "towards grazing; its light is not lost.",
            samples);
        maps.push_back(std::move(light));
    }
    return maps;
}

BenchItem lobe_stability_item() {
    return {"stability-lobes", "Stability: microfacet lobes",
            "norm, sampling, densities and white furnace from beta 1e-6 to 1.5",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = options.quick ? lobe_maps(8, 1024) : lobe_maps(16, 4096);
                return result;
            }};
}

}  // namespace drude
