// Formulas of n and k over the wavelengths: known values, derivatives, causality, and what fits of
// them reach on simulated metals.
#include "materials/dispersion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/dispersion_model.h"
#include "fitter/fit.h"
#include "fitter/kramers_kronig_spline.h"
#include "fitter/model_curve.h"

namespace drude {
namespace {

// 2/pi P int x e(x)/(x^2 - E^2) dx from 0 to `last` by the midpoint rule, E between two nodes, so
// that what diverges cancels.
double transformed(const std::function<double(double)>& e, double energy, double last) {
    const double step = energy / 20000;
    double sum = 0;
    for (double i = 0.5; i * step < last; ++i) {
        const double x = i * step;
        sum += x * e(x) / ((x - energy) * (x + energy));
    }
    return 2 / pi * sum * step;
}

TEST(Dispersion, PhotonEnergyOfTheHeliumNeonLine) {
    EXPECT_NEAR(photon_energy(632.8), 1.959295, 1e-6);
}

TEST(Dispersion, TermsHaveTheirClosedFormsAtKnownPoints) {
    // At E = G the free electrons give -Ep^2/(2 E^2) (1 - i).
    const Complex<double> free = drude_term(6.0, 2.0, 2.0);
    EXPECT_NEAR(free.re, -4.5, 1e-14);
    EXPECT_NEAR(free.im, 4.5, 1e-14);
    // At resonance f E0/G i, at rest f.
    const Complex<double> bound = lorentz_term(1.5, 3.0, 0.5, 3.0);
    EXPECT_NEAR(bound.re, 0, 1e-14);
    EXPECT_NEAR(bound.im, 9, 1e-13);
    EXPECT_NEAR(lorentz_term(1.5, 3.0, 0.5, 0.0).re, 1.5, 1e-14);
    // A critical point of phase 0 is 2 A W (W - i G)/... at E = 0: 2 A W^2/(W^2 + G^2).
    const Complex<double> edge = critical_point_term(0.7, 2.5, 0.4, 0.0, 0.0);
    EXPECT_NEAR(edge.re, 2 * 0.7 * 6.25 / (6.25 + 0.16), 1e-14);
    EXPECT_NEAR(edge.im, 0, 1e-15);
    EXPECT_NEAR(sellmeier_term(1.0, 0.1, 0.2).re, 0.04 / 0.03, 1e-14);
}

TEST(Dispersion, GoldOfEtchegoinIsNearJohnsonAndChristy) {
    // Table I of Etchegoin, Le Ru & Meyer 2006, whose formula is in wavelengths.
    using Complex64 = std::complex<double>;
    const double plasma = 145, damping = 17000;
    const double amplitudes[] = {0.94, 1.36}, lines[] = {468, 331}, widths[] = {2300, 940};
    double square = 0;
    for (const double nm : {450.0, 550.0, 633.0, 700.0}) {
        const Complex64 i(0, 1), turn = std::exp(-i * (pi / 4));
        Complex64 wanted = 1.53 - 1.0 / (plasma * plasma * (1 / (nm * nm) + i / (damping * nm)));
        const double energy = photon_energy(nm);
        Complex<double> sum = drude_term(photon_energy(plasma), photon_energy(damping), energy);
        for (int j = 0; j < 2; ++j) {
            wanted += amplitudes[j] / lines[j] *
                      (turn / (1 / lines[j] - 1 / nm - i / widths[j]) +
                       std::conj(turn) / (1 / lines[j] + 1 / nm + i / widths[j]));
            sum = sum + critical_point_term(amplitudes[j], photon_energy(lines[j]),
                                            photon_energy(widths[j]), -pi / 4, energy);
        }
        EXPECT_NEAR(1.53 + sum.re, wanted.real(), 1e-12);
        EXPECT_NEAR(sum.im, wanted.imag(), 1e-12);
        const Index gold = published_set("Au-Johnson").at(nm);
        square += std::norm(wanted - std::pow(Complex64(gold.n, gold.k), 2)) / 4;
    }
    EXPECT_LT(std::sqrt(square), 0.7);
}

TEST(Dispersion, TermsObeyKramersAndKronig) {
    const auto oscillator = [](double x) { return lorentz_term(1.5, 3.0, 0.8, x).im; };
    const auto edge = [](double x) { return critical_point_term(0.9, 2.6, 0.5, -0.8, x).im; };
    for (const double energy : {1.7, 2.4, 3.1}) {
        EXPECT_NEAR(transformed(oscillator, energy, 2000), lorentz_term(1.5, 3.0, 0.8, energy).re,
                    2e-4);
        // Its tail falls as 1/x only, so the integral misses 1/(2000 eV).
        EXPECT_NEAR(transformed(edge, energy, 2000),
                    critical_point_term(0.9, 2.6, 0.5, -0.8, energy).re, 5e-3);
    }
}

TEST(Dispersion, SplineIsItsOwnKramersKronigTransform) {
    const KramersKronigSpline spline(1.6, 3.3, 5);
    ASSERT_EQ(spline.count(), 8);
    for (int i = 0; i < spline.count(); ++i) {
        const auto absorption = [&](double x) { return spline.function(i, x).imag(); };
        for (const double energy : {1.3, 2.05, 2.9, 5.0}) {
            EXPECT_NEAR(spline.function(i, energy).real(), transformed(absorption, energy, 6), 2e-6)
                << i << " at " << energy;
        }
    }
}

TEST(Dispersion, SplinesSumToOneWhereAllOfThemAre) {
    const KramersKronigSpline spline(1.6, 3.3, 5);
    for (const double energy : {1.6, 2.0, 2.77, 3.3}) {
        double sum = 0;
        for (int i = 0; i < spline.count(); ++i) sum += spline.function(i, energy).imag();
        EXPECT_NEAR(sum, 1, 1e-12);
    }
}

TEST(Dispersion, SplineKnotsStayAboveZero) {
    EXPECT_THROW(KramersKronigSpline(0.5, 3.5, 4), Error);
    const int fewest = KramersKronigSpline::fewest_intervals(0.5, 3.5);
    EXPECT_NO_THROW(KramersKronigSpline(0.5, 3.5, fewest));
    EXPECT_THROW(KramersKronigSpline(0.5, 3.5, fewest - 1), Error);
}

TEST(Dispersion, DerivativesOfEveryModelAreThoseOfDifferences) {
    const std::vector<double> wavelengths = {400, 520, 700};
    for (const char* name : {"drude", "drude+2cp", "drude+2lorentz+cp", "3lorentz", "cauchy",
                             "3sellmeier", "bruggeman:Au-McPeak,Ag-McPeak", "spline:6"}) {
        const DispersionModel model(name, wavelengths);
        std::vector<double> p;
        for (const DispersionParameter& parameter : model.parameters()) {
            p.push_back(std::lerp(parameter.first, parameter.last, 0.4));
        }
        std::vector<std::complex<double>> derivatives(model.count()), ignored(model.count());
        for (size_t i = 0; i < wavelengths.size(); ++i) {
            model.epsilon(i, p.data(), derivatives.data());
            for (size_t j = 0; j < model.count(); ++j) {
                const double h = 1e-5;
                std::vector<double> up = p, down = p;
                up[j] += h;
                down[j] -= h;
                const auto difference = (model.epsilon(i, up.data(), ignored.data()) -
                                         model.epsilon(i, down.data(), ignored.data())) /
                                        (2 * h);
                EXPECT_LT(std::abs(difference - derivatives[j]),
                          1e-6 * (1 + std::abs(derivatives[j])))
                    << name << ", " << model.parameters()[j].name;
            }
        }
    }
}

TEST(Dispersion, UnknownNamesAreRefusedWithTheNearest) {
    const std::vector<double> wavelengths = {400, 500};
    for (const char* name :
         {"drud", "drude+", "drude+drude", "2drude", "drude+9cp", "spline:0",
          "spline:", "bruggeman:Au", "bruggeman:Au,Xx", "4sellmeier", "", "99"}) {
        EXPECT_THROW(DispersionModel(name, wavelengths), Error) << name;
    }
    // A mixture of what is not known at all wavelengths.
    EXPECT_THROW(DispersionModel("bruggeman:Au-McPeak,Ag-McPeak", {100, 500}), Error);
    try {
        DispersionModel("drude+2lorenz", wavelengths);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(error.message().find("lorentz"), std::string::npos) << error.message();
    }
}

Measurement measured_metal(const char* set, uint64_t seed) {
    SimulationSetup setup;
    setup.wavelengths_nm = parse_grid("380:750:5", "wavelengths");
    setup.angles_deg = {45, 50, 60, 70, 75, 80};
    setup.seed = seed;
    return simulate_ellipsometer(material_from_set(published_set(set)), setup);
}

struct MetalFormula {
    const char* set;
    const char* formula;
    int parameters;
    double most;  // reduced chi-square
};

// How well formulas follow published metals at noise of 0.05 and 0.1 degrees. The bounds are the
// reduced chi-squares that a search by another program reached (drude+2cp: Cu 1.8, Au 1.4, Ag 1.0,
// Al 1.0; drude+lorentz on Ag 1.02), with room for another seed.
class MetalFormulas : public testing::TestWithParam<MetalFormula> {};

TEST_P(MetalFormulas, FitAsWellAsTheyCan) {
    const MetalFormula& c = GetParam();
    FitOptions options;
    options.dispersion = c.formula;
    const FitResult fit = fit_measurement(measured_metal(c.set, 7), options);
    EXPECT_EQ(fit.parameters, c.parameters);
    EXPECT_LT(fit.chi2_reduced(), c.most);
    EXPECT_GT(fit.chi2_reduced(), 0.8);
}

INSTANTIATE_TEST_SUITE_P(Published, MetalFormulas,
                         testing::Values(MetalFormula{"Cu-McPeak", "drude+2cp", 11, 2.1},
                                         MetalFormula{"Au-McPeak", "drude+2cp", 11, 1.7},
                                         MetalFormula{"Ag-McPeak", "drude+lorentz", 6, 1.15},
                                         MetalFormula{"Al-Rakic", "drude+2lorentz", 9, 1.2},
                                         MetalFormula{"Fe-Johnson", "drude+2cp", 11, 6}));

TEST(Dispersion, SigmasOfTheFormulaCoverTheTruth) {
    // Data that the formula can explain: made with one.
    Material metal = find_material("Ag-McPeak");
    OpticalConstants& c = metal.substrate;
    c.wavelength_nm = parse_grid("380:750:5", "wavelengths");
    c.n.clear();
    c.k.clear();
    for (const double nm : c.wavelength_nm) {
        const Complex<double> e = drude_term(9.0, 0.05, photon_energy(nm)) +
                                  lorentz_term(1.2, 4.5, 0.6, photon_energy(nm));
        const auto N = sqrt_first_quadrant(Complex<double>{2.5 + e.re, e.im});
        c.n.push_back(N.re);
        c.k.push_back(N.im);
    }
    FitOptions options;
    options.dispersion = "drude+lorentz";
    int within = 0, points = 0;
    double chi2 = 0;
    const int draws = 12;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        SimulationSetup setup;
        setup.wavelengths_nm = c.wavelength_nm;
        setup.angles_deg = {60, 70, 75};
        setup.seed = seed;
        const FitResult fit = fit_measurement(simulate_ellipsometer(metal, setup), options);
        chi2 += fit.chi2_reduced() / draws;
        for (size_t i = 0; i < fit.points.size(); i += 15, ++points) {
            within += std::abs(fit.points[i].k - c.k[i]) < fit.points[i].sigma_k ? 1 : 0;
        }
        // Far below those of single wavelengths: 75 of them share six parameters.
        FitOptions by_itself;
        const FitResult single = fit_measurement(simulate_ellipsometer(metal, setup), by_itself);
        EXPECT_LT(fit.points[40].sigma_k, 0.5 * single.points[40].sigma_k);
    }
    EXPECT_NEAR(chi2, 1, 0.05);
    // 68 % expected; points of one draw share their parameters, so that the scatter is wide.
    EXPECT_GT(within, 0.4 * points);
    EXPECT_LT(within, 0.92 * points);
}

TEST(Dispersion, CompactTakesNoMoreThanTheDataNeed) {
    FitOptions options;
    options.dispersion = "compact";
    const FitResult silver = fit_measurement(measured_metal("Ag-McPeak", 3), options);
    EXPECT_EQ(silver.dispersion, "drude+cp");
    ASSERT_EQ(silver.ladder.size(), 3u);
    EXPECT_FALSE(silver.ladder[2].taken);
    const FitResult copper = fit_measurement(measured_metal("Cu-McPeak", 3), options);
    EXPECT_EQ(copper.dispersion, "drude+2cp");
}

TEST(Dispersion, SplineFollowsCopperWithNonNegativeAbsorption) {
    FitOptions options;
    options.dispersion = "spline";
    const FitResult fit = fit_measurement(measured_metal("Cu-McPeak", 3), options);
    EXPECT_LT(fit.chi2_reduced(), 1.3);
    for (const FittedPoint& point : fit.points) {
        EXPECT_NEAR(point.k, published_set("Cu-McPeak").at(point.wavelength_nm).k, 0.05);
        EXPECT_GE(point.k, 0);
    }
    for (const FittedParameter& parameter : fit.common) EXPECT_GE(parameter.value, 0);
}

TEST(Dispersion, MixtureFractionComesBack) {
    const std::vector<double> wavelengths = parse_grid("380:750:10", "wavelengths");
    const DispersionModel mixture("bruggeman:Au-McPeak,Ag-McPeak", wavelengths);
    Material metal = find_material("Au-McPeak");
    OpticalConstants& c = metal.substrate;
    c.wavelength_nm = wavelengths;
    c.n.clear();
    c.k.clear();
    const double fraction = 0.35;
    for (size_t i = 0; i < wavelengths.size(); ++i) {
        Index index;
        ASSERT_TRUE(mixture.index(i, &fraction, &index, nullptr, nullptr));
        c.n.push_back(index.n);
        c.k.push_back(index.k);
    }
    SimulationSetup setup;
    setup.wavelengths_nm = wavelengths;
    setup.angles_deg = {70};
    setup.seed = 5;
    FitOptions options;
    options.dispersion = mixture.name();
    const FitResult fit = fit_measurement(simulate_ellipsometer(metal, setup), options);
    ASSERT_EQ(fit.common.size(), 1u);
    EXPECT_NEAR(fit.common[0].value, fraction, 5 * fit.common[0].sigma);
    EXPECT_LT(fit.common[0].sigma, 0.001);
}

TEST(Dispersion, OffsetOfTheAnglesIsFoundBesideAFormula) {
    Measurement data = measured_metal("Ag-McPeak", 11);
    for (MeasurementRow& row : data.rows) row.angle_deg -= 0.2;
    FitOptions options;
    options.dispersion = "drude+lorentz";
    options.fit_angle_offset = true;
    const FitResult fit = fit_measurement(data, options);
    const FittedParameter& offset = fit.common.back();
    EXPECT_EQ(offset.name, "angle offset");
    EXPECT_NEAR(offset.value, 0.2, 4 * offset.sigma);
    EXPECT_LT(offset.sigma, 0.01);
}

TEST(Dispersion, OneAngleOfTan2PsiIsEnoughForAFormula) {
    // Wavelength by wavelength there is one datum for two unknowns; free electrons tie them
    // together.
    Material metal = find_material("Ag-McPeak");
    OpticalConstants& c = metal.substrate;
    c.wavelength_nm = parse_grid("380:750:5", "wavelengths");
    c.n.clear();
    c.k.clear();
    for (const double nm : c.wavelength_nm) {
        const Complex<double> e = drude_term(9.0, 0.5, photon_energy(nm));
        const auto N = sqrt_first_quadrant(Complex<double>{4 + e.re, e.im});
        c.n.push_back(N.re);
        c.k.push_back(N.im);
    }
    SimulationSetup setup;
    setup.wavelengths_nm = c.wavelength_nm;
    setup.angles_deg = {75};
    setup.seed = 2;
    const Measurement data = simulate_ellipsometer(metal, setup);
    FitOptions options;
    options.estimator = "rho2";
    EXPECT_THROW(fit_measurement(data, options), Error);
    options.dispersion = "drude";
    const FitResult fit = fit_measurement(data, options);
    EXPECT_EQ(fit.parameters, 3);
    EXPECT_NEAR(fit.chi2_reduced(), 1, 0.5);
    EXPECT_NEAR(fit.common[1].value, 9, 5 * fit.common[1].sigma);
    for (size_t i = 0; i < fit.points.size(); ++i) {
        EXPECT_NEAR(fit.points[i].k, c.k[i], 5 * fit.points[i].sigma_k);
    }
}

TEST(Dispersion, NamesWhatIsLeftOpen) {
    // Silver from 600 nm on is free electrons: an oscillator among six is not determined.
    Measurement data = measured_metal("Ag-McPeak", 2);
    FitOptions options;
    options.first_nm = 600;
    options.dispersion = "drude+6lorentz";
    const FitResult fit = fit_measurement(data, options);
    int open = 0;
    for (const FittedParameter& parameter : fit.common) {
        open += parameter.identifiable ? 0 : 1;
        EXPECT_EQ(parameter.identifiable, std::isfinite(parameter.sigma)) << parameter.name;
    }
    EXPECT_GT(open, 0);
    // n and k are determined all the same.
    for (const FittedPoint& point : fit.points) {
        EXPECT_NEAR(point.k, published_set("Ag-McPeak").at(point.wavelength_nm).k, 0.02);
        EXPECT_LT(point.sigma_k, 0.01);
    }
}

TEST(Dispersion, ParametersThatAreOpenLeaveTheOffsetItsSigma) {
    // One wavelength does not tell the plasma energy from eps_inf; six angles tell their error.
    Measurement data = measured_metal("Cu-McPeak", 5);
    std::vector<MeasurementRow> rows;
    for (const MeasurementRow& row : data.rows) {
        if (row.wavelength_nm == 500) rows.push_back(row);
    }
    data.rows = rows;
    FitOptions options;
    options.fit_angle_offset = true;
    const FitResult point = fit_measurement(data, options);
    options.dispersion = "drude";
    const FitResult formula = fit_measurement(data, options);
    EXPECT_FALSE(formula.common[0].identifiable);
    const FittedParameter& offset = formula.common.back();
    ASSERT_TRUE(offset.identifiable);
    EXPECT_NEAR(offset.value, point.common[0].value, 0.1 * point.common[0].sigma);
    EXPECT_NEAR(offset.sigma, point.common[0].sigma, 0.05 * point.common[0].sigma);
}

TEST(Dispersion, DataThatHoldNothingAreRefused) {
    Measurement data = measured_metal("Cu-McPeak", 5);
    for (size_t i = 0; i < data.rows.size(); ++i) {
        const auto noise = normal_pair(3, i);
        data.rows[i].psi_deg = 45 + 0.05 * noise[0];
        data.rows[i].delta_deg = 180 + 0.1 * noise[1];
    }
    for (const char* formula : {"drude", "cauchy", "drude+cp"}) {
        FitOptions options;
        options.dispersion = formula;
        EXPECT_THROW(fit_measurement(data, options), Error) << formula;
    }
}

TEST(Dispersion, RefitsStartFromTheFit) {
    // Two critical points may trade places from one search to the next; from the fit they do not.
    const Measurement data = measured_metal("Cu-McPeak", 3);
    FitOptions options;
    options.dispersion = "drude+2cp";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.dispersion_parameters.size(), 11u);
    FitOptions again = options_taken(options, fit);
    const FitResult second = fit_measurement(measured_metal("Cu-McPeak", 4), again);
    for (size_t i = 0; i < fit.common.size(); ++i) {
        if (fit.common[i].name.rfind("critical point", 0) != 0) continue;
        EXPECT_NEAR(second.common[i].value, fit.common[i].value, 0.5) << fit.common[i].name;
    }
    EXPECT_LT(std::abs(second.chi2_reduced() - fit.chi2_reduced()), 0.3);
}

TEST(Dispersion, SameBitsOnAnyNumberOfThreads) {
    const Measurement data = measured_metal("Au-McPeak", 4);
    FitOptions options;
    options.dispersion = "drude+cp";
    options.threads = 1;
    const FitResult one = fit_measurement(data, options);
    options.threads = 3;
    const FitResult three = fit_measurement(data, options);
    ASSERT_EQ(one.common.size(), three.common.size());
    for (size_t i = 0; i < one.common.size(); ++i) {
        EXPECT_EQ(one.common[i].value, three.common[i].value);
    }
}

}  // namespace
}  // namespace drude
