// A measurement as fits take it: the rows that count, with their weights, by wavelength.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit.h"
#include "fitter/point_data.h"

namespace drude {

// One row with the standard deviations that the options give it.
AnglePoint angle_point(const MeasurementRow& row, const FitOptions& options);

// The rows within the options' range, ascending in wavelength, then in angle, so that the order of
// the rows in a file does not move the last digit of a fit. Every wavelength carries the options'
// overlayers, and every row the options' weight. Throws Error (user) where no row lies within the
// range, and for weights that are not one for every row, above 0 and finite.
std::vector<WavelengthData> group_by_wavelength(const Measurement& measurement,
                                                const FitOptions& options);

// What a person should know of the data before trusting a fit of them: standard deviations that
// had to be assumed, depolarisation, and, for a bare surface, a sign of Delta that none has.
std::vector<std::string> data_warnings(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
