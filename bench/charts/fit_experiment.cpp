#include "bench/charts/fit_experiment.h"

#include <cmath>

#include "base/error.h"
#include "bench/charts/experiment.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "materials/fresnel.h"

namespace drude {

const char* fit_scene_name(FitScene scene) {
    switch (scene) {
        case FitScene::sky:
            return "sky";
        case FitScene::bounces:
            return "five bounces";
        case FitScene::crossed:
            break;
    }
    return "crossed polarisers";
}

SpherePicture fit_picture(FitScene scene, const DenseIndex& metal) {
    return sphere_picture([&](int i, int ring) {
        const Reflection<double> r =
            reflect(ComplexIndex<double>{metal.n[i], metal.k[i]}, ring_cosine(ring));
        switch (scene) {
            case FitScene::sky:
                return r.A();
            case FitScene::bounces:
                return 0.5 * (std::pow(r.Rs, 5) + std::pow(r.Rp, 5));
            case FitScene::crossed:
                break;
        }
        return 0.5 * (r.A() + r.C);
    });
}

FitOutcome fit_outcome(const OpticalConstants& metal, const FitSetting& setting, uint64_t seed) {
    SimulationSetup setup;
    setup.angles_deg = setting.angles_deg;
    for (int i = 0; i < setting.wavelengths; ++i) {
        setup.wavelengths_nm.push_back(spectrum_first_nm + (spectrum_last_nm - spectrum_first_nm) *
                                                               static_cast<double>(i) /
                                                               (setting.wavelengths - 1));
    }
    setup.sigma_psi_deg = setting.sigma_psi_deg();
    setup.sigma_delta_deg = 2 * setting.sigma_psi_deg();
    setup.seed = seed;
    const Measurement measurement = simulate_ellipsometer(material_from_set(metal), setup);
    FitOptions options;
    options.estimator = setting.estimator;
    options.dispersion = setting.dispersion;
    options.threads = 1;

    FitOutcome outcome;
    const double begun = thread_seconds();
    OpticalConstants fitted;
    try {
        const FitResult fit = fit_measurement(measurement, options);
        outcome.seconds = thread_seconds() - begun;
        fitted = fit.constants();
        outcome.refused_share = 1 - static_cast<double>(fitted.wavelength_nm.size()) /
                                        static_cast<double>(fit.points.size());
    } catch (const Error& error) {
        if (error.cause() != Cause::answer_is_no) throw;
        outcome.refused = error.message();
    }
    if (outcome.refused.empty() && fitted.wavelength_nm.empty()) {
        outcome.refused = "no wavelength is identifiable";
    }
    if (!outcome.refused.empty()) return outcome;

    const DenseIndex truth = dense(metal), found = dense(fitted);
    double squares = 0;
    for (size_t i = 0; i < spectrum_integral_size; ++i) {
        const double error = std::hypot(found.n[i] - truth.n[i], found.k[i] - truth.k[i]);
        const double relative = error / std::hypot(truth.n[i], truth.k[i]);
        squares += relative * relative / spectrum_integral_size;
    }
    outcome.constants_error = std::sqrt(squares);
    for (size_t s = 0; s < fit_scenes.size(); ++s) {
        const SpherePicture right = fit_picture(fit_scenes[s], truth);
        outcome.pictures[s] =
            picture_error(fit_picture(fit_scenes[s], found), right, brightest(right));
    }
    return outcome;
}

}  // namespace drude
