// Model minus data in units of standard deviations, over double and ceres::Jet.
#pragma once

#include "fitter/point_data.h"
#include "materials/fresnel.h"

namespace drude {

// Two residuals a point: the difference X of model and data on the Poincare sphere, projected on
// the two tangents at the data. Near the data these are (Psi_model - Psi)/sigma_Psi and
// (Delta_model - Delta)/sigma_Delta, without a seam in Delta and without its divergence where Psi
// nears 0 or 90 degrees. Beyond 90 degrees on the sphere the projections shrink again; the pair is
// then lengthened to the chord, so that the antipode of the data is no minimum.
//
// False where the model reflects nothing, i.e. n = 1 and k = 0: Psi and Delta do not exist there.
template <class T>
bool psi_delta_residuals(const AnglePoint& point, const Reflection<T>& model, T* residuals) {
    using std::sqrt;
    const T A = model.A();
    if (!(A > T(1e-30))) return false;
    // Over sqrt(B^2 + C^2 + S^2) rather than A, so that the model is a unit vector whatever rounds.
    const T B = model.B();
    const T inverse = T(1.0) / sqrt(B * B + model.C * model.C + model.S * model.S);
    // N = cos 2Psi = (Rs - Rp)/(Rs + Rp).
    const T N = B * inverse, C = model.C * inverse, S = model.S * inverse;
    // The data are orthogonal to their tangents and drop out of the projections.
    residuals[0] = N * point.along_psi[0] + C * point.along_psi[1] + S * point.along_psi[2];
    residuals[1] = C * point.along_delta[1] + S * point.along_delta[2];
    const T cosine = N * point.direction[0] + C * point.direction[1] + S * point.direction[2];
    if (cosine < T(0.0)) {
        // chord = 2 sin(angle/2), length of the projections = sin(angle) = sqrt(1 - cosine^2).
        const T square = (T(1.0) - cosine) * (T(1.0) + cosine);
        if (square > T(1e-20)) {
            const T factor = sqrt(T(2.0) / (T(1.0) + cosine));
            residuals[0] = residuals[0] * factor;
            residuals[1] = residuals[1] * factor;
        } else {
            // At the antipode itself every direction is as good as any other.
            residuals[0] = residuals[0] + T(1.0 / point.sigma_psi);
        }
    }
    return true;
}

// One residual a point: tan^2 Psi = Rp/Rs.
template <class T>
bool rho2_residual(const AnglePoint& point, const Reflection<T>& model, T* residual) {
    if (!(model.Rs > T(1e-30))) return false;
    *residual = (model.Rp / model.Rs - T(point.tan2_psi)) * T(1.0 / point.sigma_tan2_psi);
    return true;
}

}  // namespace drude
