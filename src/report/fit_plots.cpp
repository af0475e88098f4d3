#include "report/fit_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fitter/model_curve.h"
#include "fitter/row_residuals.h"
#include "report/svg_plot.h"

namespace drude {

namespace {

constexpr int fit_colour = 1, envelope_colour = 7;

Axis wavelength_axis(const FitReport& report) {
    Axis axis;
    axis.label = "Vacuum wavelength (nm)";
    const std::vector<FittedPoint>& points = report.fit.points;
    if (points.size() > 1) {
        axis.low = points.front().wavelength_nm;
        axis.high = points.back().wavelength_nm;
    }
    return axis;
}

// Long names of samples would run out of the picture.
std::string titled(const FitReport& report, const std::string& what) {
    constexpr size_t longest = 28;
    return report.name.size() > longest ? what : report.name + ", " + what;
}

bool by_wavelength(const MeasurementRow& a, const MeasurementRow& b) {
    return a.wavelength_nm < b.wavelength_nm;
}

// The rows of one angle of incidence that were fitted.
std::vector<MeasurementRow> rows_at(const Measurement& measurement, double angle_deg,
                                    const FitOptions& options) {
    std::vector<MeasurementRow> rows;
    for (const MeasurementRow& row : measurement.rows) {
        const bool fitted =
            row.wavelength_nm >= options.first_nm && row.wavelength_nm <= options.last_nm;
        if (fitted && row.angle_deg == angle_deg) rows.push_back(row);
    }
    std::sort(rows.begin(), rows.end(), by_wavelength);
    return rows;
}

// Whole turns that bring `delta_deg` nearest to `to_deg`.
double near(double delta_deg, double to_deg) {
    return delta_deg + 360 * std::round((to_deg - delta_deg) / 360);
}

// No row is further than half a turn from the one before it, and the model from neither.
void unwrap(std::vector<MeasurementRow>* data, std::vector<MeasurementRow>* model) {
    for (size_t i = 1; i < data->size(); ++i) {
        (*data)[i].delta_deg = near((*data)[i].delta_deg, (*data)[i - 1].delta_deg);
    }
    for (MeasurementRow& row : *model) {
        const auto same = std::lower_bound(data->begin(), data->end(), row, by_wavelength);
        if (same != data->end()) row.delta_deg = near(row.delta_deg, same->delta_deg);
    }
}

FitFigure angle_figure(const FitReport& report, const Measurement& curve, bool psi) {
    const std::string symbol = psi ? "Ψ" : "Δ";
    Plot plot;
    plot.title = titled(report, symbol + ": data and model");
    plot.description = fmt::format(
        "{} in degrees against wavelength, one colour an angle of incidence: points as measured "
        "with one standard deviation, lines of the fitted model.",
        symbol);
    plot.id = report.name + (psi ? " psi" : " delta");
    plot.x = wavelength_axis(report);
    plot.y.label = symbol + " (degrees)";
    int colour = 0;
    for (const double angle : report.measurement.angles()) {
        std::vector<MeasurementRow> data = rows_at(report.measurement, angle, report.options);
        std::vector<MeasurementRow> model = rows_at(curve, angle, report.options);
        unwrap(&data, &model);
        Series points, line;
        points.name = fmt::format("{:g}°", angle);
        points.mark = Mark::points;
        points.colour = line.colour = colour++ % 8;
        // A dense spectrum stays a spectrum.
        points.width = data.size() > 150 ? 1.1 : 1.7;
        line.width = 1.1;
        const auto value = [&](const MeasurementRow& row) {
            return psi ? row.psi_deg : row.delta_deg;
        };
        for (const MeasurementRow& row : data) {
            points.x.push_back(row.wavelength_nm);
            points.y.push_back(value(row));
            points.error.push_back(psi ? row.sigma_psi_deg : row.sigma_delta_deg);
        }
        for (const MeasurementRow& row : model) {
            line.x.push_back(row.wavelength_nm);
            line.y.push_back(value(row));
        }
        plot.series.push_back(std::move(points));
        plot.series.push_back(std::move(line));
    }
    std::string caption = "Points: measured. Lines: the fitted model.";
    if (!psi && report.fit.estimator == "rho2") {
        caption += " The fit used tan²Ψ alone; this Δ is a prediction.";
    }
    return {psi ? "psi" : "delta", svg_plot(plot), caption};
}

FitFigure residual_figure(const FitReport& report, const std::vector<RowResidual>& residuals,
                          bool psi) {
    const bool rho2 = report.fit.estimator == "rho2";
    const std::string symbol = rho2 ? "tan²Ψ" : psi ? "Ψ" : "Δ";
    Plot plot;
    plot.title = titled(report, "residuals of " + symbol);
    plot.description = fmt::format(
        "Model minus measurement of {} in standard deviations against wavelength, one colour an "
        "angle of incidence, with a band of two standard deviations.",
        symbol);
    plot.id = fmt::format("{} residuals {}", report.name, rho2 ? "tan2psi" : psi ? "psi" : "delta");
    plot.x = wavelength_axis(report);
    plot.y.label =
        fmt::format("{}, model − data ({})", symbol, report.options.unweighted ? "degrees" : "σ");
    if (!report.options.unweighted && report.fit.points.size() > 1) {
        const std::vector<double> ends = {report.fit.points.front().wavelength_nm,
                                          report.fit.points.back().wavelength_nm};
        plot.bands.push_back({"±2σ", ends, {-2, -2}, {2, 2}, envelope_colour});
    }
    int colour = 0;
    for (const double angle : report.measurement.angles()) {
        Series points;
        points.name = fmt::format("{:g}°", angle);
        points.mark = Mark::points;
        points.colour = colour++ % 8;
        points.width = residuals.size() > 900 ? 1.1 : 1.7;
        for (size_t i = 0; i < residuals.size(); ++i) {
            const MeasurementRow& row = report.measurement.rows[i];
            if (row.angle_deg != angle) continue;
            points.x.push_back(row.wavelength_nm);
            points.y.push_back(psi ? residuals[i].psi : residuals[i].delta);
        }
        plot.series.push_back(std::move(points));
    }
    const std::string name = rho2 ? "residuals_tan2psi" : psi ? "residuals_psi" : "residuals_delta";
    return {name, svg_plot(plot),
            report.options.unweighted
                ? "What the model leaves of the data."
                : "What the model leaves of the data: 19 of 20 points lie in the band where model "
                  "and standard deviations are right."};
}

void add_bands(const OpticalConstants& fitted, bool n, Plot* plot) {
    const std::vector<double>& values = n ? fitted.n : fitted.k;
    const std::vector<double>& sigmas = n ? fitted.sigma_n : fitted.sigma_k;
    for (const int widths : {2, 1}) {
        Band band;
        band.name = fmt::format("±{}σ", widths);
        band.colour = fit_colour;
        band.x = fitted.wavelength_nm;
        for (size_t i = 0; i < values.size(); ++i) {
            band.low.push_back(values[i] - widths * sigmas[i]);
            band.high.push_back(values[i] + widths * sigmas[i]);
        }
        plot->bands.push_back(std::move(band));
    }
}

// The heights to show: all values, and of the bands no more than a few times what is usual, so that
// one wavelength that is hardly known does not flatten the rest.
void set_heights(const OpticalConstants& fitted, bool n, Plot* plot) {
    const std::vector<double>& values = n ? fitted.n : fitted.k;
    std::vector<double> sigmas = n ? fitted.sigma_n : fitted.sigma_k;
    if (values.size() < 3) return;
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    const double widest = 6 * *middle;
    double low = values[0], high = values[0], band_low = low, band_high = high;
    for (size_t i = 0; i < values.size(); ++i) {
        const double wide = 2 * (n ? fitted.sigma_n : fitted.sigma_k)[i];
        band_low = std::min(band_low, values[i] - wide);
        band_high = std::max(band_high, values[i] + wide);
        low = std::min(low, values[i] - std::min(wide, widest));
        high = std::max(high, values[i] + std::min(wide, widest));
    }
    if (band_high - band_low < 1.5 * (high - low)) return;
    for (const Band& band : plot->bands) {
        if (band.colour != envelope_colour) continue;
        for (size_t i = 0; i < band.x.size(); ++i) {
            // Passing over NaN.
            low = std::fmin(low, band.low[i]);
            high = std::fmax(high, band.high[i]);
        }
    }
    plot->y.low = low;
    plot->y.high = high;
}

void add_literature(const LiteratureComparison& literature, bool n, Plot* plot) {
    const LiteratureEnvelope& envelope = literature.envelope;
    if (literature.sets.size() > 1) {
        plot->bands.push_back({"published, all", envelope.wavelength_nm,
                               n ? envelope.n_low : envelope.k_low,
                               n ? envelope.n_high : envelope.k_high, envelope_colour});
    }
    // Six colours beside the fit's and the envelope's, then the same ones dashed.
    constexpr int colours[] = {0, 2, 3, 5, 4, 6};
    for (size_t i = 0; i < literature.sets.size(); ++i) {
        const OpticalConstants& set = published_set(literature.sets[i].name);
        Series line;
        line.name = set.name + (i == 0 ? " (nearest)" : "");
        line.x = set.wavelength_nm;
        line.y = n ? set.n : set.k;
        line.colour = colours[i % 6];
        line.dashed = i >= 6;
        line.width = i == 0 ? 2.2 : 1.1;
        plot->series.push_back(std::move(line));
    }
}

FitFigure constants_figure(const FitReport& report, bool n) {
    const OpticalConstants fitted = report.fit.constants();
    Plot plot;
    plot.title = titled(report, n ? "refractive index n" : "extinction coefficient k");
    plot.description = fmt::format(
        "{} against wavelength: fitted, with bands of one and two standard deviations, over what "
        "is published.",
        n ? "n" : "k");
    plot.id = report.name + (n ? " n" : " k");
    plot.x = wavelength_axis(report);
    plot.y.label = n ? "n" : "k";
    if (report.literature) add_literature(*report.literature, n, &plot);
    add_bands(fitted, n, &plot);
    set_heights(fitted, n, &plot);
    Series points;
    points.name = "fitted";
    points.mark = Mark::points;
    points.x = fitted.wavelength_nm;
    points.y = n ? fitted.n : fitted.k;
    // The bands say the same where there are any.
    if (fitted.n.size() < 3) points.error = n ? fitted.sigma_n : fitted.sigma_k;
    points.colour = fit_colour;
    points.width = fitted.n.size() > 150 ? 1.1 : 1.7;
    plot.series.push_back(std::move(points));
    std::string caption = "Points and bands: fitted, with one and two standard deviations.";
    if (report.literature && !report.literature->sets.empty()) {
        caption += fmt::format(" Lines and grey band: what is published of {}.",
                               report.literature->material);
    }
    return {n ? "n" : "k", svg_plot(plot), caption};
}

}  // namespace

std::vector<FitFigure> data_figures(const FitReport& report) {
    const Measurement curve = model_curve(report.fit, report.measurement);
    const auto residuals = row_residuals(report.fit, report.measurement, report.options);
    std::vector<FitFigure> figures = {angle_figure(report, curve, true),
                                      angle_figure(report, curve, false),
                                      residual_figure(report, residuals, true)};
    if (report.fit.estimator != "rho2") {
        figures.push_back(residual_figure(report, residuals, false));
    }
    return figures;
}

std::vector<FitFigure> constants_figures(const FitReport& report) {
    return {constants_figure(report, true), constants_figure(report, false)};
}

}  // namespace drude
