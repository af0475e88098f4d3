#include "fitter/row_residuals.h"

#include <cmath>
#include <map>
#include <utility>

#include "fitter/fit_data.h"
#include "fitter/model_curve.h"
#include "fitter/residuals.h"

namespace drude {

namespace {

// A surface of this Psi and Delta; how much it reflects does not enter a residual.
Reflection<double> reflection_of(const MeasurementRow& row) {
    const double c = std::cos(row.psi_deg * degree), s = std::sin(row.psi_deg * degree);
    Reflection<double> r;
    r.Rs = c * c;
    r.Rp = s * s;
    r.C = s * c * std::cos(row.delta_deg * degree);
    r.S = s * c * std::sin(row.delta_deg * degree);
    return r;
}

}  // namespace

std::vector<RowResidual> row_residuals(const FitResult& fit, const Measurement& measurement,
                                       const FitOptions& options) {
    const bool rho2 = fit.estimator == "rho2";
    const Measurement curve = model_curve(fit, measurement);
    std::map<std::pair<double, double>, const MeasurementRow*> predicted;
    for (const MeasurementRow& row : curve.rows) {
        predicted[{row.wavelength_nm, row.angle_deg}] = &row;
    }
    std::vector<RowResidual> residuals(measurement.rows.size());
    for (size_t i = 0; i < residuals.size(); ++i) {
        const MeasurementRow& row = measurement.rows[i];
        if (row.wavelength_nm < options.first_nm || row.wavelength_nm > options.last_nm) continue;
        const auto model = predicted.find({row.wavelength_nm, row.angle_deg});
        if (model == predicted.end()) continue;
        const AnglePoint data = angle_point(row, options);
        const Reflection<double> r = reflection_of(*model->second);
        double pair[2] = {0, 0};
        const bool exists =
            rho2 ? rho2_residual(data, r, pair) : psi_delta_residuals(data, r, pair);
        if (exists) residuals[i] = {pair[0], pair[1]};
    }
    return residuals;
}

}  // namespace drude
