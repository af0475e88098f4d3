// What a fit chooses: for each decision a measurement where the richer model tells nothing and the
// cheap one is taken, and one where it tells and is taken.
#include "fitter/decisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/error.h"
#include "base/numbers.h"
#include "film_cases.h"
#include "fit_cases.h"
#include "fitter/angle_choice.h"
#include "fitter/dispersion_choice.h"
#include "fitter/named_constants.h"
#include "fitter/robust_choice.h"
#include "materials/dispersion.h"

namespace drude {
namespace {

Measurement simulated(const Material& material, uint64_t seed,
                      const std::vector<double>& angles_deg = paper_angles()) {
    SimulationSetup setup;
    setup.angles_deg = angles_deg;
    setup.wavelengths_nm = parse_grid("400:700:10", "wavelengths");
    setup.seed = seed;
    return simulate_ellipsometer(material, setup);
}

// A metal of free electrons alone: epsilon = 1 - Ep^2/(E^2 + i G E).
Material drude_metal() {
    OpticalConstants set;
    set.name = "free electrons";
    set.kind = "calculated";
    for (double nm = 390; nm <= 710; nm += 1) {
        const Complex<double> term = drude_term(12.0, 0.6, photon_energy(nm));
        const std::complex<double> index = std::sqrt(std::complex<double>(1 + term.re, term.im));
        set.wavelength_nm.push_back(nm);
        set.n.push_back(index.real());
        set.k.push_back(index.imag());
    }
    return material_from_set(set);
}

double rms_error(const FitResult& fit, const OpticalConstants& truth) {
    double sum = 0;
    for (const FittedPoint& point : fit.points) {
        const Index index = truth.at(point.wavelength_nm);
        sum += std::pow(point.n - index.n, 2) + std::pow(point.k - index.k, 2);
    }
    return std::sqrt(sum / static_cast<double>(fit.points.size()));
}

ModelDecision decision_on(const Measurement& data, const FitOptions& options,
                          const std::string& name) {
    const FitResult fit = fit_measurement(data, options);
    for (ModelDecision& decision :
         decisions(data, options, fit, other_substrates(data, options, fit))) {
        if (decision.name == name) return std::move(decision);
    }
    throw std::logic_error("no decision on " + name);
}

TEST(FitDecisions, EachHasAReasonAFigureAndAnOption) {
    FitOptions automatic = anodised_options();
    automatic.model = "auto";
    automatic.dispersion = "auto";
    for (const FitOptions& options : {FitOptions{}, automatic}) {
        const Measurement data = simulated(find_material("Cu-McPeak"), 1, {60, 70});
        const FitResult fit = fit_measurement(data, options);
        const auto all = decisions(data, options, fit, other_substrates(data, options, fit));
        EXPECT_EQ(all.size(), 7u);
        for (const ModelDecision& decision : all) {
            EXPECT_FALSE(decision.choice.empty()) << decision.name;
            EXPECT_FALSE(decision.reason.empty()) << decision.name;
            EXPECT_FALSE(decision.override_option.empty()) << decision.name;
            EXPECT_FALSE(decision.cost.basis.empty()) << decision.name;
            EXPECT_FALSE(decision.error.basis.empty()) << decision.name;
            EXPECT_FALSE(decision.asked) << decision.name;
        }
    }
}

// ---- film or bare ------------------------------------------------------------------------------

TEST(FitDecisions, BareMetalTakesNoFilm) {
    FitOptions options = anodised_options();
    options.model = "auto";
    const ModelDecision decision =
        decision_on(simulated(find_material("Al-Rakic"), 3), options, "film or bare");
    EXPECT_EQ(decision.choice, "bulk");
    // The film, too, describes bare metal: it tells nothing more.
    const auto film = std::find_if(
        decision.alternatives.begin(), decision.alternatives.end(),
        [](const DecisionAlternative& other) { return other.choice.rfind("film", 0) == 0; });
    ASSERT_NE(film, decision.alternatives.end());
    EXPECT_NE(film->choice.find("("), std::string::npos) << "no objection";
}

TEST(FitDecisions, AnAnodisedMetalTakesAFilm) {
    FitOptions options = anodised_options();
    options.model = "auto";
    const Measurement data = measured_film(900, 0.2, 4, {50, 60, 70});
    const ModelDecision decision = decision_on(data, options, "film or bare");
    EXPECT_EQ(decision.choice, "film");
    EXPECT_NEAR(decision.error.value.value(), 1, 0.2);
    // Bare of it n and k miss.
    ASSERT_EQ(decision.alternatives[0].choice.rfind("bulk", 0), 0u);
    EXPECT_GT(decision.alternatives[0].error.value.value(), 100);
}

// ---- point by point or a formula ---------------------------------------------------------------

TEST(FitDecisions, FreeElectronsTakeTheirFormula) {
    const Material metal = drude_metal();
    FitOptions options;
    options.dispersion = "auto";
    FitOptions points;
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        const Measurement data = simulated(metal, seed);
        const FitResult automatic = fit_measurement(data, options);
        EXPECT_EQ(automatic.dispersion, "drude");
        ASSERT_EQ(automatic.ladder.size(), 2u);
        EXPECT_TRUE(automatic.ladder[1].taken);
        // The same constants, with less noise.
        const double with = rms_error(automatic, metal.substrate);
        const double without = rms_error(fit_measurement(data, points), metal.substrate);
        EXPECT_LT(with, without / 2);
    }
}

TEST(FitDecisions, CopperStaysPointByPoint) {
    FitOptions options, formula;
    options.dispersion = "auto";
    formula.dispersion = "compact";
    const Material copper = find_material("Cu-McPeak");
    const Measurement data = simulated(copper, 2);
    const FitResult automatic = fit_measurement(data, options);
    EXPECT_EQ(automatic.dispersion, "");
    ASSERT_EQ(automatic.ladder.size(), 2u);
    EXPECT_FALSE(automatic.ladder[1].taken);
    EXPECT_FALSE(automatic.ladder[1].objection.empty());
    // The formula's error is more than the noise of the points.
    EXPECT_GT(rms_error(fit_measurement(data, formula), copper.substrate),
              1.3 * rms_error(automatic, copper.substrate));
    const ModelDecision by_default = decision_on(data, {}, "point by point or formula");
    EXPECT_EQ(by_default.choice, "point by point");
    EXPECT_EQ(by_default.reason.find("would take"), std::string::npos);
}

Measurement with_sigmas_times(Measurement data, double factor) {
    for (MeasurementRow& row : data.rows) {
        row.sigma_psi_deg *= factor;
        row.sigma_delta_deg *= factor;
    }
    return data;
}

TEST(FitDecisions, SigmasStatedTooLargeSayNothingAgainstAFormula) {
    FitOptions options;
    options.dispersion = "auto";
    for (const double factor : {1.3, 2.0, 4.0}) {
        const FitResult fit =
            fit_measurement(with_sigmas_times(simulated(drude_metal(), 1), factor), options);
        EXPECT_EQ(fit.dispersion, "drude") << fit.ladder.at(1).objection;
        EXPECT_NEAR(fit.chi2_reduced() * factor * factor, 1, 0.25);
    }
}

// What the formula is off by shows in the points' own residuals, whatever was stated.
TEST(FitDecisions, SigmasStatedTooLargeDoNotHideWhatAFormulaIsOffBy) {
    FitOptions options;
    options.dispersion = "auto";
    const Measurement copper = simulated(find_material("Cu-McPeak"), 2);
    for (const double factor : {1.0, 1.5, 3.0}) {
        const FitResult fit = fit_measurement(with_sigmas_times(copper, factor), options);
        EXPECT_EQ(fit.dispersion, "") << factor;
        EXPECT_FALSE(fit.ladder.at(1).objection.empty()) << factor;
    }
}

TEST(FitDecisions, SigmasStatedTooSmallSpeakAgainstAFormula) {
    FitOptions options;
    options.dispersion = "auto";
    const FitResult fit =
        fit_measurement(with_sigmas_times(simulated(drude_metal(), 1), 0.5), options);
    EXPECT_EQ(fit.dispersion, "");
    EXPECT_NE(fit.ladder.at(1).objection.find("above 1 +"), std::string::npos)
        << fit.ladder.at(1).objection;
}

TEST(FitDecisions, WithoutSigmasTheCriterionAloneDecides) {
    FitOptions options;
    options.dispersion = "auto";
    options.unweighted = true;
    const Measurement data = simulated(drude_metal(), 1, {60, 70});
    EXPECT_EQ(fit_measurement(data, options).dispersion, "drude");
    const ModelDecision decision = decision_on(data, options, "point by point or formula");
    EXPECT_EQ(decision.reason.find("chi-square"), std::string::npos) << decision.reason;
    EXPECT_EQ(decision.error.unit.find("chi-square"), std::string::npos) << decision.error.unit;
    options.unweighted = false;
    EXPECT_NE(decision_on(data, options, "point by point or formula").reason.find("chi-square"),
              std::string::npos);
}

// Psi and Delta of one angle are n and k: there is no residual to take the logarithm of.
TEST(FitDecisions, OneAngleWithoutSigmasIsComparedWithNothing) {
    FitOptions options;
    options.dispersion = "auto";
    options.unweighted = true;
    const Measurement data = simulated(drude_metal(), 1, {70});
    const FitResult fit = fit_measurement(data, options);
    EXPECT_EQ(fit.dispersion, "");
    ASSERT_EQ(fit.ladder.size(), 2u);
    EXPECT_TRUE(std::isnan(fit.ladder[0].bic));
    EXPECT_TRUE(std::isfinite(fit.ladder[1].bic));
    EXPECT_EQ(fit.ladder[1].objection.find("BIC"), std::string::npos) << fit.ladder[1].objection;
    EXPECT_NE(fit.ladder[1].objection.find("no residuals"), std::string::npos)
        << fit.ladder[1].objection;
    const ModelDecision decision = decision_on(data, options, "point by point or formula");
    EXPECT_FALSE(decision.error.value.has_value());
    EXPECT_EQ(decision.error.basis.find("BIC"), std::string::npos) << decision.error.basis;
    // With standard deviations the criterion is there, and the formula is worth it.
    options.unweighted = false;
    EXPECT_EQ(fit_measurement(data, options).dispersion, "drude");
}

TEST(FitDecisions, TheDefaultSaysWhatAutoWouldTake) {
    const ModelDecision decision =
        decision_on(simulated(drude_metal(), 1), {}, "point by point or formula");
    EXPECT_EQ(decision.choice, "point by point");
    EXPECT_NE(decision.reason.find("--dispersion auto would take drude"), std::string::npos)
        << decision.reason;
}

// ---- angles ------------------------------------------------------------------------------------

TEST(FitDecisions, OneAngleOfPsiAndDeltaDoesForCopper) {
    const Measurement data = simulated(find_material("Cu-McPeak"), 1);
    const FitResult fit = fit_measurement(data, {});
    const AngleChoice choice = angle_choice(data, {}, fit);
    EXPECT_EQ(choice.all.angles_deg.size(), 6u);
    ASSERT_EQ(choice.needed.angles_deg.size(), 1u);
    // Information predicts what a fit of those rows finds.
    const FitResult one = fit_measurement(at_angles(data, choice.needed.angles_deg), {});
    std::vector<double> sigmas;
    for (const FittedPoint& point : one.points) {
        sigmas.push_back(std::hypot(point.sigma_n, point.sigma_k));
    }
    std::nth_element(sigmas.begin(), sigmas.begin() + 15, sigmas.end());
    EXPECT_NEAR(sigmas[15] / choice.needed.sigma, 1, 0.05);
    EXPECT_LE(choice.needed.sigma, enough_sigma * choice.all.sigma);
    const OpticalConstants& truth = published_set("Cu-McPeak");
    EXPECT_LT(rms_error(one, truth), 3 * choice.all.sigma);
}

TEST(FitDecisions, SilverByPsiAloneTakesSeveral) {
    const Measurement data = simulated(find_material("Ag-Johnson"), 1);
    FitOptions options;
    options.estimator = "rho2";
    const FitResult fit = fit_measurement(data, options);
    const AngleChoice choice = angle_choice(data, options, fit);
    EXPECT_GE(choice.needed.angles_deg.size(), 2u);
    // One angle gives one number for two unknowns.
    EXPECT_TRUE(std::isinf(choice.best[0].sigma));
    // The steepest angle tells most.
    EXPECT_GT(choice.without.back().sigma, choice.without.front().sigma);
}

TEST(FitDecisions, FilmsTellWhatEachAngleIsWorth) {
    const Measurement data = measured_film(900, 0.2, 4, {50, 60, 70});
    const FitOptions options = anodised_options();
    const AngleChoice choice = angle_choice(data, options, fit_measurement(data, options));
    ASSERT_EQ(choice.without.size(), 3u);
    for (const AngleSet& set : choice.without) {
        EXPECT_EQ(set.angles_deg.size(), 2u);
        EXPECT_GT(set.sigma, choice.all.sigma);
        EXPECT_LT(set.sigma, 3 * choice.all.sigma);
    }
}

// What is left while one angle after another goes, not only what is left of all but one.
TEST(FitDecisions, FilmsTellHowFewAnglesWouldDo) {
    const Measurement data = measured_film(900, 0.2, 4, {50, 55, 60, 65, 70});
    const FitOptions options = anodised_options();
    const FitResult fit = fit_measurement(data, options);
    const AngleChoice choice = angle_choice(data, options, fit);
    EXPECT_EQ(choice.all.sigma, fit.common.front().sigma);
    const std::vector<double> needed = choice.needed.angles_deg;
    ASSERT_LT(needed.size(), 4u);
    EXPECT_LE(choice.needed.sigma, enough_sigma * choice.all.sigma);
    const FitResult alone = fit_measurement(at_angles(data, needed), options);
    EXPECT_NEAR(alone.common.front().sigma / choice.needed.sigma, 1, 1e-3);
    // The next to go would be one too many.
    ASSERT_GT(needed.size(), 1u);
    size_t too_many = 0;
    for (const double next : needed) {
        std::vector<double> fewer = needed;
        fewer.erase(std::find(fewer.begin(), fewer.end(), next));
        const double sigma = fit_measurement(at_angles(data, fewer), options).common.front().sigma;
        if (sigma > enough_sigma * choice.all.sigma) ++too_many;
    }
    EXPECT_GE(too_many, 1u);

    const ModelDecision decision = decision_on(data, options, "angles");
    EXPECT_EQ(decision.error.basis, "computed: the fit's own");
    ASSERT_FALSE(decision.alternatives.empty());
    EXPECT_NE(decision.alternatives[0].choice.find("alone"), std::string::npos);
    for (const DecisionAlternative& other : decision.alternatives) {
        EXPECT_EQ(other.error.basis, "computed: a fit of these angles alone");
    }
}

double median_sigma(const FitResult& fit) {
    std::vector<double> sigmas;
    for (const FittedPoint& point : fit.points) {
        sigmas.push_back(std::hypot(point.sigma_n, point.sigma_k));
    }
    std::nth_element(sigmas.begin(), sigmas.begin() + 15, sigmas.end());
    return sigmas.at(15);
}

// A formula knows n and k better than its wavelengths do by themselves.
TEST(FitDecisions, AFormulaStatesItsOwnStandardDeviation) {
    const Measurement data = simulated(drude_metal(), 1);
    FitOptions formula;
    formula.dispersion = "compact";
    const double own = median_sigma(fit_measurement(data, formula));
    const double by_points = median_sigma(fit_measurement(data, {}));
    ASSERT_LT(own, by_points / 2);
    for (const char* name : {"angles", "estimator"}) {
        const ModelDecision decision = decision_on(data, formula, name);
        EXPECT_DOUBLE_EQ(decision.error.value.value(), own) << name;
        EXPECT_NE(decision.alternatives.at(0).error.unit.find("point by point"), std::string::npos)
            << decision.alternatives.at(0).error.unit;
        const ModelDecision without = decision_on(data, {}, name);
        EXPECT_DOUBLE_EQ(without.error.value.value(), by_points) << name;
        EXPECT_EQ(without.alternatives.at(0).error.unit, "standard deviation of n + ik");
    }
}

// The information of rows without standard deviations is in units that the residuals tell.
TEST(FitDecisions, AnglesWithoutSigmasAreJudgedByTheResiduals) {
    const Measurement data = simulated(find_material("Cu-McPeak"), 1);
    FitOptions options;
    options.unweighted = true;
    const FitResult fit = fit_measurement(data, options);
    EXPECT_NEAR(angle_choice(data, options, fit).all.sigma / median_sigma(fit), 1, 1e-6);
}

TEST(FitDecisions, AnAngleThatIsNotThereIsRefused) {
    const Measurement data = simulated(find_material("Cu-McPeak"), 1, {60, 70});
    EXPECT_EQ(at_angles(data, {70}).angles(), std::vector<double>{70});
    EXPECT_THROW(at_angles(data, {65}), Error);
    EXPECT_THROW(at_angles(data, {}), Error);
}

// ---- estimator ---------------------------------------------------------------------------------

double loss_of_psi_alone(const char* metal, double sigma_delta_deg) {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = parse_grid("400:700:50", "wavelengths");
    setup.seed = 1;
    setup.sigma_delta_deg = sigma_delta_deg;
    const Measurement data = simulate_ellipsometer(find_material(metal), setup);
    const ModelDecision decision = decision_on(data, {}, "estimator");
    EXPECT_EQ(decision.choice, "psi-delta");
    return decision.alternatives[0].error.value.value() / decision.error.value.value();
}

TEST(FitDecisions, DeltaTellsMostOfAluminium) {
    EXPECT_GT(loss_of_psi_alone("Al-Rakic", 0.1), 10);
}

TEST(FitDecisions, ADeltaOfLargeErrorsTellsLittle) {
    EXPECT_LT(loss_of_psi_alone("Cu-McPeak", 20), 1.3);
}

// ---- robust ------------------------------------------------------------------------------------

TEST(FitDecisions, CleanDataTakeLeastSquares) {
    FitOptions automatic;
    automatic.robust = "auto";
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Measurement data = simulated(find_material("Cu-McPeak"), seed);
        const FitResult fit = fit_measurement(data, automatic);
        EXPECT_EQ(fit.robust, "");
        EXPECT_EQ(fit.chi2, fit_measurement(data, {}).chi2);
    }
}

