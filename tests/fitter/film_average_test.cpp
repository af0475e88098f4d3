// Films that are uneven, rough, or seen through a wide slit: averages against sums by another rule,
// and what fits make of them.
#include "fitter/film_average.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "fitter/film_cases.h"
#include "fitter/fit.h"
#include "fitter/model_curve.h"

namespace drude {
namespace {

// A Gaussian of standard deviation `sigma` by Simpson's rule on 121 nodes over +-6 sigma.
Reflection<double> simpson(double sigma, const std::function<Reflection<double>(double)>& at) {
    if (sigma == 0) return at(0);
    Reflection<double> sum{0, 0, 0, 0};
    double total = 0;
    for (int i = 0; i <= 120; ++i) {
        const double x = 6.0 * (i - 60) / 60;
        const double weight = (i % 2 == 1 ? 4 : i == 0 || i == 120 ? 1 : 2) * std::exp(-x * x / 2);
        const Reflection<double> r = at(sigma * x);
        add_weighted(r, weight, &sum);
        total += weight;
    }
    return {sum.Rs / total, sum.Rp / total, sum.C / total, sum.S / total};
}

struct Sample {
    double thickness_nm = 3000, porosity = 0.1, spread_nm = 0, slit_nm = 0, roughness_nm = 0;
};

// One reflection off the anodised sample, straight from the film stack.
Reflection<double> sample_reflection(const Sample& sample, double nm, double thicker_nm,
                                     double cos_theta) {
    const auto film = [&](double porosity, ComplexIndex<double> dense) {
        return bruggeman(dense, ComplexIndex<double>{1, 0}, porosity);
    };
    const Index dense = published_set("Al2O3-Malitson-o").at(nm);
    const Index below = published_set("Al-Rakic").at(nm);
    const ComplexIndex<double> porous = film(sample.porosity, {dense.n, dense.k});
    const ThinFilm<double> films[] = {{film(0.5, porous), sample.roughness_nm},
                                      {porous, sample.thickness_nm + thicker_nm}};
    const int skip = sample.roughness_nm > 0 ? 0 : 1;
    return reflect(films + skip, 2 - skip, ComplexIndex<double>{below.n, below.k}, cos_theta, nm);
}

Measurement measured(const Sample& sample, uint64_t seed, double step_nm = 2) {
    const double slit = sample.slit_nm / 2.3548200450309493;
    Measurement data;
    for (double nm = 380; nm <= 750; nm += step_nm) {
        for (const double angle : {60.0, 70.0}) {
            const double cos_theta = std::cos(angle * pi / 180);
            const Reflection<double> r = simpson(slit, [&](double shift) {
                return simpson(sample.spread_nm, [&](double thicker) {
                    return sample_reflection(sample, nm + shift, thicker, cos_theta);
                });
            });
            const auto noise = normal_pair(seed, data.rows.size());
            MeasurementRow row;
            row.wavelength_nm = nm;
            row.angle_deg = angle;
            row.sigma_psi_deg = 0.05;
            row.sigma_delta_deg = 0.1;
            row.psi_deg = psi(r) * 180 / pi + (seed > 0 ? 0.05 * noise[0] : 0);
            row.delta_deg = delta(r) * 180 / pi + (seed > 0 ? 0.1 * noise[1] : 0);
            data.rows.push_back(row);
        }
    }
    return data;
}

const FittedParameter& parameter(const FitResult& fit, const std::string& name) {
    const FittedParameter* found = fit.find(name);
    if (!found) throw std::runtime_error("no parameter " + name);
    return *found;
}

TEST(FilmAverage, SpreadOfTheThicknessComesBack) {
    Sample sample;
    sample.spread_nm = 30;
    FitOptions options = anodised_options();
    options.film.spread_nm = {0, true};
    const FitResult fit = fit_measurement(measured(sample, 4, 4), options);
    EXPECT_NEAR(fit.chi2_reduced(), 1, 0.2);
    EXPECT_NEAR(parameter(fit, "thickness").value, 3000, 5 * parameter(fit, "thickness").sigma);
    EXPECT_NEAR(parameter(fit, "porosity").value, 0.1, 5 * parameter(fit, "porosity").sigma);
    const FittedParameter& spread = parameter(fit, "thickness spread");
    EXPECT_NEAR(spread.value, 30, 5 * spread.sigma);
    EXPECT_LT(spread.sigma, 0.5);
    // Taken for even, the film explains nothing.
    const FitResult even = fit_measurement(measured(sample, 4, 4), anodised_options());
    EXPECT_GT(even.chi2_reduced(), 100);
}

TEST(FilmAverage, KnownBandwidthIsAccountedFor) {
    Sample sample;
    sample.slit_nm = 4;
    const Measurement data = measured(sample, 6, 4);
    FitOptions options = anodised_options();
    options.film.bandwidth_nm = 4;
    const FitResult fit = fit_measurement(data, options);
    EXPECT_NEAR(fit.chi2_reduced(), 1, 0.25);
    EXPECT_NEAR(parameter(fit, "thickness").value, 3000, 5 * parameter(fit, "thickness").sigma);
    EXPECT_GT(fit_measurement(data, anodised_options()).chi2_reduced(), 20);
}

TEST(FilmAverage, RoughnessOnAFilmComesBack) {
    Sample sample;
    sample.thickness_nm = 800;
    sample.roughness_nm = 12;
    FitOptions options = anodised_options();
    options.roughness_nm = {0, true};
    const FitResult fit = fit_measurement(measured(sample, 3, 4), options);
    EXPECT_NEAR(fit.chi2_reduced(), 1, 0.2);
    const FittedParameter& roughness = parameter(fit, "roughness");
    EXPECT_NEAR(roughness.value, 12, 5 * roughness.sigma);
    ASSERT_EQ(fit.layers.size(), 2u);
    EXPECT_DOUBLE_EQ(fit.layers[0].thickness_nm, roughness.value);
}

TEST(FilmAverage, ModelCurveIsWhatWasFitted) {
    Sample sample;
    sample.spread_nm = 15;
    sample.slit_nm = 3;
    FitOptions options = anodised_options();
    options.film.spread_nm = {0, true};
    options.film.bandwidth_nm = 3;
    const Measurement data = measured(sample, 0, 10);
    const FitResult fit = fit_measurement(data, options);
    const Measurement curve = model_curve(fit, data);
    ASSERT_EQ(curve.rows.size(), data.rows.size());
    for (size_t i = 0; i < curve.rows.size(); ++i) {
        EXPECT_NEAR(curve.rows[i].psi_deg, data.rows[i].psi_deg, 5e-3);
        EXPECT_NEAR(std::remainder(curve.rows[i].delta_deg - data.rows[i].delta_deg, 360), 0, 5e-2);
    }
}

TEST(FilmAverage, LadderTakesTheSpreadWhereTheFilmIsUnevenOnly) {
    FitOptions options = anodised_options();
    options.model = "auto";
    Sample sample;
    const FitResult even = fit_measurement(measured(sample, 9, 6), options);
    EXPECT_EQ(even.ladder.back().model, "film + spread");
    EXPECT_FALSE(even.ladder.back().taken);
    sample.spread_nm = 20;
    const FitResult uneven = fit_measurement(measured(sample, 9, 6), options);
    EXPECT_TRUE(uneven.ladder.back().taken);
    EXPECT_NEAR(parameter(uneven, "thickness spread").value, 20, 1);
}

TEST(FilmAverage, KnownRoughnessOnAMetalIsTakenOffItsConstants) {
    // Silver under 5 nm of half void: as a bare surface it seems another metal.
    const Index silver{0.05, 3.085};
    Measurement data;
    for (const double angle : {45.0, 60.0, 75.0}) {
        const ComplexIndex<double> metal{silver.n, silver.k};
        const ThinFilm<double> rough{bruggeman(metal, ComplexIndex<double>{1, 0}, 0.5), 5};
        const Reflection<double> r = reflect(&rough, 1, metal, std::cos(angle * pi / 180), 495.0);
        MeasurementRow row;
        row.wavelength_nm = 495;
        row.angle_deg = angle;
        row.psi_deg = psi(r) * 180 / pi;
        row.delta_deg = delta(r) * 180 / pi;
        data.rows.push_back(row);
    }
    FitOptions options;
    const FitResult bare = fit_measurement(data, options);
    EXPECT_GT(std::abs(bare.points[0].k - silver.k), 0.3);
    options.roughness_nm = {5, false};
    const FitResult rough = fit_measurement(data, options);
    EXPECT_NEAR(rough.points[0].n, silver.n, 1e-6);
    EXPECT_NEAR(rough.points[0].k, silver.k, 1e-6);
    ASSERT_EQ(rough.layers.size(), 1u);
    EXPECT_EQ(rough.layers[0].thickness_nm, 5);
}

TEST(FilmAverage, WhatAutoTookIsRefittedAsItWas) {
    Sample sample;
    sample.spread_nm = 20;
    FitOptions options = anodised_options();
    options.model = "auto";
    options.film.spread_nm = {20, false};
    const FitResult fit = fit_measurement(measured(sample, 9, 6), options);
    EXPECT_EQ(fit.model, "film");
    EXPECT_EQ(fit.thickness_spread_nm, 20);
    EXPECT_NEAR(fit.chi2_reduced(), 1, 0.3);
    const FitOptions again = options_taken(options, fit);
    EXPECT_EQ(again.film.spread_nm.value, 20);
    // A bulk that was taken keeps nothing of the film's options.
    SimulationSetup setup;
    setup.wavelengths_nm = parse_grid("400:700:20", "wavelengths");
    setup.angles_deg = {60, 70};
    const Measurement bare = simulate_ellipsometer(find_material("Cu-McPeak"), setup);
    options.roughness_nm = {0, true};
    const FitResult bulk = fit_measurement(bare, options);
    ASSERT_EQ(bulk.model, "bulk");
    EXPECT_NO_THROW(fit_measurement(bare, options_taken(options, bulk)));
}

TEST(FilmAverage, BadOptionsAreRefused) {
    const Measurement data = measured({}, 1, 20);
    FitOptions options;
    options.roughness_nm = {0, true};
    EXPECT_THROW(fit_measurement(data, options), Error);  // on unknown n and k
    options.roughness_nm = {-1, false};
    EXPECT_THROW(fit_measurement(data, options), Error);
    options = {};
    options.film.bandwidth_nm = 4;
    EXPECT_THROW(fit_measurement(data, options), Error);  // no film
    options = anodised_options();
    options.film.bandwidth_nm = 400;
    EXPECT_THROW(fit_measurement(data, options), Error);
    options = anodised_options();
    options.film.spread_nm = {std::nan(""), false};
    EXPECT_THROW(fit_measurement(data, options), Error);
    // No fringe is left; nodes for it would alias.
    options.film.spread_nm = {300, false};
    EXPECT_THROW(fit_measurement(data, options), Error);
}

}  // namespace
}  // namespace drude
