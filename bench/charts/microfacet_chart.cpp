// Chart 5: v-grooves against Smith's masking, four lobes at equal half-height angle, and the light
// that single scattering loses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/charts/bench_items.h"
#include "bench/charts/experiment.h"
#include "bench/charts/five_metals.h"
#include "bench/charts/microfacet_picture.h"
#include "bench/charts/microfacet_timing.h"

namespace drude {

namespace {

constexpr std::array<Lobe, 4> lobes = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                                       Lobe::trowbridge_reitz};

constexpr const char* half_height_label = "half-height angle of the lobe (rad)";
constexpr const char* integration =
    "A sphere under a sky of constant D65, seen by an orthographic camera, integrated by "
    "quadrature in double. The half-height angle is where the density of facets is half of that "
    "along the normal (beta of all lobes but Beckmann's). ";

// Below these the quadrature's own error shows.
constexpr double least_loss = 1e-5, least_delta_e = 1e-3;

// Beckmann's density has its largest value at normal up to beta = 0.707 only.
constexpr double last_of_beckmann = 0.8;

std::string name_of(Lobe lobe, Masking masking) {
    return fmt::format("{}, {}", lobe_name(lobe), masking_name(masking));
}

struct Cell {
    Lobe lobe;
    Masking masking;
    double half_height;
    LobeOnSphere on_sphere;
};

struct Cells {
    std::vector<double> half_heights;
    std::vector<Cell> all;
    const Cell* find(Lobe lobe, Masking masking, double half_height) const {
        for (const Cell& cell : all) {
            if (cell.lobe == lobe && cell.masking == masking && cell.half_height == half_height) {
                return &cell;
            }
        }
        return nullptr;
    }
};

Cells make_cells(bool quick) {
    Cells cells;
    cells.half_heights = quick ? std::vector<double>{0.02, 0.05, 0.2, 0.4, 0.8}
                               : std::vector<double>{0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3,
                                                     0.4,   0.5,  0.6,  0.7,  0.8, 1.0,  1.2};
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            for (const double h : cells.half_heights) {
                if (lobe == Lobe::beckmann && h > last_of_beckmann) continue;
                cells.all.push_back(
                    {lobe, masking, h,
                     LobeOnSphere(ShadowedLobe(lobe, masking, beta_at_half_height(lobe, h)))});
            }
        }
    }
    return cells;
}

// Up to where a rising curve stays below `level`, on straight lines in logarithms: "up to 0.12
// rad", "throughout", "nowhere".
std::string stays_below(const ChartCurve& curve, double level) {
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const ChartPoint& b = curve.points[i];
        if (b.error < level) continue;
        if (i == 0) return "nowhere";
        const ChartPoint& a = curve.points[i - 1];
        const double t = a.error > 0 ? std::log(level / a.error) / std::log(b.error / a.error) : 0;
        return fmt::format("up to {:.2g} rad", a.cost * std::pow(b.cost / a.cost, t));
    }
    return "throughout";
}

Chart energy_chart(const Cells& cells) {
    Chart chart;
    chart.id = "microfacet-energy";
    chart.title = "Microfacets: light that single scattering loses";
    chart.cost = half_height_label;
    chart.is_cost = false;
    chart.error = "energy lost by a sphere of perfect mirrors";
    chart.caption = std::string(integration) +
                    "Facets that reflect everything under a sky all around: what is lost is the "
                    "relative darkening of the picture; less than 1e-5 is left out. Ringed: a "
                    "conductor of which nothing but the roughness is said.";
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            ChartCurve curve{name_of(lobe, masking), {}};
            for (const double h : cells.half_heights) {
                const Cell* cell = cells.find(lobe, masking, h);
                if (!cell || cell->on_sphere.energy_lost() < least_loss) continue;
                ChartPoint point;
                point.setting = fmt::format("{:g} rad", h);
                point.cost = h;
                point.error = cell->on_sphere.energy_lost();
                point.automatic = lobe == Lobe::trowbridge_reitz && masking == Masking::smith;
                point.note =
                    fmt::format("beta {:.4g}; at the limb {:.3g}", beta_at_half_height(lobe, h),
                                1 - cell->on_sphere.albedo(sphere_rings - 1));
                curve.points.push_back(std::move(point));
            }
            chart.findings.push_back(fmt::format(
                "{}: less than 1 % is lost {}, less than 10 % {}; {:.1f} % at {:g} rad.",
                curve.method, stays_below(curve, 1e-2), stays_below(curve, 0.1),
                100 * curve.points.back().error, curve.points.back().cost));
            chart.curves.push_back(std::move(curve));
        }
    }
    return chart;
}

