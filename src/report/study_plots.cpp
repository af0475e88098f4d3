#include "report/study_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/svg_plot.h"

namespace drude {

namespace {

Axis wavelength_axis(const StudyMetal& metal) {
    Axis axis;
    axis.label = "Vacuum wavelength (nm)";
    const std::vector<double>& grid = metal.fitted.wavelength_nm;
    if (!grid.empty()) {
        axis.low = grid.front();
        axis.high = grid.back();
    }
    return axis;
}

// Rows of one angle of incidence, in the order of the file.
void fill(Series& series, const Measurement& measurement, double angle_deg, bool psi, bool errors) {
    for (const MeasurementRow& row : measurement.rows) {
        if (row.angle_deg != angle_deg) continue;
        series.x.push_back(row.wavelength_nm);
        series.y.push_back(psi ? row.psi_deg : row.delta_deg);
        if (errors) series.error.push_back(psi ? row.sigma_psi_deg : row.sigma_delta_deg);
    }
}

}  // namespace

std::string ellipsometry_plot(const StudyMetal& metal, EllipsometricAngle angle) {
    const bool psi = angle == EllipsometricAngle::psi;
    const std::string symbol = psi ? "Ψ" : "Δ";
    const bool curve = !metal.fitted_curve.rows.empty();
    Plot plot;
    plot.title = fmt::format("{}, {} at each angle of incidence", metal.name, symbol);
    plot.description = fmt::format(
        "{} in degrees of the simulated measurement of {} against wavelength, one series an angle "
        "of incidence{}.",
        symbol, metal.name, curve ? ", with the curve of the fitted model through each" : "");
    plot.id = fmt::format("{}-{}", metal.name, psi ? "psi" : "delta");
    plot.x = wavelength_axis(metal);
    plot.y.label = symbol + " (degrees)";
    int colour = 0;
    for (const double incidence : metal.measurement.angles()) {
        if (curve) {
            Series line;
            fill(line, metal.fitted_curve, incidence, psi, false);
            line.colour = colour;
            line.width = 1.1;
            plot.series.push_back(std::move(line));
        }
        Series points;
        points.name = fmt::format("{:g}°", incidence);
        points.mark = Mark::points;
        fill(points, metal.measurement, incidence, psi, metal.measurement.has_sigma());
        points.colour = colour++;
        points.width = 1.7;
        plot.series.push_back(std::move(points));
    }
    return svg_plot(plot);
}

std::string constants_plot(const StudyMetal& metal, ConstantKind kind) {
    const bool n = kind == ConstantKind::n;
    const std::string symbol = n ? "n" : "k";
    Plot plot;
    plot.title =
        fmt::format("{}, {}", metal.name, n ? "refractive index n" : "extinction coefficient k");
    plot.description = fmt::format(
        "{} of {} against wavelength: fitted to the simulated measurement, with one standard "
        "deviation, over {} published sets.",
        symbol, metal.name, metal.published.size());
    plot.id = fmt::format("{}-{}", metal.name, symbol);
    plot.x = wavelength_axis(metal);
    plot.y.label = symbol;

    // The envelope over those sets that cover a wavelength.
    Band envelope;
    envelope.name = "literature envelope";
    envelope.colour = 7;
    for (const double nm : metal.fitted.wavelength_nm) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const OpticalConstants& set : metal.published) {
            if (!set.covers(nm, nm)) continue;
            const Index at = set.at(nm);
            low = std::min(low, n ? at.n : at.k);
            high = std::max(high, n ? at.n : at.k);
        }
        envelope.x.push_back(nm);
        envelope.low.push_back(low);
        envelope.high.push_back(high);
    }
    plot.bands.push_back(std::move(envelope));

    // The literature first, so that the fit lies on top; the pair that is compared in strong lines.
    int colour = 2;
    for (const OpticalConstants& set : metal.published) {
        Series line;
        const bool is_sample = set.name == metal.sample_set;
        const bool is_literature = set.name == metal.literature_set;
        line.name = set.name + (is_sample ? " (sample)" : is_literature ? " (compared)" : "");
        line.x = set.wavelength_nm;
        line.y = n ? set.n : set.k;
        if (is_literature) {
            line.colour = 0;
            line.width = 2.6;
        } else if (is_sample) {
            line.colour = 7;
            line.width = 6;
            line.opacity = 0.45;
        } else {
            // Six colours, then the same ones dashed.
            line.colour = 2 + (colour - 2) % 5;
            line.dashed = colour >= 7;
            line.width = 1.2;
            ++colour;
        }
        plot.series.push_back(std::move(line));
    }
    Series fitted;
    fitted.name = "fitted, ±1σ";
    fitted.mark = Mark::points;
    fitted.x = metal.fitted.wavelength_nm;
    fitted.y = n ? metal.fitted.n : metal.fitted.k;
    fitted.error = n ? metal.fitted.sigma_n : metal.fitted.sigma_k;
    fitted.colour = 1;
    fitted.width = 1.9;
    plot.series.push_back(std::move(fitted));
    return svg_plot(plot);
}

}  // namespace drude
