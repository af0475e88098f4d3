// n and k at every wavelength together with one error that all angles of incidence share.
#pragma once

#include <vector>

#include "fitter/fit_result.h"
#include "fitter/point_fit.h"

namespace drude {

// In radians, either way: an instrument that is further out is not aligned.
inline constexpr double largest_angle_offset = 2 * pi / 180;

// The data at angles of incidence that are `offset` radians larger than stated.
std::vector<WavelengthData> with_angle_offset(std::vector<WavelengthData> groups, double offset);

struct OffsetFit {
    std::vector<FittedPoint> points;  // as fit_point() gives them, at the corrected angles; their
                                      // sigmas contain that of the offset
    FittedParameter offset;           // in degrees, added to every stated angle
};

// Variable projection (Golub & Pereyra 1973, in Kaufman's form of 1975): at any offset the
// wavelengths are independent and fit_point() solves them; Gauss and Newton's step in the offset
// alone takes the derivative that no change of n and k can make up for. `estimator`: psi_delta or
// rho2. Throws Error (answer_is_no) where the data do not determine the offset, or where it leaves
// the two degrees on either side that are sought.
OffsetFit fit_with_offset(const std::vector<WavelengthData>& groups, Estimator estimator,
                          int threads);

}  // namespace drude