TEST(FitDecisions, BadRowsTakeARobustLoss) {
    const Material copper = find_material("Cu-McPeak");
    Measurement data = simulated(copper, 1);
    for (size_t i = 7; i < data.rows.size(); i += 20) data.rows[i].delta_deg += 10;
    FitOptions automatic;
    automatic.robust = "auto";
    const FitResult robust = fit_measurement(data, automatic);
    EXPECT_EQ(robust.robust, "tukey");
    EXPECT_LT(5 * rms_error(robust, copper.substrate),
              rms_error(fit_measurement(data, {}), copper.substrate));
    EXPECT_NE(decision_on(data, {}, "robust").reason.find("--robust auto would take tukey"),
              std::string::npos);
}

TEST(FitDecisions, AWrongModelIsNoMatterOfBadRows) {
    const Measurement data = measured_film(900, 0.2, 4, {50, 60, 70});
    const FitResult bulk = fit_measurement(data, {});
    EXPECT_EQ(robust_choice(bulk, data, {}).loss, "none");
}

// ---- substrate, search -------------------------------------------------------------------------

TEST(FitDecisions, TheSubstrateCountsUnderAFilmAndNotWithoutOne) {
    const ModelDecision under =
        decision_on(measured_film(900, 0.2, 4), anodised_options(), "substrate");
    EXPECT_EQ(under.choice, "Al-Rakic");
    ASSERT_FALSE(under.alternatives.empty());
    EXPECT_GT(under.error.value.value(), 0.1);
    const ModelDecision bare =
        decision_on(simulated(find_material("Cu-McPeak"), 1), {}, "substrate");
    EXPECT_EQ(bare.choice, "none");
    EXPECT_EQ(bare.error.value.value(), 0);
}

