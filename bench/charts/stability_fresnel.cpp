// Fresnel's equations in packets of floats against extended precision: grazing angles, indices that
// vanish, equal 1 or are huge, critical and Brewster's angles.
//
// Two measures. The plain one is the largest error of the four distinct elements of the Mueller
// matrix. It cannot be small everywhere: at a critical angle q = sqrt(n^2 - sin^2) turns a rounding
// u = 2^-24 of n or of the cosine into sqrt(2u) = 3e-4 of q. The other counts in last digits of the
// input: it divides by what the matrix changes by where n, k and the cosine, each in turn, move by
// one unit in the last place of a float, plus one such unit for the result itself. A method that
// keeps this within a few is as good as its input allows (Higham 2002, section 1.6).
#include <algorithm>
#include <cmath>

#include "bench/charts/bench_items.h"
#include "bench/charts/exact_fresnel.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/packet.h"

namespace drude {

namespace {

constexpr double float_digit = 0x1p-23, double_digit = 0x1p-52;

// As the renderer takes them: already rounded to float.
struct Incidence {
    float n, k, cosine;
};

Reflection<double> fast(const Incidence& at) {
    using P = Packet<8>;
    const Reflection<P> r = reflect(ComplexIndex<P>{P(at.n), P(at.k)}, P(at.cosine));
    const auto lane = [](const P& p) { return static_cast<double>(p[3]); };
    return {lane(r.Rs), lane(r.Rp), lane(r.C), lane(r.S)};
}

// What one unit in the last place of n, of k and of the cosine does to the matrix, and of itself.
double last_digits(Exact n, Exact k, Exact cosine, double digit) {
    const Reflection<Exact> exact = exact_reflect(n, k, cosine);
    double total = digit;
    for (int input = 0; input < 3; ++input) {
        double worst = 0;
        for (const double change : {1 - digit, 1 + digit}) {
            const Exact moved_n = input == 0 ? n * change : n,
                        moved_k = input == 1 ? k * change : k;
            const Exact moved = input == 2 ? std::min<Exact>(1, cosine * change) : cosine;
            keep_worst(largest_difference(exact_reflect(moved_n, moved_k, moved), exact), &worst);
        }
        total += worst;
    }
    return total;
}

double plain_error(const Incidence& at) {
    return largest_difference(fast(at), exact_reflect(at.n, at.k, at.cosine));
}
double error_in_digits(const Incidence& at) {
    return plain_error(at) / last_digits(at.n, at.k, at.cosine, float_digit);
}

float cosine_of(double from_grazing_deg) {
    return static_cast<float>(std::sin(from_grazing_deg * degree));
}

// Angles at which things happen, beside a sweep: both ends, the critical angle (n < 1), Brewster's
// or the pseudo-Brewster angle, where |u| = |q cos|.
std::vector<float> telling_cosines(double n, double k, int resolution) {
    std::vector<float> cosines{1.0f, 1e-6f, 1e-4f};
    for (const double angle : even_steps(0.01, 89.99, resolution)) {
        cosines.push_back(cosine_of(angle));
    }
    if (n < 1) cosines.push_back(static_cast<float>(std::sqrt((1 - n) * (1 + n))));
    const double size = std::hypot(n, k);
    cosines.push_back(static_cast<float>(1 / std::hypot(1.0, size)));
    return cosines;
}

// Cells over n and k: the worst of the telling angles.
void fill_with_worst_over_angles(int resolution, StabilityMap* map) {
    fill_map(map, [&](double n, double k) {
        MapCell cell;
        for (const float cosine : telling_cosines(n, k, resolution)) {
            keep_worst(plain_error({static_cast<float>(n), static_cast<float>(k), cosine}),
                       &cell.error);
        }
        return cell;
    });
}

StabilityMap grazing_map(int resolution) {
    StabilityMap map;
    map.id = "fresnel-grazing";
    map.title = "Fresnel towards grazing incidence";
    map.error = "error in last digits of the input";
    map.bound = 8;
    map.domain = "everywhere";
    map.outside = "n = 0, k < 0, indices above 1e6, NaN: refused when they are read";
    map.caption =
        "Packets of floats against extended precision; each cell is the worst of k = 0 and k from "
        "1e-6 to 100. The unit is what one unit in the last place of n, k and cosine does.";
    map.x = {"90 - angle of incidence (degrees)", log_steps(1e-4, 89.99, resolution)};
    map.y = {"n", log_steps(1e-3, 1e2, resolution)};
    map.y.at.push_back(1);
    std::sort(map.y.at.begin(), map.y.at.end());
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        std::vector<double> absorptions = log_steps(1e-6, 1e2, resolution);
        absorptions.push_back(0);
        for (const double k : absorptions) {
            const Incidence at{static_cast<float>(y), static_cast<float>(k), cosine_of(x)};
            keep_worst(error_in_digits(at), &cell.error);
        }
        return cell;
    });
    return map;
}

