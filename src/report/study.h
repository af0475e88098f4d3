// The study: five metals measured, fitted, rendered with the fitted and with published constants,
// and compared (after Berger, Weidlich, Wilkie & Magnor, IEEE CG&A 32(2), 2012).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/study_report.h"

namespace drude {

struct StudyOptions {
    std::string folder;                     // everything is written here
    std::string environment = "courtyard";  // or a picture's file name
    std::string lobe = "blinn-phong";
    std::string masking = "v-groove";
    // Half-height angle of Blinn's exponent 10000, where the renderer of the original study
    // clamped its roughness 0.0001.
    double beta = 0.011774;
    int samples_per_pixel = 64;
    int resolution = 512;
    uint64_t seed = 1;
    bool spectral = false;  // 10 nm layers of S0..S3 in every EXR
    int threads = 0;
    bool quiet = false;
    std::string command_line;
};

struct StudyResult {
    StudyInfo info;
    std::vector<StudyMetal> metals;
    std::vector<std::string> files;  // written, relative to the folder
    std::vector<std::string> notes;  // what a reader of the figures must know
    double render_seconds = 0;
};

// Writes, for every metal, METAL/measurement.csv, fitted.json, literature.json, fitted.exr,
// literature.exr, fitted.png, literature.png, difference.png, nk.csv; and comparison.png (the
// sheet), summary.csv and index.html. Throws Error.
StudyResult run_study(const StudyOptions& options);

}  // namespace drude
