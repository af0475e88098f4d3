// The data of one wavelength, prepared for the residuals: radians, unit vectors, weights.
#pragma once

#include <vector>

#include "materials/film_stack.h"

namespace drude {

// Psi and Delta as the point (N, C, S) = (cos 2Psi, sin 2Psi cos Delta, sin 2Psi sin Delta) of the
// Poincare sphere, with the two unit tangents in which its errors are independent.
struct AnglePoint {
    double cos_theta = 0, sin_theta = 0;
    double psi = 0, delta = 0;              // radians
    double sigma_psi = 0, sigma_delta = 0;  // radians
    double direction[3] = {0, 0, 0};        // (N, C, S) of the data
    double along_psi[3] = {0, 0, 0};        // tangent of growing 2 Psi, over 2 sigma_psi
    double along_delta[3] = {0, 0, 0};      // tangent of growing Delta, over sin 2Psi sigma_delta
    double tan2_psi = 0, sigma_tan2_psi = 0;
};

struct WavelengthData {
    double wavelength_nm = 0;
    std::vector<AnglePoint> points;
    // Known layers on what is fitted, thickness in nm; the first is the outermost.
    std::vector<ThinFilm<double>> layers;
    // Thickness of a layer of half void, half what is fitted, directly on it; 0 for none.
    double roughness_nm = 0;

    bool bare() const { return layers.empty() && roughness_nm == 0; }
};

// Angles and standard deviations in degrees; both sigmas > 0.
AnglePoint make_angle_point(double angle_deg, double psi_deg, double delta_deg,
                            double sigma_psi_deg, double sigma_delta_deg);

}  // namespace drude