StabilityMap index_map(int resolution) {
    StabilityMap map;
    map.id = "fresnel-index";
    map.title = "Fresnel over n and k";
    map.error = "largest error of a Mueller element";
    map.bound = 2e-3;
    map.domain = "everywhere";
    map.outside = "n = 0, k < 0, indices above 1e6, NaN: refused when they are read";
    map.caption =
        "Each cell is the worst over the angles of incidence, grazing, critical and Brewster's "
        "among "
        "them. The bound is that of a critical angle, 4 sqrt(2u) for a rounding u = 2^-24 of n or "
        "the cosine; away from it the error is that of map fresnel-metals.";
    map.x = {"n", log_steps(1e-3, 1e2, resolution)};
    map.y = {"k", log_steps(1e-6, 1e2, resolution)};
    fill_with_worst_over_angles(resolution, &map);
    return map;
}

StabilityMap metals_map(int resolution) {
    StabilityMap map;
    map.id = "fresnel-metals";
    map.title = "Fresnel of metals";
    map.error = "largest error of a Mueller element";
    map.bound = 1e-6;
    map.domain = "k from 0.05 to 100, n from 1e-3 to 100, all angles";
    map.outside = "k below 0.05: map fresnel-index";
    map.caption =
        "Absorption keeps |q| away from 0, so that no root makes a rounding larger; each cell is "
        "the "
        "worst over the angles.";
    map.x = {"n", log_steps(1e-3, 1e2, resolution)};
    map.y = {"k", log_steps(0.05, 1e2, resolution)};
    fill_with_worst_over_angles(resolution, &map);
    return map;
}

StabilityMap index_one_map(int resolution) {
    StabilityMap map;
    map.id = "fresnel-index-one";
    map.title = "A medium of index 1";
    map.error = "largest error of a Mueller element";
    map.bound = 1e-6;
    map.domain = "n = 1, all k and angles";
    map.outside = "nothing is: Psi and Delta of k = 0 are not given (`drude eval` prints -)";
    map.caption =
        "n = 1 exactly: without absorption nothing is reflected, however close to grazing; the "
        "lowest row is the worse of its k and of k = 0.";
    map.x = {"90 - angle of incidence (degrees)", log_steps(1e-4, 89.99, resolution)};
    map.y = {"k", log_steps(1e-10, 1, resolution)};
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        cell.error = plain_error({1.0f, static_cast<float>(y), cosine_of(x)});
        if (y == map.y.at.front()) keep_worst(plain_error({1.0f, 0.0f, cosine_of(x)}), &cell.error);
        return cell;
    });
    return map;
}

// Psi and Delta as `drude eval` and the fits have them, in double.
StabilityMap brewster_map(int resolution) {
    StabilityMap map;
    map.id = "fresnel-brewster";
    map.title = "Delta at Brewster's angle";
    map.error = "error of Delta in last digits of the input";
    map.bound = 4;
    map.domain = "k from 1e-9 to 10, n = 1.5, on both sides of the angle";
    map.outside =
        "k = 0 at Brewster's angle itself: r_p = 0 and Delta jumps by 180 degrees; Psi = 0 says so";
    map.caption =
        "Double against extended precision. r_p passes 0 at a distance of about k, and Delta "
        "falls from 180 to 0 degrees within as much. Positive x: above the angle.";
    std::vector<double> offsets;
    for (const double step : log_steps(1e-9, 20, (resolution + 1) / 2)) {
        offsets.push_back(step);
        offsets.push_back(-step);
    }
    offsets.push_back(0);
    std::sort(offsets.begin(), offsets.end());
    map.x = {"angle of incidence - Brewster's (degrees)", offsets};
    map.y = {"k", log_steps(1e-9, 10, resolution)};
    constexpr double n = 1.5;
    fill_map(&map, [&](double x, double y) {
        const double cosine = std::cos(std::atan(n) + x * degree);
        const auto phase = [](const Reflection<Exact>& r) { return std::atan2(r.S, r.C); };
        const Exact exact = phase(exact_reflect(n, y, cosine));
        double moved = double_digit;
        for (int input = 0; input < 3; ++input) {
            const Exact change = 1 + Exact(double_digit);
            moved += static_cast<double>(std::abs(
                phase(exact_reflect(input == 0 ? n * change : n, input == 1 ? y * change : y,
                                    input == 2 ? cosine * change : cosine)) -
                exact));
        }
        MapCell cell;
        const double found = delta(reflect(ComplexIndex<double>{n, y}, cosine));
        cell.error = static_cast<double>(std::abs(found - exact)) / moved;
        return cell;
    });
    return map;
}

}  // namespace

std::vector<StabilityMap> fresnel_maps(int resolution) {
    return {grazing_map(resolution), index_map(resolution), metals_map(resolution),
            index_one_map(resolution), brewster_map(resolution)};
}

BenchItem fresnel_stability_item() {
    return {"stability-fresnel", "Stability: Fresnel's equations",
            "packets of floats against extended precision where reflectances vanish or jump",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = fresnel_maps(options.quick ? 12 : 48);
                return result;
            }};
}

}  // namespace drude
