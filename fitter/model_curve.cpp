#include "fitter/model_curve.h"

#include <algorithm>
#include <cmath>

#include "materials/measurement_noise.h"
#include "materials/surface.h"

namespace drude {

namespace {

constexpr double degree = pi / 180;

double angle_offset_deg(const FitResult& fit) {
    for (const FittedParameter& parameter : fit.common) {
        if (parameter.name == "angle offset" && parameter.identifiable) return parameter.value;
    }
    return 0;
}

const FittedPoint* point_at(const FitResult& fit, double wavelength_nm) {
    const auto found = std::lower_bound(
        fit.points.begin(), fit.points.end(), wavelength_nm,
        [](const FittedPoint& point, double nm) { return point.wavelength_nm < nm; });
    const bool there =
        found != fit.points.end() && found->wavelength_nm == wavelength_nm && found->identifiable;
    return there ? &*found : nullptr;
}

}  // namespace

Measurement model_curve(const FitResult& fit, const Measurement& measurement) {
    Measurement curve;
    curve.file = measurement.file;
    const double offset_deg = angle_offset_deg(fit);
    for (MeasurementRow row : measurement.rows) {
        const FittedPoint* point = point_at(fit, row.wavelength_nm);
        if (!point) continue;
        std::vector<ThinFilm<double>> films;
        for (const FilmLayer& layer : fit.layers) {
            const Index index = layer.constants.at(row.wavelength_nm);
            films.push_back({{index.n, index.k}, layer.thickness_nm});
        }
        ComplexIndex<double> below{point->n, point->k};
        if (!fit.substrate.wavelength_nm.empty()) {
            const Index index = fit.substrate.at(row.wavelength_nm);
            below = {index.n, index.k};
        }
        const double cos_theta = std::cos((row.angle_deg + offset_deg) * degree);
        const Reflection<double> r = reflect(films.data(), static_cast<int>(films.size()), below,
                                             cos_theta, row.wavelength_nm);
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
    if (options.model != "auto") return taken;
    taken.model = fit.model;
    if (fit.model != "overlayer") taken.overlayers.clear();
    if (fit.model != "film") taken.film.substrate = {};
    taken.fit_angle_offset =
        std::any_of(fit.common.begin(), fit.common.end(),
                    [](const FittedParameter& p) { return p.name == "angle offset"; });
    return taken;
}

}  // namespace drude
