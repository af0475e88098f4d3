#include "report/paper_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "materials/fresnel.h"
#include "report/markup.h"
#include "report/surface_plot.h"
#include "report/svg_plot.h"

namespace drude {

namespace {

constexpr int panel_width = 560, panel_height = 360;

double ratio_from_psi(double psi_deg) {
    const double t = std::tan(psi_deg * std::numbers::pi / 180);
    return t * t;
}

double literature_ratio(const OpticalConstants& set, double wavelength_nm, double angle_deg) {
    const Index index = set.at(wavelength_nm);
    const auto r = reflect(ComplexIndex<double>{index.n, index.k},
                           std::cos(angle_deg * std::numbers::pi / 180));
    return r.Rp / r.Rs;
}

Axis wavelength_axis(const Measurement& measurement) {
    Axis axis;
    axis.label = "Vacuum wavelength (nm)";
    const std::vector<double> grid = measurement.wavelengths();
    axis.low = grid.front();
    axis.high = grid.back();
    return axis;
}

// Panels have the size of their viewBox, which the legend makes taller than the plot.
FigurePanel panel(std::string svg, std::string caption) {
    FigurePanel result{std::move(svg), std::move(caption), panel_width, panel_height};
    const size_t box = result.svg.find("viewBox=\"0 0 ");
    std::sscanf(result.svg.c_str() + box, "viewBox=\"0 0 %d %d", &result.width, &result.height);
    return result;
}

FigurePanel angles_panel(const std::string& name, const Measurement& measurement,
                         const Measurement& curve, double angle_deg, const std::string& id) {
    Plot plot;
    plot.title = fmt::format("{}, Ψ and Δ at {:g}°", name, angle_deg);
    plot.description = fmt::format(
        "Captured Psi and Delta of {} against wavelength at {:g} degrees of "
        "incidence, with the curves of the fitted model.",
        name, angle_deg);
    plot.id = id + "-angles";
    plot.height = panel_height;
    plot.x = wavelength_axis(measurement);
    plot.y.label = "degrees";
    for (const bool psi : {true, false}) {
        Series points, line;
        for (const MeasurementRow& row : measurement.rows) {
            if (row.angle_deg != angle_deg) continue;
            points.x.push_back(row.wavelength_nm);
            points.y.push_back(psi ? row.psi_deg : row.delta_deg);
        }
        for (const MeasurementRow& row : curve.rows) {
            if (row.angle_deg != angle_deg) continue;
            line.x.push_back(row.wavelength_nm);
            line.y.push_back(psi ? row.psi_deg : row.delta_deg);
        }
        points.name = psi ? "Ψ measured" : "Δ measured";
        points.mark = Mark::points;
        points.width = 1.8;
        // The paper's colours: blue and red.
        points.colour = line.colour = psi ? 0 : 1;
        line.width = 1.1;
        line.name = psi ? "Ψ fitted" : "Δ fitted";
        plot.series.push_back(std::move(line));
        plot.series.push_back(std::move(points));
    }
    return panel(svg_plot(plot), fmt::format("Points: captured at {:g}° of incidence. Lines: the "
                                             "fitted model.",
                                             angle_deg));
}

FigurePanel ratio_panel(const std::string& name, const Measurement& measurement,
                        const OpticalConstants& literature, double every_nm,
                        const std::string& id) {
    SurfacePlot plot;
    plot.title = fmt::format("{}, reflectance ratio", name);
    plot.description = fmt::format(
        "Squared reflectance ratio captured of {} over wavelength and angle of "
        "incidence, as points above the grid that {} predicts.",
        name, literature.name);
    plot.id = id + "-ratio";
    plot.height = panel_height;
    plot.x = wavelength_axis(measurement);
    plot.y.label = "θ (degrees)";
    plot.z.label = "|ρ|² = |rp/rs|²";
    const std::vector<double> angles = measurement.angles();
    if (angles.size() < 2 || *plot.x.high - *plot.x.low < 5) {
        user_error(
            "the figure of {} wants two angles of incidence and 5 nm at least; found {} and "
            "{:g} nm",
            name, angles.size(), *plot.x.high - *plot.x.low);
    }
    plot.y.low = angles.front();
    plot.y.high = angles.back();
    for (double nm = *plot.x.low; nm <= *plot.x.high; nm += 5) plot.grid_x.push_back(nm);
    constexpr int steps = 35;
    for (int i = 0; i <= steps; ++i) {
        plot.grid_y.push_back(std::lerp(*plot.y.low, *plot.y.high, i / double{steps}));
    }
    for (const double deg : plot.grid_y) {
        for (const double nm : plot.grid_x) {
            plot.grid_z.push_back(literature_ratio(literature, nm, deg));
        }
    }
    for (size_t i = 0; i < plot.grid_x.size(); i += 5) plot.lines_x.push_back(plot.grid_x[i]);
    for (size_t j = 0; j < plot.grid_y.size(); j += 5) plot.lines_y.push_back(plot.grid_y[j]);
    for (const MeasurementRow& row : measurement.rows) {
        if (std::fmod(row.wavelength_nm - *plot.x.low, every_nm) != 0) continue;
        plot.points.push_back({row.wavelength_nm, row.angle_deg, ratio_from_psi(row.psi_deg),
                               literature_ratio(literature, row.wavelength_nm, row.angle_deg)});
    }
    plot.points_name = "measured (tan²Ψ)";
    plot.grid_name = literature.name + ", Fresnel";
    return panel(surface_plot(plot),
                 fmt::format("Points: the measurement, every {:g} nm, a stem down or up to the "
                             "grid. Grid: Fresnel's ratio with n, k of {}.",
                             every_nm, literature.name));
}

FigurePanel constants_panel(const StudyMetal& metal, const std::string& id) {
    Plot plot;
    plot.title = fmt::format("{}, n and k", metal.name);
    plot.description = fmt::format(
        "Refractive index n and extinction coefficient k of {}: fitted to the captured "
        "measurement, and those of {}.",
        metal.name, metal.literature_set);
    plot.id = id + "-constants";
    plot.height = panel_height;
    plot.x = wavelength_axis(metal.measurement);
    plot.y.label = "n, k";
    for (const bool n : {true, false}) {
        Series line, points;
        line.name = fmt::format("{} {}", n ? "n" : "k", metal.literature_set);
        line.x = metal.literature.wavelength_nm;
        line.y = n ? metal.literature.n : metal.literature.k;
        line.dashed = true;
        line.width = 1.8;
        points.name = n ? "n fitted" : "k fitted";
        points.mark = Mark::points;
        points.x = metal.fitted.wavelength_nm;
        points.y = n ? metal.fitted.n : metal.fitted.k;
        points.error = n ? metal.fitted.sigma_n : metal.fitted.sigma_k;
        points.width = 1.8;
        line.colour = points.colour = n ? 0 : 1;
        plot.series.push_back(std::move(line));
        plot.series.push_back(std::move(points));
    }
    return panel(svg_plot(plot),
                 fmt::format("Points: fitted, ±1σ. Dashed: {}.", metal.literature_set));
}

const StudyMetal& metal_named(const Study& study, const std::string& folder, int number) {
    for (const StudyMetal& metal : study.metals) {
        if (metal.folder == folder) return metal;
    }
    user_error("figure {} shows {}, which this study has not", number, folder);
}

double nearest_angle(const Measurement& measurement, double wanted) {
    const std::vector<double> angles = measurement.angles();
    return *std::min_element(angles.begin(), angles.end(), [&](double a, double b) {
        return std::abs(a - wanted) < std::abs(b - wanted);
    });
}

PaperFigure metal_figure(const Study& study, int number, const std::string& folder,
                         double angle_deg) {
    const StudyMetal& metal = metal_named(study, folder, number);
    const std::string id = fmt::format("figure-{}", number);
    PaperFigure figure;
    figure.number = number;
    figure.title = fmt::format("Figure {}: {}", number, metal.name);
    figure.caption = fmt::format(
        "Figure {} of the paper with {}: Ψ and Δ at the paper's angle, |ρ|² over angle and "
        "wavelength against the literature, n and k fitted against the literature. The sample is "
        "virtual, made of {}; the literature is {}, since the paper's (Palik) may not be shipped.",
        number, metal.name, metal.sample_set, metal.literature_set);
    figure.rows = {{angles_panel(metal.name, metal.measurement, metal.fitted_curve,
                                 nearest_angle(metal.measurement, angle_deg), id),
                    ratio_panel(metal.name, metal.measurement, metal.literature, 10, id),
                    constants_panel(metal, id)}};
    return figure;
}

PaperFigure film_figure(const Study& study) {
    if (!study.film) user_error("figure 6 shows anodised aluminium, which this study has not");
    const StudyFilm& film = *study.film;
    const StudyMetal& plain = metal_named(study, "aluminium", 6);
    PaperFigure figure;
    figure.number = 6;
    figure.title = "Figure 6: anodised aluminium, and aluminium without a film";
    figure.caption = fmt::format(
        "Figure 6 of the paper: above, anodised aluminium oscillates and does not follow the bare "
        "metal; below, aluminium without its film does. Both samples are virtual: {} with a film "
        "of porous {}, and {}. The paper's lower row is a foil, whose native oxide of a few "
        "nanometres is not modelled here.",
        film.substrate_set, film.film_set, plain.sample_set);
    figure.rows = {
        {angles_panel(film.name, film.measurement, film.fitted_curve,
                      nearest_angle(film.measurement, 60), "figure-6-film"),
         ratio_panel(film.name, film.measurement, published_set(film.substrate_set), 4,
                     "figure-6-film")},
        {angles_panel(plain.name, plain.measurement, plain.fitted_curve,
                      nearest_angle(plain.measurement, 60), "figure-6-plain"),
         ratio_panel(plain.name, plain.measurement, plain.literature, 10, "figure-6-plain")}};
    return figure;
}

}  // namespace

PaperFigure paper_figure(const Study& study, int number) {
    switch (number) {
        case 5:
            return metal_figure(study, 5, "copper", 75);
        case 6:
            return film_figure(study);
        case 7:
            return metal_figure(study, 7, "gold", 60);
        case 8:
            return metal_figure(study, 8, "silver", 60);
        default:
            user_error("found figure {}, expected one of 5 to 9", number);
    }
}

std::string figure_document(const PaperFigure& figure) {
    constexpr int gap = 24;
    int width = 0, height = gap;
    std::string body;
    for (const std::vector<FigurePanel>& row : figure.rows) {
        int x = gap, tallest = 0;
        for (const FigurePanel& p : row) {
            body += fmt::format("<g transform=\"translate({} {})\">{}</g>\n", x, height, p.svg);
            x += p.width + gap;
            tallest = std::max(tallest, p.height);
        }
        width = std::max(width, x);
        height += tallest + gap;
    }
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
               "height=\"{1}\" role=\"group\" aria-labelledby=\"figure-title figure-text\">\n"
               "<title id=\"figure-title\">{2}</title>\n<desc id=\"figure-text\">{3}</desc>\n",
               width, height, escape_markup(figure.title), escape_markup(figure.caption)) +
           "<style>svg{color:#1d1f23}.sheet{fill:#fff}"
           "@media(prefers-color-scheme:dark){svg{color:#e8e6e1}.sheet{fill:#1d2025}"
           "svg *{--series-0:#4aa8e8;--series-1:#ff8a3d}}</style>\n"
           "<rect class=\"sheet\" width=\"100%\" height=\"100%\"/>\n" +
           body + "</svg>\n";
}

}  // namespace drude
