// What a study consists of, as plain data: what its page, its tables and its figures are made from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fitter/common_error.h"
#include "fitter/lobe_fit.h"
#include "materials/lobe_scan.h"
#include "materials/material.h"
#include "materials/measurement.h"
#include "report/pair_statistics.h"

namespace drude {

// How a sweep went on the virtual bench, beside what its measurement says itself.
struct StudyCapture {
    uint64_t seed = 0;  // of the bench's noise and jitter
    double integration_s = 0;
    size_t frames = 0;         // that were kept
    double bench_seconds = 0;  // by the bench's clock
    size_t retries = 0;
    // Of the scans; empty and 0 for lobe scans. The largest fourth harmonic and drift, the rms
    // residual over the stated noise, the mean azimuth jitter seen in the residuals.
    std::vector<CommonError> common;
    double harmonic_4 = 0, drift = 0, residual_over_noise = 0, step_jitter_deg = 0;
    size_t saturated = 0;  // readings left out
    std::vector<std::string> warnings;
};

// A lobe scan of a sample and what was found in it.
struct StudyLobe {
    Lobe true_lobe = Lobe::trowbridge_reitz;
    Masking true_masking = Masking::v_groove;
    double true_beta = 0;
    StudyCapture capture;
    LobeScan scan;
    LobeFitResult fit;
    // Of each of fit.lobes: the standard deviation of its beta, the larger of sigma_beta and
    // scatter_of_beta() (fitter/lobe_scatter.h).
    std::vector<double> sigma;
    Material surface;  // the fitted metal with the recovered lobe and beta, as it was rendered
    std::optional<PairStatistics> pair;  // of the two renderings with it, where they were compared
};

// One metal: a virtual sample, its measurement and fit, and the published set it is compared with.
struct StudyMetal {
    std::string name;        // "Copper"
    std::string folder;      // "copper", within the study's
    std::string sample_set;  // the published set the virtual sample is made of
    std::string sample_set_citation;
    std::string literature_set;  // the set it is compared with
    std::string literature_set_citation;
    StudyCapture capture;
    Measurement measurement;      // captured on the virtual bench
    Measurement fitted_curve;     // Psi and Delta of the fitted model; without rows: no curve
    OpticalConstants fitted;      // with sigma_n, sigma_k where known
    OpticalConstants literature;  // the table of literature_set
    std::vector<OpticalConstants> published;  // every set of this metal, the two above included
    // Of the fit, which counts the common error among the standard deviations, and of the same fit
    // with the noise of each wavelength alone.
    double reduced_chi2 = 0, noise_chi2 = 0;
    double dof = 0;                      // degrees of freedom of the fit
    std::optional<StudyLobe> lobe;       // of a rough sample
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
    StudyCapture capture;
    Measurement measurement;
    Measurement fitted_curve;            // of the fitted film
    Material sample;                     // what was measured
    Material fitted;                     // with its film
    OpticalConstants bare;               // pseudo n, k of the fit that knows of no film
    double film_chi2 = 0, film_dof = 0;  // reduced chi-square of either fit
    double noise_chi2 = 0;               // of the film's, without the common error
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
    std::string bench;               // settings of the virtual bench, JSON
    std::vector<std::string> notes;  // warnings a reader should see
};

struct Study {
    StudyInfo info;
    std::vector<StudyMetal> metals;
    std::optional<StudyFilm> film;
};

}  // namespace drude
