// Errors that the wavelengths of an angle share: how they come with a measurement, how a fit weighs
// them, and what they make of chi-square.
#pragma once

#include <string>
#include <vector>

#include "materials/measurement.h"

namespace drude {

// The error of Psi and Delta that all wavelengths of one angle of incidence share, as the reduction
// states it: standard deviations in degrees, from the mounts' repeatability and the calibration.
struct CommonError {
    double angle_deg = 0, sigma_psi_deg = 0, sigma_delta_deg = 0;
};

// What the header key sigma_common_deg says ("60: 0.025 0.011; 70: ...": angle: psi delta; a remark
// in parentheses may follow); empty where there is no such key. Throws Error (user) that names file
// and key for anything else than finite numbers, the sigmas at least 0.
std::vector<CommonError> common_errors(const Measurement& measurement);

// The same rows with the error that the wavelengths of an angle share among their standard
// deviations: the two are independent, so that their squares add. A row without a standard
// deviation stays one: what a fit assumes for it covers both.
Measurement with_common_error(Measurement measurement, const std::vector<CommonError>& common);

// What to say of a fit to with_common_error().
extern const char* const weighed_by_common_error;

// What common errors add to the standard deviation of a reduced chi-square: they are two draws for
// each angle less two that n and k take up, however many wavelengths share them; these by the share
// of the variances that they are.
double chi2_common_scatter(const Measurement& noise_alone, const std::vector<CommonError>& common);

// How far a reduced chi-square may lie from 1: four times the standard deviation of the noise,
// sqrt(2/dof), and of the common errors.
double chi2_slack(const Measurement& noise_alone, const std::vector<CommonError>& common,
                  double dof);

// What the reduced chi-square with the noise alone is expected to be because of the common error:
// 1 + the mean of (common / noise)^2 over the rows that state their noise.
double chi2_by_common_error(const Measurement& noise_alone, const std::vector<CommonError>& common);

}  // namespace drude