Chart masking_chart(const Cells& cells, const FacetReflectance& copper) {
    Chart chart;
    chart.id = "microfacet-masking";
    chart.title = "Microfacets: v-grooves instead of Smith's masking";
    chart.cost = half_height_label;
    chart.is_cost = false;
    chart.error = "mean colour difference (CIEDE2000)";
    chart.caption = std::string(integration) +
                    "Copper (Cu-McPeak) with one masking against the other; the sky is white, and "
                    "1 is about a just noticeable difference. The notes give the mean relative "
                    "difference of brightness; differences below 0.001 are left out.";
    for (const Lobe lobe : lobes) {
        ChartCurve curve{std::string(lobe_name(lobe)), {}};
        for (const double h : cells.half_heights) {
            const Cell* groove = cells.find(lobe, Masking::v_groove, h);
            const Cell* smith = cells.find(lobe, Masking::smith, h);
            if (!groove || !smith) continue;
            const SpherePicture a = rough_sphere(groove->on_sphere, copper);
            const SpherePicture b = rough_sphere(smith->on_sphere, copper);
            const PictureError error = picture_error(a, b);
            if (error.mean_delta_e < least_delta_e) continue;
            ChartPoint point;
            point.setting = fmt::format("{:g} rad", h);
            point.cost = h;
            point.error = error.mean_delta_e;
            point.note = fmt::format("brightness {:+.3g} %", 100 * (mean_Y(a) / mean_Y(b) - 1));
            curve.points.push_back(std::move(point));
        }
        chart.findings.push_back(fmt::format(
            "{}: the two maskings look alike (mean difference below 1) {}; at {:g} rad v-grooves "
            "against Smith: {}.",
            lobe_name(lobe), stays_below(curve, 1), curve.points.back().cost,
            curve.points.back().note));
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

Chart darkening_chart(const Cells& cells) {
    Chart chart;
    chart.id = "microfacet-picture";
    chart.title = "Microfacets: what the lost light does to pictures of metals";
    chart.cost = half_height_label;
    chart.is_cost = false;
    chart.error = "relative darkening of the sphere";
    chart.caption = std::string(integration) +
                    "Trowbridge-Reitz with Smith's masking; the reference adds what further "
                    "reflections bring back, as Kulla and Conty (2017) estimate it. Darkening is "
                    "of Y, averaged over the disk; the notes give the colours' difference "
                    "(CIEDE2000), of which 1 is about just noticeable.";
    for (const NamedMetal& named : five_metals()) {
        const FacetReflectance metal(dense(published_set(named.set)));
        ChartCurve curve{named.name, {}}, colour;
        for (const double h : cells.half_heights) {
            const Cell* cell = cells.find(Lobe::trowbridge_reitz, Masking::smith, h);
            const SpherePicture once = rough_sphere(cell->on_sphere, metal);
            const SpherePicture all = rough_sphere_with_all_bounces(cell->on_sphere, metal);
            const PictureError error = picture_error(once, all);
            ChartPoint point;
            point.setting = fmt::format("{:g} rad", h);
            point.cost = h;
            point.error = std::max(0.0, 1 - mean_Y(once) / mean_Y(all));
            point.automatic = true;
            point.note = fmt::format("Delta E {:.2g} on the mean, {:.2g} in the worst ring",
                                     error.mean_delta_e, error.worst_delta_e);
            colour.points.push_back(point);
            colour.points.back().error = error.mean_delta_e;
            curve.points.push_back(std::move(point));
        }
        chart.findings.push_back(fmt::format(
            "{}: less than 1 % darker {}, not to be seen (mean difference below 1) {}; at {:g} rad "
            "{:.1f} % darker.",
            named.name, stays_below(curve, 1e-2), stays_below(colour, 1), curve.points.back().cost,
            100 * curve.points.back().error));
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

Chart cost_chart(const Cells& cells, int runs) {
    Chart chart;
    chart.id = "microfacet-cost";
    chart.title = "Microfacets: time a vertex against the light that is lost";
    chart.cost = "processor time of one sample and one evaluation (ns)";
    chart.error = "energy lost by a sphere of perfect mirrors";
    chart.caption = fmt::format(
        "The six lobes of materials/microfacet.h in float: a direction sampled among "
        "visible facets, and one evaluated; random directions, medians of {} runs in "
        "shuffled order. Errors as in the chart before it.",
        runs);
    std::vector<Method> methods;
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            if (masking == Masking::smith && lobe != Lobe::beckmann &&
                lobe != Lobe::trowbridge_reitz) {
                continue;
            }
            Method method{name_of(lobe, masking), {}};
            for (const double h : {0.05, 0.2, 0.4}) {
                const Microfacets<float> microfacets(lobe, masking, beta_at_half_height(lobe, h));
                const Cell* cell = cells.find(lobe, masking, h);
                const double lost = std::max(0.0, cell->on_sphere.energy_lost());
                method.settings.push_back(
                    {fmt::format("{:g} rad", h),
                     [microfacets, lost](uint64_t seed) {
                         return Measured{vertex_ns(microfacets, seed), lost};
                     },
                     lobe == Lobe::trowbridge_reitz && masking == Masking::smith});
            }
            methods.push_back(std::move(method));
        }
    }
    chart.curves = run_shuffled(methods, runs);
    const auto mean_cost = [](const ChartCurve& curve) {
        double sum = 0;
        for (const ChartPoint& p : curve.points)
            sum += p.cost / static_cast<double>(curve.points.size());
        return sum;
    };
    const auto cheapest = std::min_element(
        chart.curves.begin(), chart.curves.end(),
        [&](const ChartCurve& a, const ChartCurve& b) { return mean_cost(a) < mean_cost(b); });
    for (const ChartCurve& curve : chart.curves) {
        chart.findings.push_back(fmt::format("{}: {:.0f} ns a vertex, {:.2f} times the cheapest.",
                                             curve.method, mean_cost(curve),
                                             mean_cost(curve) / mean_cost(*cheapest)));
    }
    return chart;
}

BenchTable albedo_table() {
    BenchTable table;
    table.id = "microfacet-albedo";
    table.caption =
        "Directional albedo of facets that reflect everything, at a half-height angle of 0.4 rad: "
        "what one reflection keeps of light from the given angle of incidence.";
    const std::vector<double> angles = {0, 30, 60, 75, 85};
    table.columns = {"lobe, masking"};
    for (const double angle : angles) table.columns.push_back(fmt::format("{:g} deg", angle));
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            const ShadowedLobe shadowed(lobe, masking, beta_at_half_height(lobe, 0.4));
            std::vector<std::string> row = {name_of(lobe, masking)};
            for (const double angle : angles) {
                row.push_back(fmt::format("{:.4f}", shadowed.albedo(std::cos(angle * degree))));
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

BenchResult run(const BenchOptions& options) {
    const Cells cells = make_cells(options.quick);
    const int runs = options.seeds > 0 ? options.seeds : options.quick ? 9 : 51;
    const FacetReflectance copper(dense(published_set("Cu-McPeak")));
    return {{energy_chart(cells), cost_chart(cells, runs), masking_chart(cells, copper),
             darkening_chart(cells)},
            {},
            {albedo_table()}};
}

}  // namespace

BenchItem microfacet_item() {
    return {"microfacet", "Microfacets: lobes, masking and lost light",
            "v-grooves against Smith, four lobes, the energy that single scattering loses", run};
}

}  // namespace drude
