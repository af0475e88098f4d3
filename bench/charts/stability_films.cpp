// Films from nothing to 100 micrometres, from glass to metals that let nothing through, with total
// reflection inside: the closed form in packets of floats and in double against extended precision,
// and the renderer's tables against the closed form.
//
// A phase of 2 d q/lambda turns magnifies a rounding of d, n or lambda by as much, so that errors
// are counted in last digits of the input, as in stability_fresnel.cpp. Airy's recursion holds only
// decaying exponentials: an absorbing film underflows to itself, where the transfer matrix would
// divide infinities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "bench/charts/exact_fresnel.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "materials/film_table.h"
#include "materials/packet.h"
#include "materials/surface.h"

namespace drude {

namespace {

struct Stack {
    double n, k, thickness, wavelength, cosine;
    ComplexIndex<double> substrate;
};

// As the scalar T sees it.
template <class T>
Stack rounded(const Stack& s) {
    const auto r = [](double value) { return static_cast<double>(static_cast<T>(value)); };
    return {r(s.n), r(s.k), r(s.thickness), r(s.wavelength), r(s.cosine),
            {r(s.substrate.n), r(s.substrate.k)}};
}

Reflection<Exact> exact(const Stack& s, int input = -1, double change = 1) {
    Exact value[5] = {s.n, s.k, s.thickness, s.wavelength, s.cosine};
    if (input >= 0) value[input] *= change;
    return exact_reflect({{{value[0], value[1]}, value[2]}}, {s.substrate.n, s.substrate.k},
                         std::min<Exact>(1, value[4]), value[3]);
}

template <class T>
Reflection<double> closed_form(const Stack& s) {
    const ThinFilm<T> film{{T(s.n), T(s.k)}, T(s.thickness)};
    const Reflection<T> r = reflect(&film, 1, ComplexIndex<T>{T(s.substrate.n), T(s.substrate.k)},
                                    T(s.cosine), T(s.wavelength));
    if constexpr (std::is_same_v<T, double>) {
        return r;
    } else {
        const auto lane = [](const T& p) { return static_cast<double>(p[3]); };
        return {lane(r.Rs), lane(r.Rp), lane(r.C), lane(r.S)};
    }
}

double in_digits(const Reflection<double>& found, const Stack& s, double digit) {
    const Reflection<Exact> truth = exact(s);
    double moved = digit;
    for (int input = 0; input < 5; ++input) {
        double worst = 0;
        for (const double change : {1 - digit, 1 + digit}) {
            keep_worst(largest_difference(exact(s, input, change), truth), &worst);
        }
        moved += worst;
    }
    return largest_difference(found, truth) / moved;
}

// Metals, glass, and n below 1, at which light is reflected totally inside the film.
constexpr ComplexIndex<double> substrates[] = {{0.96, 6.69}, {0.05, 3.09}, {1.5, 0}, {0.3, 0}};
constexpr double film_indices[] = {0.05, 0.3, 1, 1.5, 2.4, 4};

template <class T, class Scalar>
StabilityMap closed_form_map(const std::string& id, const std::string& what, double digit,
                             int resolution) {
    StabilityMap map;
    map.id = id;
    map.title = "Films in " + what;
    map.error = "error in last digits of the input";
    map.bound = 32;
    map.domain = "everywhere";
    map.outside = "thickness below 0 or not a number: refused when it is read";
    map.caption =
        "One film of n = 0.05 to 4 on aluminium, silver, glass and n = 0.3, 380 to 780 nm, cosines "
        "from 1e-3 to 1 and the critical one, against extended precision; the worst of them. The "
        "unit is what one unit in the last place of n, k, thickness, wavelength and cosine does. "
        "The lowest thickness stands for 0 as well.";
    map.x = {"thickness (nm)", log_steps(1e-2, 1e5, resolution)};
    map.y = {"k", log_steps(1e-6, 1e2, resolution)};
    fill_map(&map, [&](double x, double y) {
        MapCell cell;
        for (const ComplexIndex<double>& substrate : substrates) {
            for (const double n : film_indices) {
                std::vector<double> cosines = log_steps(1e-3, 1, 7);
                if (n < 1) cosines.push_back(std::sqrt((1 - n) * (1 + n)));
                for (const double cosine : cosines) {
                    for (const double wavelength : {380.0, 550.0, 780.0}) {
                        Stack s{n, y, x, wavelength, cosine, substrate};
                        if (y == map.y.at.front()) s.k = 0;
                        if (x == map.x.at.front()) s.thickness = 0;
                        s = rounded<Scalar>(s);
                        keep_worst(in_digits(closed_form<T>(s), s, digit), &cell.error);
                    }
                }
            }
        }
        return cell;
    });
    return map;
}

OpticalConstants constant(double n, double k) {
    OpticalConstants constants;
    constants.name = fmt::format("{} + {}i", n, k);
    constants.kind = "calculated";
    constants.wavelength_nm = {1, 1e6};
    constants.n = {n, n};
    constants.k = {k, k};
    return constants;
}

// What the renderer looks up, against the mean over the same nanometre in double.
MapCell table_cell(double thickness, double n, double k, int angles) {
    Material material;
    material.substrate = constant(0.05, 3.09);
    material.layers.push_back({constant(n, k), thickness});
    const FilmTable table(material, 8);
    MapCell cell;
    // What `drude render` says as a warning of the picture.
    cell.refused = table.interpolation_error() > film_table_tolerance;
    std::vector<double> cosines = log_steps(1e-3, 1, angles);
    for (const double cosine : even_steps(0.0137, 0.9913, angles)) cosines.push_back(cosine);
    if (n < 1) {
        const double critical = std::sqrt((1 - n) * (1 + n));
        for (const double step : log_steps(1e-5, 1e-2, angles)) {
            cosines.push_back(critical + step);
            cosines.push_back(critical - step);
        }
    }
    for (const double cosine : cosines) {
        const auto seen = static_cast<float>(std::min(cosine, 1.0));
        for (const int phase : {7, 31}) {
            const auto r = table.at<8>(seen, phase);
            for (const int lane : {0, 7}) {
                const Reflection<double> truth =
                    reflect(material, spectrum_first_nm + phase + lane * 50,
                            static_cast<double>(seen), 1.0);
                keep_worst(largest_difference(
                               Reflection<float>{r.Rs[lane], r.Rp[lane], r.C[lane], r.S[lane]},
                               Reflection<Exact>{truth.Rs, truth.Rp, truth.C, truth.S}),
                           &cell.error);
            }
        }
    }
    return cell;
}

StabilityMap table_map(const std::string& id, double k, const std::vector<double>& thicknesses,
                       const std::vector<double>& indices, int angles) {
    StabilityMap map;
    map.id = id;
    map.error = "largest error of a Mueller element";
    map.bound = 1e-3;
    map.caption = fmt::format(
        "FilmTable of a film of k = {} on silver (n + ik = 0.05 + 3.09i, the sharpest resonator) at "
        "four wavelengths, against the mean over each nanometre of the closed form in double; "
        "angles from grazing to normal, and densely about the critical angle.",
        k);
    map.outside =
        "`drude render` warns: the film resonates more sharply than its table shows, and by how "
        "much; films above 1e5 nm are refused with the scene";
    map.x = {"thickness (nm)", thicknesses};
    map.y = {"n of the film", indices};
    fill_map(&map, [&](double x, double y) { return table_cell(x, y, k, angles); });
    return map;
}

}  // namespace

std::vector<StabilityMap> film_maps(int resolution) {
    return {closed_form_map<Packet<8>, float>("films-float", "packets of floats", 0x1p-23,
                                              resolution),
            closed_form_map<double, double>("films-double", "double", 0x1p-52, resolution)};
}

std::vector<StabilityMap> film_table_maps(bool all) {
    std::vector<double> thicknesses{0.1, 10, 100, 1000, 5000};
    std::vector<double> indices{0.3, 0.9, 1.5, 2.4};
    if (all) {
        thicknesses = {0.1, 1, 10, 30, 100, 300, 1000, 3000, 6000, 1e4, 3e4, 1e5};
        indices = {0.3, 0.6, 0.9, 1, 1.33, 1.5, 1.77, 2.4};
    }
    const int angles = all ? 60 : 20;
    StabilityMap clear = table_map("films-table-clear", 0, thicknesses, indices, angles);
    clear.title = "Tables of clear films";
    clear.domain = "n at least 1, thickness up to 1e4 nm";
    for (size_t i = 0; i < clear.cells.size(); ++i) {
        clear.cells[i].inside = clear.y.at[i / clear.x.at.size()] >= 1 &&
                                clear.x.at[i % clear.x.at.size()] <= 1e4;
    }
    StabilityMap lossy = table_map("films-table-absorbing", 0.01, thicknesses, indices, angles);
    lossy.title = "Tables of absorbing films";
    lossy.domain = "everywhere up to 1e5 nm";
    return {clear, lossy};
}

BenchItem film_stability_item() {
    return {"stability-films", "Stability: films",
            "closed form and tables from 0 to 100 micrometres, absorbing and totally reflecting",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = film_maps(options.quick ? 6 : 24);
                for (StabilityMap& map : film_table_maps(!options.quick)) {
                    result.maps.push_back(std::move(map));
                }
                return result;
            }};
}

}  // namespace drude
