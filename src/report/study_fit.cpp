#include "report/study_fit.h"

#include "fitter/common_error.h"

namespace drude {

FitReport fit_report_of(const StudyMetal& metal) {
    FitReport report;
    report.name = metal.name;
    // What the fit weighed it by.
    report.measurement = with_common_error(metal.measurement, metal.capture.common);
    report.fit.estimator = "psi-delta";
    report.fit.model = "bulk";
    const OpticalConstants& fitted = metal.fitted;
    for (size_t i = 0; i < fitted.wavelength_nm.size(); ++i) {
        FittedPoint point;
        point.wavelength_nm = fitted.wavelength_nm[i];
        point.n = fitted.n[i];
        point.k = fitted.k[i];
        point.sigma_n = i < fitted.sigma_n.size() ? fitted.sigma_n[i] : 0;
        point.sigma_k = i < fitted.sigma_k.size() ? fitted.sigma_k[i] : 0;
        point.identifiable = true;
        report.fit.points.push_back(point);
    }
    if (!metal.published.empty() && !report.fit.points.empty()) {
        report.literature =
            compare_with_literature(report.fit, "", metal.published.front().material);
    }
    return report;
}

}  // namespace drude
