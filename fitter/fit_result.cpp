#include "fitter/fit_result.h"

#include <limits>

namespace drude {

double FitResult::chi2_reduced() const {
    return dof() > 0 ? chi2 / dof() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace drude
