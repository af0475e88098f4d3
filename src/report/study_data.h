// What a study consists of, as plain data: what its page, its tables and its figures are made from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "materials/material.h"
#include "materials/measurement.h"
#include "report/pair_statistics.h"

namespace drude {

// One metal: a virtual sample, its measurement and fit, and the published set it is compared with.
struct StudyMetal {
    std::string name;        // "Copper"
    std::string folder;      // "copper", within the study's
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
    double dof = 0;                      // degrees of freedom of the fit
    double rms_dn = 0, rms_dk = 0;       // fitted against literature, over the measured wavelengths
    std::optional<PairStatistics> pair;  // of the two renderings, where they were compared
};

// A number that a fit of the film found, with what the virtual sample was made of.
struct StudyParameter {
    std::string name, unit;
    double value = 0, sigma = 0;  // sigma NaN where the data do not determine it
    double truth = 0;
};

// Anodised aluminium: a virtual sample with a film some micrometres thick, fitted twice.
struct StudyFilm {
    std::string name;    // "Anodised aluminium"
    std::string folder;  // within the study's
    std::string substrate_set, film_set;
    uint64_t seed = 0;
    Measurement measurement;
    Measurement fitted_curve;            // of the fitted film
    Material sample;                     // what was measured
    Material fitted;                     // with its film
    OpticalConstants bare;               // pseudo n, k of the fit that knows of no film
    double film_chi2 = 0, film_dof = 0;  // reduced chi-square of either fit
    double bare_chi2 = 0, bare_dof = 0;
    std::vector<StudyParameter> parameters;
};

struct StudyInfo {
    std::string version;  // of drude
    std::string command_line;
    std::string environment;  // its name, and whom to credit for it
    std::string environment_credit;
    double seconds = 0;         // wall time of the study, its report left out
    double render_seconds = 0;  // of that, in the rendering loop
    int samples_per_pixel = 0;
    uint64_t seed = 0;               // of the samples
    std::string lobe;                // "blinn-phong"
    std::string masking;             // "v-groove"
    double beta = 0;                 // radians, as conventions of the lobe say
    std::string estimator;           // "psi-delta"
    std::vector<std::string> notes;  // warnings a reader should see
};

struct Study {
    StudyInfo info;
    std::vector<StudyMetal> metals;
    std::optional<StudyFilm> film;
};

}  // namespace drude
