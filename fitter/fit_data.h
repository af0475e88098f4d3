// A measurement as fits take it: the rows that count, with their weights, by wavelength.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit.h"
#include "fitter/point_data.h"

namespace drude {

// The rows within the options' range, ascending in wavelength, then in angle, so that the order of
// the rows in a file does not move the last digit of a fit. Every wavelength carries the options'
// overlayers. Throws Error (user) where no row lies within the range.
std::vector<WavelengthData> group_by_wavelength(const Measurement& measurement,
                                                const FitOptions& options);

// What a person should know of the data before trusting a fit of them: standard deviations that
// had to be assumed, depolarisation, and, for a bare surface, a sign of Delta that none has.
std::vector<std::string> data_warnings(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