TEST(FitDecisions, StartsAreCountedByWhereTheyEnd) {
    const double lost = std::numeric_limits<double>::infinity();
    const StartCount count = count_starts({100.00005, 100, lost, 100.001, 250});
    EXPECT_EQ(count.refined, 4);
    EXPECT_EQ(count.in_best, 2);
    EXPECT_DOUBLE_EQ(count.next_chi2_excess, 100.001 - 100);
    EXPECT_EQ(count_starts({lost, std::nan("")}).refined, 0);
    EXPECT_EQ(count_starts({}).in_best, 0);
    // Rounding is all that data without noise leave.
    EXPECT_EQ(count_starts({1e-22, 3e-20}).in_best, 2);
    EXPECT_EQ(count_starts({1e-22, 3e-20}).next_chi2_excess, 0);
}

TEST(FitDecisions, TheSearchOfAFormulaSaysWhereItsStartsEnd) {
    const Measurement data = simulated(find_material("Cu-McPeak"), 2);
    FitOptions options;
    options.dispersion = "drude+2cp";
    const FitResult fit = fit_measurement(data, options);
    EXPECT_GT(fit.starts.refined, 1);
    EXPECT_GE(fit.starts.in_best, 1);
    // Copper has more than one minimum of this formula.
    EXPECT_LT(fit.starts.in_best, fit.starts.refined);
    const ModelDecision decision = decision_on(data, options, "global search");
    EXPECT_EQ(decision.cost.value.value(), fit.starts.refined);
    EXPECT_EQ(decision.error.value.value(), fit.starts.refined - fit.starts.in_best);
    options.dispersion_start = fit.dispersion_parameters;
    const FitResult again = fit_measurement(data, options);
    EXPECT_EQ(again.starts.refined, 1);
    EXPECT_FALSE(decision_on(data, options, "global search").error.value.has_value());
}

