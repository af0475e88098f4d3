// What `drude fit` prints of a fit of optical constants.
#pragma once

#include <string>

#include "fitter/lobe_fit.h"
#include "report/fit_report.h"

namespace drude {

// One JSON document on stdout. `output`: the material file that is written, or empty. `lobes`: of a
// lobe scan, or null.
void print_fit_json(const FitReport& report, const Material& material, const std::string& output,
                    const LobeFitResult* lobes);

// The same for people: with or without the table of wavelengths, then the summary.
void print_fit_text(const FitReport& report, bool with_table);

// The lobes alone, where n and k were given.
void print_lobe_json(const LobeFitResult& lobes, const Material& material,
                     const std::string& output);
void print_lobe_text(const LobeFitResult& lobes);

}  // namespace drude
