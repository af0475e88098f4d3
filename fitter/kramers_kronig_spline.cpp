#include "fitter/kramers_kronig_spline.h"

#include <cmath>

#include "base/error.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr double alternating_binomial[] = {1, -4, 6, -4, 1};

// B and -H of the spline whose first knot lies `x` steps of the knots below.
double spline(double x) {
    double sum = 0;
    for (int j = 0; j <= 4; ++j) {
        const double distance = x - j;
        if (distance > 0) sum += alternating_binomial[j] * distance * distance * distance;
    }
    // Beyond the last knot the cubics cancel but for rounding.
    return x < 4 ? sum / 6 : 0;
}

double logarithms(double x) {
    double sum = 0;
    for (int j = 0; j <= 4; ++j) {
        const double distance = x - j;
        if (distance == 0) continue;  // the limit of t^3 ln t
        sum +=
            alternating_binomial[j] * distance * distance * distance * std::log(std::abs(distance));
    }
    return sum / 6;
}

}  // namespace

KramersKronigSpline::KramersKronigSpline(double first_ev, double last_ev, int intervals)
    : first_(first_ev), step_((last_ev - first_ev) / intervals), intervals_(intervals) {
    if (!(first_ev > 0 && last_ev > first_ev && std::isfinite(last_ev))) {
        user_error("found a spline from {} to {} eV, expected 0 < first < last", first_ev, last_ev);
    }
    const int fewest = fewest_intervals(first_ev, last_ev);
    if (intervals < fewest) {
        user_error(
            "found a spline of {} intervals, expected {} or more from {:.4g} to {:.4g} eV: its "
            "knots would reach below 0 eV",
            intervals, fewest, first_ev, last_ev);
    }
}

int KramersKronigSpline::fewest_intervals(double first_ev, double last_ev) {
    return static_cast<int>(std::floor(3 * (last_ev - first_ev) / first_ev)) + 1;
}

std::complex<double> KramersKronigSpline::function(int i, double energy_ev) const {
    const double first_knot = first_ + (i - 3) * step_;
    // A common factor of all distances drops out of the fourth difference of t^3 ln t.
    const double above = (energy_ev - first_knot) / step_,
                 below = (-energy_ev - first_knot) / step_;
    return {-(logarithms(above) + logarithms(below)) / pi, spline(above)};
}

}  // namespace drude
