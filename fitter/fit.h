// Optical constants from Psi and Delta.
//
//     Measurement m = import_measurement("cu.csv");
//     FitResult fit = fit_measurement(m, {});
//     write_material("cu.json", fitted_material(fit, m, "Cu", provenance));
#pragma once

#include <string>
#include <vector>

#include "fitter/fit_result.h"
#include "materials/measurement.h"

namespace drude {

struct FitOptions {
    // psi_delta: both angles (the default). rho2: tan^2 Psi alone, as Berger, Weidlich, Wilkie &
    // Magnor 2012 did. inversion: closed form for every angle of incidence, averaged.
    std::string estimator = "psi-delta";
    std::string model = "bulk";  // a bare surface, n and k point by point
    std::string lobe;            // refused: Psi and Delta hold nothing about roughness
    int threads = 0;             // 0: all available; the result does not depend on it
    // Standard deviations in degrees, for rows that bring none.
    double default_sigma_psi_deg = 0.05, default_sigma_delta_deg = 0.1;
};

const std::vector<std::string>& estimator_names();
const std::vector<std::string>& fit_model_names();

// Fits every wavelength by itself, from a closed-form start, with n >= 1e-6 and k >= 0.
//
// Throws Error (user) for an unknown estimator or model and for what Measurement::check forbids;
// Error (answer_is_no) where `lobe` is asked for, and where no wavelength holds enough information,
// each with the reason. Wavelengths that hold too little among others that hold enough are marked
// in the result and named in its warnings.
FitResult fit_measurement(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