TEST(FitDecisions, OneStartIsComparedWithNone) {
    const Measurement data = simulated(find_material("Cu-McPeak"), 1);
    const ModelDecision decision = decision_on(data, {}, "global search");
    EXPECT_EQ(decision.cost.value.value(), 31);  // wavelengths
    EXPECT_FALSE(decision.error.value.has_value());
    // Below a layer others are tried, and their ends are told.
    FitOptions layered;
    layered.model = "overlayer";
    layered.overlayers = {find_layer("Al2O3-Malitson-o,30", "layer")};
    const FitResult fit = fit_measurement(data, layered);
    EXPECT_GT(fit.starts.refined, 31);
    EXPECT_EQ(decision_on(data, layered, "global search").error.value.value(),
              fit.starts.refined - fit.starts.in_best);
}

TEST(FitDecisions, OnlyFilmsAreSearchedFor) {
    const ModelDecision film =
        decision_on(measured_film(1800, 0.2, 4), anodised_options(), "global search");
    EXPECT_EQ(film.choice.rfind("thickness up to", 0), 0u);
    EXPECT_LT(film.error.value.value(), 1e-6);
    EXPECT_GT(film.cost.value.value(), 1);
    // What the search is for: from a fringe's distance least squares ends in another minimum.
    const Measurement data = measured_film(1800, 0.2, 4);
    FitOptions beside = anodised_options();
    beside.film.start = FilmGuess{1500, 0.2};
    EXPECT_GT(fit_measurement(data, beside).chi2,
              10 * fit_measurement(data, anodised_options()).chi2);
    EXPECT_EQ(decision_on(simulated(find_material("Cu-McPeak"), 1), {}, "global search").choice,
              "none");
}

}  // namespace
}  // namespace drude
