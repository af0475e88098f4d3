#include "fitter/fit_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drude {

StartCount count_starts(const std::vector<double>& chi2) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const double value : chi2) {
        if (std::isfinite(value)) lowest = std::min(lowest, value);
    }
    StartCount count;
    for (const double value : chi2) {
        if (!std::isfinite(value)) continue;
        ++count.refined;
        // Without noise the lowest is rounding, and so are the others.
        if (value - lowest <= 1e-6 * lowest + 1e-12) {
            ++count.in_best;
        } else if (count.next_chi2_excess == 0 || value - lowest < count.next_chi2_excess) {
            count.next_chi2_excess = value - lowest;
        }
    }
    return count;
}

const FittedParameter* FitResult::find(std::string_view name) const {
    for (const FittedParameter& parameter : common) {
        if (parameter.name == name) return &parameter;
    }
    return nullptr;
}

OpticalConstants FitResult::constants() const {
    OpticalConstants table;
    table.kind = "fitted";
    for (const FittedPoint& point : points) {
        if (!point.identifiable) continue;
        table.wavelength_nm.push_back(point.wavelength_nm);
        table.n.push_back(point.n);
        table.k.push_back(point.k);
        table.sigma_n.push_back(point.sigma_n);
        table.sigma_k.push_back(point.sigma_k);
    }
    return table;
}

double FitResult::chi2_reduced() const {
    return dof() > 0 ? chi2 / dof() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace drude
