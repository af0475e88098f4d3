// What `drude fit` prints of a fit of optical constants.
#pragma once

#include <string>

#include "fitter/fit_result.h"
#include "fitter/lobe_fit.h"
#include "materials/measurement.h"

namespace drude {

// One JSON document on stdout. `output`: the material file that is written, or empty. `lobes`: of a
// lobe scan, or null.
void print_fit_json(const FitResult& fit, const Measurement& measurement, const Material& material,
                    const std::string& output, const LobeFitResult* lobes);

// The same for people: with or without the table of wavelengths, then the summary. `unweighted`:
// chi-square is in square degrees.
void print_fit_text(const FitResult& fit, const Material& material, bool with_table,
                    bool unweighted);

// The lobes alone, where n and k were given.
void print_lobe_json(const LobeFitResult& lobes, const Material& material,
                     const std::string& output);
void print_lobe_text(const LobeFitResult& lobes);

}  // namespace drude
