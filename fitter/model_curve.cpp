#include "fitter/model_curve.h"

#include <algorithm>
#include <cmath>

#include "fitter/film_average.h"
#include "materials/measurement_noise.h"
#include "materials/surface.h"

namespace drude {

namespace {

double angle_offset_deg(const FitResult& fit) {
    const FittedParameter* offset = fit.find("angle offset");
    return offset && offset->identifiable ? offset->value : 0;
}

const FittedPoint* point_at(const FitResult& fit, double wavelength_nm) {
    const auto found = std::lower_bound(
        fit.points.begin(), fit.points.end(), wavelength_nm,
        [](const FittedPoint& point, double nm) { return point.wavelength_nm < nm; });
    const bool there =
        found != fit.points.end() && found->wavelength_nm == wavelength_nm && found->identifiable;
    return there ? &*found : nullptr;
}

Reflection<double> reflection(const FitResult& fit, const FittedPoint& point, double wavelength_nm,
                              double thicker_nm, double cos_theta) {
    std::vector<ThinFilm<double>> films;
    for (const FilmLayer& layer : fit.layers) {
        const Index index = layer.constants.at(wavelength_nm);
        films.push_back({{index.n, index.k}, layer.thickness_nm});
    }
    ComplexIndex<double> below{point.n, point.k};
    if (!fit.substrate.wavelength_nm.empty()) {
        const Index index = fit.substrate.at(wavelength_nm);
        below = {index.n, index.k};
        // The film is the last of the layers: roughness lies above it.
        films.back().thickness = std::max(films.back().thickness + thicker_nm, 0.0);
    }
    return reflect(films.data(), static_cast<int>(films.size()), below, cos_theta, wavelength_nm);
}

// The slit and the thicknesses of a film.
struct Spreads {
    AverageNodes slit{{0}, {1}}, thickness{{0}, {1}};
};

Spreads spreads_of(const FitResult& fit) {
    Spreads spreads;
    if (fit.bandwidth_nm > 0) spreads.slit = gaussian_nodes(largest_phase_spread);
    if (fit.thickness_spread_nm > 0) spreads.thickness = gaussian_nodes(largest_phase_spread);
    return spreads;
}

Reflection<double> averaged(const FitResult& fit, const Spreads& over, const FittedPoint& point,
                            double cos_theta) {
    Reflection<double> sum{0, 0, 0, 0};
    for (size_t i = 0; i < over.slit.x.size(); ++i) {
        const double nm = point.wavelength_nm + gaussian_sigma(fit.bandwidth_nm) * over.slit.x[i];
        for (size_t j = 0; j < over.thickness.x.size(); ++j) {
            add_weighted(reflection(fit, point, nm, fit.thickness_spread_nm * over.thickness.x[j],
                                    cos_theta),
                         over.slit.weight[i] * over.thickness.weight[j], &sum);
        }
    }
    return sum;
}

}  // namespace

Measurement model_curve(const FitResult& fit, const Measurement& measurement) {
    Measurement curve;
    curve.file = measurement.file;
    const double offset_deg = angle_offset_deg(fit);
    const Spreads spreads = spreads_of(fit);
    for (MeasurementRow row : measurement.rows) {
        const FittedPoint* point = point_at(fit, row.wavelength_nm);
        if (!point) continue;
        const double cos_theta = std::cos((row.angle_deg + offset_deg) * degree);
        const Reflection<double> r = averaged(fit, spreads, *point, cos_theta);
        if (!has_angles(r)) continue;
        row.psi_deg = psi(r) / degree;
        row.delta_deg = delta(r) / degree;
        row.depolarization = -1;
        add_noise(&row, 0, 0);  // into the windows of both angles
        curve.rows.push_back(row);
    }
    return curve;
}

FitOptions options_taken(const FitOptions& options, const FitResult& fit) {
    FitOptions taken = options;
    // The same formula, from where the fit ended: another order of its terms is the same curve.
    taken.dispersion = fit.dispersion;
    taken.dispersion_start = fit.dispersion_parameters;
    if (options.model != "auto") return taken;
    taken.model = fit.model;
    if (fit.model != "overlayer") taken.overlayers.clear();
    if (fit.model != "film") taken.film.substrate = {};
    taken.fit_angle_offset = fit.find("angle offset") != nullptr;
    taken.film.spread_nm = fit.find("thickness spread")
                               ? KnownOrFitted{0, true}
                               : KnownOrFitted{fit.thickness_spread_nm, false};
    taken.film.bandwidth_nm = fit.bandwidth_nm;
    if (fit.model != "film") taken.roughness_nm.fitted = false;
    return taken;
}

}  // namespace drude
