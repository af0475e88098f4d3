// Cubic B-splines of the photon energy as an absorption spectrum, with the dispersion that
// causality asks for in closed form.
#pragma once

#include <complex>
#include <vector>

namespace drude {

// eps_2(E) = sum c_i B_i(E) for E > 0, uniform knots, and eps_1(E) = sum c_i phi_i(E) with
//   phi_i(E) = 2/pi P int_0^inf x B_i(x) / (x^2 - E^2) dx
//            = 1/pi [H_i(E) + H_i(-E)],  H_i(E) = P int B_i(x)/(x - E) dx.
// B_i is the fourth difference of (x - t)_+^3/(6 h^3) in the knots t. In the integral of
// (x - t)^3/(x - E) from t to any far end everything is a cubic of t but -(E - t)^3 ln|E - t|, and
// fourth differences take cubics away:
//   H_i(E) = -1/(6 h^3) sum_j (-1)^j binomial(4, j) (E - t_ij)^3 ln|E - t_ij|.
// c_i >= 0 for all i keeps eps_2 >= 0 everywhere.
class KramersKronigSpline {
  public:
    // Knots at first_ev + j (last_ev - first_ev)/intervals, with three more on either side:
    // intervals + 3 functions. 0 < first_ev < last_ev in eV; intervals >= fewest_intervals().
    // Throws Error (user) otherwise.
    KramersKronigSpline(double first_ev, double last_ev, int intervals);

    // The knots must not reach E <= 0, where eps_2 is odd.
    static int fewest_intervals(double first_ev, double last_ev);

    int count() const { return intervals_ + 3; }
    // phi_i + i B_i at `energy_ev` > 0, for 0 <= i < count().
    std::complex<double> function(int i, double energy_ev) const;

  private:
    double first_, step_;
    int intervals_;
};

}  // namespace drude
