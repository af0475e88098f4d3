// Fits where the data hold little: tan^2 Psi alone, angles far from the principal one, Delta next
// to 0 and 180 degrees, noise from 0 to a hundredfold, films with few fringes or few wavelengths.
//
// Here the error is the distance of the estimate from the truth in standard deviations as the fit
// states them, the worst of some seeds; a fit that is refused, or marks a parameter as at its
// bound, has said so. Inside a domain estimates are within five of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/point_fit.h"
#include "materials/porous_film.h"

namespace drude {

namespace {

constexpr double usual_psi_deg = 0.05, usual_delta_deg = 0.1;

struct Metal {
    const char* name;
    double n, k;
};
// The table of Berger, Weidlich, Wilkie & Magnor 2012, and silver of Johnson & Christy 1972.
constexpr Metal metals[] = {{"copper", 1.030, 2.460}, {"galvanised", 3.708, 4.721},
                            {"steel", 2.400, 3.699},  {"aluminium", .875, 6.233},
                            {"gold", .549, 1.810},    {"silver", .290, 3.040},
                            {"silver", .050, 3.085}};
const MapAxis metal_axis{
    "metal", {1, 2, 3, 4, 5, 6, 7}, {"Cu", "galvanised", "steel", "Al", "Au", "Ag", "Ag, Johnson"}};
const std::vector<double> paper_angles{45, 50, 60, 70, 75, 80};

Material bulk(double n, double k) {
    Material material;
    material.name = material.substrate.name = "sample";
    material.substrate.kind = "calculated";
    material.substrate.wavelength_nm = {100, 10000};
    material.substrate.n = {n, n};
    material.substrate.k = {k, k};
    return material;
}

// The noise of the data and what they state of it; `noise` over the usual.
SimulationSetup setup_of(const std::vector<double>& angles, double noise, uint64_t seed) {
    SimulationSetup setup;
    setup.angles_deg = angles;
    setup.wavelengths_nm = {550};
    setup.sigma_psi_deg = std::min(45.0, usual_psi_deg * noise);
    setup.sigma_delta_deg = std::min(45.0, usual_delta_deg * noise);
    setup.seed = seed;
    return setup;
}

FitOptions options_of(const std::string& estimator) {
    FitOptions options;
    options.estimator = estimator;
    options.threads = 1;
    return options;
}

// Throws Error (answer_is_no).
FittedPoint fitted(const Metal& metal, const std::vector<double>& angles, double noise,
                   const FitOptions& options, int seed) {
    return fit_measurement(
               simulate_ellipsometer(bulk(metal.n, metal.k),
                                     setup_of(angles, noise, static_cast<uint64_t>(seed))),
               options)
        .points.at(0);
}

// What a fit says when it has no answer, or one that it warns of.
bool is_said(const FittedPoint& point, Estimator estimator) {
    return !point.identifiable || point.at_bound || understates_errors(point, estimator) ||
           point.sigma_n > point.n || point.sigma_k > point.k;
}

// Standard deviations between the fit of a bare surface and the truth.
MapCell bulk_cell(const Metal& metal, const std::vector<double>& angles, double noise,
                  const std::string& estimator, bool inside, int seeds) {
    MapCell cell;
    cell.inside = inside;
    int said = 0;
    const FitOptions options = options_of(estimator);
    for (int seed = 1; seed <= seeds; ++seed) {
        try {
            const FittedPoint point = fitted(metal, angles, noise, options, seed);
            if (is_said(point, estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta)) {
                ++said;
                continue;
            }
            keep_worst(std::abs(point.n - metal.n) / point.sigma_n, &cell.error);
            keep_worst(std::abs(point.k - metal.k) / point.sigma_k, &cell.error);
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
            ++said;
        }
    }
    // Outside, the estimates that stand without a warning count.
    cell.refused = inside ? said > 0 : said == seeds;
    return cell;
}

// Standard deviations of n and k over their values, the larger, as the data allow them: those of
// almost exact data, scaled. Infinite where even these are refused.
double expected_vagueness(const Metal& metal, const std::vector<double>& angles, double noise,
                          const std::string& estimator) {
    constexpr double almost_exact = 1e-4;
    try {
        const FittedPoint point = fitted(metal, angles, almost_exact, options_of(estimator), 1);
        if (!point.identifiable) return HUGE_VAL;
        return std::max(point.sigma_n / metal.n, point.sigma_k / metal.k) * noise / almost_exact;
    } catch (const Error&) {
        return HUGE_VAL;
    }
}

StabilityMap fit_map(const std::string& id, const std::string& title, int seeds) {
    StabilityMap map;
    map.id = id;
    map.title = title;
    map.error = "standard deviations from the truth";
    map.bound = 5;
    map.outside = "the fit is refused with its reason, or warns that its standard deviations fail";
    map.caption = fmt::format("The worst of {} seeds.", seeds);
    return map;
}

// The domain of both estimators leaves room for the scatter of the standard deviations themselves
// up to the tenth of n and k at which a warning begins.
constexpr double most_vague = 0.05;
std::string domain_in_words(const std::string& estimator) {
    return fmt::format("where {} let n and k be known to a twentieth of their values",
                       estimator == "rho2" ? "tan^2 Psi" : "Psi and Delta");
}

StabilityMap noise_map(const std::string& estimator, int resolution, int seeds) {
    StabilityMap map =
        fit_map("fits-noise-" + estimator, fmt::format("Noise and metals, {}", estimator), seeds);
    map.caption += " Six angles from 45 to 80 degrees.";
    map.x = {"noise over 0.05 and 0.1 degrees", log_steps(1e-3, 100, resolution)};
    map.y = metal_axis;
    map.domain = domain_in_words(estimator);
    fill_map(&map, [&](double x, double y) {
        const Metal& metal = metals[static_cast<int>(y) - 1];
        return bulk_cell(metal, paper_angles, x, estimator,
                         expected_vagueness(metal, paper_angles, x, estimator) < most_vague, seeds);
    });
    return map;
}

StabilityMap angle_map(const std::string& estimator, int resolution, int seeds) {
    StabilityMap map = fit_map("fits-angles-" + estimator,
                               fmt::format("Angles of incidence, {}", estimator), seeds);
    map.caption += " Four angles, 5 degrees apart where there is room, up to the one of the axis.";
    map.x = {"largest angle of incidence (degrees)", even_steps(5, 85, resolution)};
    map.y = metal_axis;
    map.domain = domain_in_words(estimator);
    fill_map(&map, [&](double x, double y) {
        const Metal& metal = metals[static_cast<int>(y) - 1];
        const double step = std::min(5.0, x / 5);
        const std::vector<double> angles{x - 3 * step, x - 2 * step, x - step, x};
        return bulk_cell(metal, angles, 1, estimator,
                         expected_vagueness(metal, angles, 1, estimator) < most_vague, seeds);
    });
    return map;
}

// A substance that hardly absorbs: Delta is 180 degrees below Brewster's angle and 0 above.
StabilityMap delta_map(int resolution, int seeds) {
    StabilityMap map = fit_map("fits-delta", "Delta next to 0 and 180 degrees", seeds);
    map.caption += " n = 1.5, three angles 2 degrees apart about the one of the axis.";
    map.domain = domain_in_words("psi-delta");
    map.x = {"k", log_steps(1e-6, 1, resolution)};
    map.y = {"angle of incidence (degrees)", even_steps(30, 80, std::max(5, resolution / 2))};
    fill_map(&map, [&](double x, double y) {
        const Metal clear{"clear", 1.5, x};
        const std::vector<double> angles{y - 2, y, y + 2};
        return bulk_cell(clear, angles, 1, "psi-delta",
                         expected_vagueness(clear, angles, 1, "psi-delta") < most_vague, seeds);
    });
    return map;
}

constexpr double porosity = 0.15;

// Porous alumina on aluminium.
Material anodised(double thickness_nm, const std::vector<double>& wavelengths_nm) {
    Material material = material_from_set(published_set("Al-Rakic"));
    FilmLayer layer;
    layer.thickness_nm = thickness_nm;
    layer.constants = porous_constants(published_set("Al2O3-Malitson-o"), porosity, wavelengths_nm);
    layer.constants.name = "porous alumina";
    material.layers = {layer};
    return material;
}

MapCell film_cell(double thickness_nm, double noise, int wavelengths, bool inside, int seeds) {
    FitOptions options = options_of("psi-delta");
    options.model = "film";
    options.film.substrate = published_set("Al-Rakic");
    options.film.material = published_set("Al2O3-Malitson-o");
    MapCell cell;
    cell.inside = inside;
    int refused = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        SimulationSetup setup = setup_of({60, 70}, noise, static_cast<uint64_t>(seed));
        setup.wavelengths_nm = even_steps(380, 750, wavelengths);
        try {
            const FitResult fit = fit_measurement(
                simulate_ellipsometer(anodised(thickness_nm, setup.wavelengths_nm), setup),
                options);
            const FittedParameter* thickness = fit.find("thickness");
            if (thickness == nullptr || !thickness->identifiable || thickness->at_bound) {
                ++refused;
                continue;
            }
            keep_worst(std::abs(thickness->value - thickness_nm) / thickness->sigma, &cell.error);
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
            ++refused;
        }
    }
    cell.refused = inside ? refused > 0 : refused == seeds;
    return cell;
}

}  // namespace

