#include "fitter/point_data.h"

#include <cmath>

#include "materials/scalar.h"

namespace drude {

AnglePoint make_angle_point(double angle_deg, double psi_deg, double delta_deg,
                            double sigma_psi_deg, double sigma_delta_deg) {
    AnglePoint point;
    point.cos_theta = std::cos(angle_deg * degree);
    point.sin_theta = std::sin(angle_deg * degree);
    point.psi = psi_deg * degree;
    // remainder() before the sine, so that Delta in any window of 360 degrees gives the same bits.
    point.delta = std::remainder(delta_deg, 360.0) * degree;
    point.sigma_psi = sigma_psi_deg * degree;
    point.sigma_delta = sigma_delta_deg * degree;
    const double cos_2psi = std::cos(2 * point.psi), sin_2psi = std::sin(2 * point.psi);
    const double cos_delta = std::cos(point.delta), sin_delta = std::sin(point.delta);
    point.direction[0] = cos_2psi;
    point.direction[1] = sin_2psi * cos_delta;
    point.direction[2] = sin_2psi * sin_delta;
    const double psi_weight = 1 / (2 * point.sigma_psi);
    point.along_psi[0] = -sin_2psi * psi_weight;
    point.along_psi[1] = cos_2psi * cos_delta * psi_weight;
    point.along_psi[2] = cos_2psi * sin_delta * psi_weight;
    // At Psi = 0 and 90 only one polarisation is reflected and Delta says nothing.
    const double delta_weight = sin_2psi > 1e-9 ? 1 / (sin_2psi * point.sigma_delta) : 0;
    point.along_delta[1] = -sin_delta * delta_weight;
    point.along_delta[2] = cos_delta * delta_weight;
    const double t = std::tan(point.psi);
    point.tan2_psi = t * t;
    // First order, and the second order that is left at Psi = 0: var(x^2) = 4 x^2 s^2 + 2 s^4.
    const double sigma_tan = (1 + t * t) * point.sigma_psi;
    point.sigma_tan2_psi = sigma_tan * std::sqrt(4 * t * t + 2 * sigma_tan * sigma_tan);
    return point;
}

}  // namespace drude
