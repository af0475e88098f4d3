// The study: five metals captured on the virtual bench, fitted, rendered with the fitted and with
// published constants, and an anodised surface captured and fitted (after Berger, Weidlich, Wilkie
// & Magnor, IEEE CG&A 32(2), 2012).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

struct StudyOptions {
    std::string folder;                     // everything is written here
    std::string environment = "courtyard";  // or a picture's file name
    std::string lobe = "blinn-phong";
    std::string masking = "v-groove";
    // Of the pairs that are nearly polished. Half-height angle of Blinn's exponent 10000, where the
    // renderer of the original study clamped its roughness 0.0001.
    double beta = 0.011774;
    int samples_per_pixel = 64;
    int resolution = 512;
    uint64_t seed = 1;      // of the benches (each sample has its own) and of the renderer
    bool spectral = false;  // 10 nm layers of S0..S3 in every EXR
    int threads = 0;
    bool quiet = false;
    std::string command_line;
};

struct StudyResult {
    Study study;
    std::vector<std::string> files;  // written, relative to the folder
};

// Writes bench/ (recipes, calibration and what it rests on); for every metal METAL/sample.json,
// bench.json, measurement.csv and lobe-scan.csv with their journals, fitted.json and
// literature.json, fitted.exr and literature.exr, and, without `spectral`, fitted-spectral.exr and
// literature-spectral.exr of a quarter of the resolution, all of these once more with the lobe and
// beta of the lobe scan (fitted-rough.json, ...); for the anodised surface what study_film() says;
// and study.json. What people look at is made from these by write_report() (study_report.h). Throws
// Error.
StudyResult run_study(const StudyOptions& options);

}  // namespace drude
