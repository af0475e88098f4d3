// The page of the whole study, and its tables, from plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "materials/measurement.h"
#include "materials/optical_constants.h"

namespace drude {

// Of log10 |fitted - literature| over the pixels of a pair in which they differ.
struct Log10Difference {
    double mean = 0, p50 = 0, p99 = 0, max = 0;
};

struct StudyMetal {
    std::string name;        // "Copper"
    std::string sample_set;  // the published set the virtual sample is made of
    std::string sample_set_citation;
    std::string literature_set;  // the set it is compared with
    std::string literature_set_citation;
    uint64_t seed = 0;            // of the instrument's noise
    Measurement measurement;      // simulated; angles and wavelengths as taken
    Measurement fitted_curve;     // Psi and Delta of the fitted model; without rows: no curve
    OpticalConstants fitted;      // with sigma_n, sigma_k where known
    OpticalConstants literature;  // the table of literature_set
    std::vector<OpticalConstants> published;  // every set of this metal, the two above included
    double reduced_chi2 = 0;
    double dof = 0;                 // degrees of freedom of the fit
    double rms_dn = 0, rms_dk = 0;  // fitted against literature, over the measured wavelengths
    Log10Difference log10_difference;
    std::string fitted_png, literature_png, difference_png;  // bytes; empty: not shown
};

struct StudyInfo {
    std::string version;  // of drude
    std::string command_line;
    std::string environment;  // its name, and whom to credit for it
    std::string environment_credit;
    double seconds = 0;              // wall time of the study
    std::string lobe;                // "blinn-phong"
    std::string masking;             // "v-groove"
    double beta = 0;                 // radians, as conventions of the lobe say
    std::string estimator;           // "psi-delta"
    std::string sheet_png;           // rows fitted, literature, difference; a column a metal
    std::vector<std::string> notes;  // warnings a reader should see
};

// A self-contained HTML document.
std::string study_page(const StudyInfo& info, const std::vector<StudyMetal>& metals);

// The n, k of one metal as a text table (base/text_table.h): wavelength_nm, n_fitted, k_fitted,
// sigma_n, sigma_k (where known), n_literature, k_literature, delta_n, delta_k (fitted minus
// literature, interpolated linearly; outside its range the literature's end value, said in the
// header).
std::string study_nk_csv(const StudyInfo& info, const StudyMetal& metal);

// One row a metal, in the order given (header keys metal_1, metal_2, ... name them): metal, seed,
// reduced_chi2, dof, rms_dn, rms_dk, log10_mean, log10_p50, log10_p99, log10_max. A figure that is
// not finite makes its metal's row invalid in the format, so such a row is left out and the header
// says so.
std::string study_summary_csv(const StudyInfo& info, const std::vector<StudyMetal>& metals);

}  // namespace drude
