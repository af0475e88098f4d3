// Optical constants of a bare surface in closed form.
#pragma once

#include "fitter/point_data.h"

namespace drude {

struct InvertedIndex {
    double n = 0, k = 0;              // the larger of them is positive
    double sigma_n = 0, sigma_k = 0;  // propagated to first order
    double covariance = 0;            // of n and k
};

// From Psi and Delta at one angle of incidence: with r = conj(rho) = tan Psi exp(-i Delta),
//   N^2 = sin^2 [1 + tan^2 ((1 - r)/(1 + r))^2]
// (Azzam & Bashara 1977, section 4.17; for conj(rho) = (s - q)/(s + q), s = sin tan). NaN where
// r = -1: that is normal or grazing incidence, where Psi and Delta say nothing.
//
// Of the two roots +-N noise must not make a choice: where it takes n of silver or k of glass below
// 0, that small one is negative and averages out. It is so too where Delta lies outside [0, 180]
// degrees, where no bare surface has it.
InvertedIndex invert_psi_delta(const AnglePoint& point);

struct AveragedIndex {
    double n = 0, k = 0;
    double sigma_n = 0, sigma_k = 0;
    double correlation = 0;
    double spread_n = 0, spread_k = 0;  // sample standard deviation over angles; 0 for one angle
    int angles = 0;                     // that could be inverted
};

// Every angle inverted, averaged with the inverse variances as weights (n and k each by itself).
AveragedIndex invert_and_average(const WavelengthData& data);

// A start for fits of tan^2 Psi alone, within about 5 % for metals: a and |q|^2, which hardly
// depend on the angle, from the linear least squares of 2 s a - N |q|^2 = s^2 N, N = cos 2Psi,
// s = sin tan. Needs two angles.
AveragedIndex start_from_tan2_psi(const WavelengthData& data);

}  // namespace drude
