// Optical constants from Psi and Delta.
//
//     Measurement m = import_measurement("cu.csv");
//     FitResult fit = fit_measurement(m, {});
//     write_material("cu.json", fitted_material(fit, m, "Cu", provenance));
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fitter/fit_result.h"
#include "materials/material.h"
#include "materials/measurement.h"

namespace drude {

// A quantity that is known, or fitted.
struct KnownOrFitted {
    double value = 0;
    bool fitted = false;

    bool given() const { return fitted || value != 0; }
};

struct FilmGuess {
    double thickness_nm = 0, porosity = 0;
};

// What the model "film" knows beforehand: light meets a film of unknown thickness, a Bruggeman
// mixture of `material` with empty pores, on a known substrate.
struct FilmModel {
    OpticalConstants substrate;
    OpticalConstants material;
    std::optional<double> porosity;  // volume fraction of the pores, in [0, 0.95]; empty: fitted
    double largest_thickness_nm = 10000;  // the search ends here; in [1, 1e5]
    // Standard deviation of the thickness over the beam, in nm, at least 0: it takes contrast from
    // the fringes and depolarises. A known one at most largest_spread() (film_average.h).
    KnownOrFitted spread_nm;
    // Of the spectrometer's slit, full width at half maximum of a Gaussian, in nm; in [0, 50].
    double bandwidth_nm = 0;
    // Where least squares starts, instead of the search: it finds the minimum of this basin only,
    // which is some per cent of the thickness wide. Within the ranges of the two.
    std::optional<FilmGuess> start;
};

struct FitOptions {
    // psi_delta: both angles (the default). rho2: tan^2 Psi alone, as Berger, Weidlich, Wilkie &
    // Magnor 2012 did. inversion: closed form for every angle of incidence, averaged.
    std::string estimator = "psi-delta";
    // bulk: a bare surface, n and k point by point. overlayer: the same below `overlayers`.
    // film: thickness and porosity of `film`. auto: the smallest of them that the data need
    // (model_ladder.h).
    std::string model = "bulk";
    std::vector<FilmLayer> overlayers;  // the first is the outermost
    FilmModel film;
    // Roughness as a layer of half void, half of what lies below it (Bruggeman), on the film of the
    // model film, on what is fitted otherwise: its thickness in nm, at least 0. Fitted for films
    // only: a thin layer on unknown n and k is indistinguishable from other n and k.
    KnownOrFitted roughness_nm;
    // What n and k of the models bulk and overlayer follow over the wavelengths: "" for no formula,
    // every wavelength by itself; "auto" for a formula where one holds (dispersion_choice.h);
    // otherwise what fit_dispersion() takes.
    std::string dispersion;
    // Where its least squares start, instead of the search: FitResult::dispersion_parameters of an
    // earlier fit of the same formula. Empty: the search.
    std::vector<double> dispersion_start;
    // A common error of the angles of incidence as one more parameter; takes three angles or more.
    bool fit_angle_offset = false;
    std::string lobe;  // refused: Psi and Delta hold nothing about roughness
    int threads = 0;   // 0: all available; the result does not depend on it
    // Standard deviations in degrees, for rows that bring none.
    double default_sigma_psi_deg = 0.05, default_sigma_delta_deg = 0.1;
    // Every row and both angles count alike, whatever standard deviations the file states; those
    // of the result then come from the scatter of the residuals.
    bool unweighted = false;
    // What a row far from the model counts: "none" takes squares; huber, cauchy and tukey let it
    // count less (robust_fit.h), auto where there are such rows. Not with inversion, the model
    // auto, or `unweighted`.
    std::string robust = "none";
    // What errors that rows share add to the standard deviation of the reduced chi-square, at least
    // 0: chi2_common_scatter() (common_error.h). It moves no fit, only what is said of chi-square.
    double chi2_common_scatter = 0;
    // Factors on the squared residuals, one for every row of the measurement; empty: 1 each.
    std::vector<double> weights;
    // Rows outside are left out; 0 and infinity take all.
    double first_nm = 0, last_nm = std::numeric_limits<double>::infinity();
};

const std::vector<std::string>& estimator_names();
const std::vector<std::string>& fit_model_names();

// The standard deviation that the reduced chi-square of a right model with right standard
// deviations has about 1, Gaussian errors taken for granted; NaN where there are no more data than
// parameters.
double chi2_scatter(const FitResult& result, const FitOptions& options);

// The variance of the noise over the one that residuals are divided by: 1, but where nothing is
// stated (`unweighted`) the reduced chi-square, as far as there are more data than parameters.
double noise_variance(const FitResult& result, const FitOptions& options);

// Fits without start values. The models bulk and overlayer take every wavelength by itself, with
// n >= 1e-6 and k >= 0, or follow a dispersion formula; film takes all wavelengths together, from a
// search of its own.
//
// Throws Error (user) for an unknown estimator or model, for options that the model lacks, has no
// use for or that are out of range, and for what Measurement::check forbids; Error (answer_is_no)
// where `lobe` is asked for, and where the data do not hold what is asked, each with the reason.
// Wavelengths that hold too little among others that hold enough are marked in the result and named
// in its warnings.
FitResult fit_measurement(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