std::vector<StabilityMap> bulk_fit_maps(int resolution, int seeds) {
    std::vector<StabilityMap> maps;
    for (const char* estimator : {"psi-delta", "rho2"}) {
        maps.push_back(noise_map(estimator, resolution, seeds));
        maps.push_back(angle_map(estimator, resolution, seeds));
    }
    maps.push_back(delta_map(resolution, seeds));
    return maps;
}

std::vector<StabilityMap> film_fit_maps(int resolution, int seeds, bool all) {
    StabilityMap noise = fit_map("fits-film", "Thickness of a film", seeds);
    noise.caption +=
        " Alumina of porosity 0.15 on aluminium, 60 and 70 degrees, 186 wavelengths from 380 to "
        "750 nm, no start given: every fringe that fits between the data is a basin of its own.";
    noise.domain = "everywhere";
    noise.x = {"thickness (nm)", log_steps(50, 6000, resolution)};
    noise.y = {"noise over 0.05 and 0.1 degrees", {1, 100}};
    if (all) noise.y.at = {0.1, 1, 10, 100};
    fill_map(&noise, [&](double x, double y) { return film_cell(x, y, 186, true, seeds); });
    StabilityMap missing = fit_map("fits-film-wavelengths", "Missing wavelengths", seeds);
    missing.caption += " The same at the usual noise with fewer wavelengths over the same range.";
    missing.domain = "everywhere";
    missing.x = {"wavelengths", {3, 12}};
    if (all) missing.x.at = {2, 3, 5, 8, 12, 20, 40, 100};
    missing.y = {"thickness (nm)", log_steps(50, 6000, resolution)};
    fill_map(&missing, [&](double x, double y) {
        const int count = static_cast<int>(x);
        return film_cell(y, 1, count, true, seeds);
    });
    return {noise, missing};
}

BenchItem fit_stability_item() {
    return {"stability-fits", "Stability: fits",
            "estimates in their own standard deviations where the data hold little",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = options.quick ? bulk_fit_maps(8, 4) : bulk_fit_maps(32, 16);
                for (StabilityMap& map :
                     options.quick ? film_fit_maps(2, 1, false) : film_fit_maps(8, 1, true)) {
                    result.maps.push_back(std::move(map));
                }
                return result;
            }};
}

}  // namespace drude
