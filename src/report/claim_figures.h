// The figures that claims about a study rest on.
#pragma once

#include <string>

#include "report/study_data.h"

namespace drude {

// "0.42 %", "37 %": two digits.
std::string percent_text(double share);

// The metal whose folder has this name, or null.
const StudyMetal* find_metal(const Study& study, const std::string& folder);

// tan^2 Psi of a measurement against Fresnel's ratio with n, k of `set`, at all wavelengths and
// angles: root mean square of the relative differences.
double ratio_deviation(const Measurement& measurement, const OpticalConstants& set);

// The share of the fitted wavelengths at which both n and k lie between the least and the greatest
// of the published sets that cover them, the sample's own left out, widened by three standard
// deviations of the fit. Wavelengths with fewer than two such sets, which span nothing, do not
// count; NaN where no other is left.
struct EnvelopeShare {
    double share = 0;
    int sets = 0;  // the most that cover one wavelength
};
EnvelopeShare envelope_share(const StudyMetal& metal);

// Mean of fitted minus `set`, over the mean of `set`, of n or of k at the fitted wavelengths that
// the set covers; NaN where it covers none.
double relative_gap(const OpticalConstants& fitted, const OpticalConstants& set, bool n);

// The largest relative error of the unpolarised reflectance (Rs + Rp)/2 that `fitted` predicts for
// `sample`, over the wavelengths and angles of `measurement`.
double reflectance_error(const Material& sample, const Material& fitted,
                         const Measurement& measurement);

// An oxide too thin to be seen: 3 nm of Al2O3 on the metal of `sample_set`, measured without noise
// where `like` was, and fitted as a bare surface.
struct HiddenOxide {
    double reduced_chi2 = 0;       // at 0.05 and 0.1 degrees
    double reflectance_error = 0;  // of what that fit predicts
};
HiddenOxide hidden_oxide(const std::string& sample_set, const Measurement& like);

// How much tan^2 Psi of the polarised Torrance-Sparrow model, in the mirror direction, differs from
// that of the smooth metal, relatively and at most: over the four lobes, beta from 0.05 to 1.15 and
// the angles of `measurement`, at its first, middle and last wavelength.
double largest_ratio_change_by_beta(const OpticalConstants& set, const Measurement& measurement);

// Psi at one angle of incidence, in order of wavelength.
std::vector<double> psi_at(const Measurement& measurement, double angle_deg);

// Turning points of `values`: extremes between which they change by more than `least`.
int turning_points(const std::vector<double>& values, double least);

}  // namespace drude
