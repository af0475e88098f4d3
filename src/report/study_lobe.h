// What a lobe scan says of a sample's roughness, beside what the sample was made with.
#pragma once

#include <string>

#include "report/study_data.h"
#include "report/svg_plot.h"

namespace drude {

enum class LobeVerdict {
    recovered,    // its own lobe alone explains the scan, beta within 4 sigma
    tie,          // its own lobe is among several that explain the scan, its beta within 4 sigma
    lobe_missed,  // its own lobe does not
    beta_missed,  // it does, with a beta that is further away
};
LobeVerdict lobe_verdict(const StudyLobe& lobe);
// "recovered", "tie", "lobe missed", "beta missed".
std::string lobe_verdict_text(LobeVerdict verdict);

// The fit with the sample's own lobe. Throws std::logic_error where the fit lacks it.
const FittedLobe& own_lobe(const StudyLobe& lobe);
// Other lobes within the tie of the best, by name; none: "".
std::string tied_with(const StudyLobe& lobe);
// Its standard deviation (StudyLobe::sigma).
double own_sigma(const StudyLobe& lobe);

// Reflectance of s and p against the detector's offset at the wavelength nearest `wavelength_nm`:
// the scan, the best lobe and, dashed, the next best that does not tie (or, where all do, the
// last).
std::string lobe_plot(const StudyMetal& metal, double wavelength_nm);

}  // namespace drude
