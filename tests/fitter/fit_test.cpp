// Known answers of the point-by-point fit.
#include "fitter/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "fit_cases.h"

namespace drude {
namespace {

TEST(Fit, NoiseFreeDataGiveTheConstantsBack) {
    for (const MetalCase& metal : metal_cases()) {
        const Measurement data = measured(metal, paper_angles(), 0);
        for (const std::string estimator : {"psi-delta", "rho2", "inversion"}) {
            FitOptions options;
            options.estimator = estimator;
            const FitResult fit = fit_measurement(data, options);
            ASSERT_EQ(fit.points.size(), 1u);
            EXPECT_NEAR(fit.points[0].n, metal.n, 1e-8) << metal.name << " " << estimator;
            EXPECT_NEAR(fit.points[0].k, metal.k, 1e-8) << metal.name << " " << estimator;
            EXPECT_LT(fit.chi2, 1e-12) << metal.name << " " << estimator;
        }
    }
}

TEST(Fit, OneAngleOfPsiAndDeltaIsEnough) {
    for (const MetalCase& metal : metal_cases()) {
        for (const double angle : paper_angles()) {
            const FitResult fit = fit_measurement(measured(metal, {angle}, 0), {});
            EXPECT_NEAR(fit.points[0].n, metal.n, 1e-8) << metal.name << " at " << angle;
            EXPECT_NEAR(fit.points[0].k, metal.k, 1e-8) << metal.name << " at " << angle;
            EXPECT_EQ(fit.dof(), 0);
            EXPECT_TRUE(std::isnan(fit.chi2_reduced()));
        }
    }
}

// Standard deviations and conditions of an independent implementation (scipy, central
// differences), for 0.05 and 0.1 degrees; printed with two to four digits.
TEST(Fit, StandardDeviationsMatchAnIndependentImplementation) {
    for (const MetalCase& metal : metal_cases()) {
        FitOptions options;
        const FittedPoint both =
            fit_measurement(measured(metal, paper_angles(), 0), options).points[0];
        EXPECT_NEAR(both.sigma_n, metal.sd_n_both, 0.000051) << metal.name;
        EXPECT_NEAR(both.sigma_k, metal.sd_k_both, 0.000051) << metal.name;
        EXPECT_NEAR(both.condition, metal.condition_both, 0.051) << metal.name;
        options.estimator = "rho2";
        const FittedPoint rho2 =
            fit_measurement(measured(metal, paper_angles(), 0), options).points[0];
        EXPECT_NEAR(rho2.sigma_n, metal.sd_n_rho2, 0.000051) << metal.name;
        EXPECT_NEAR(rho2.sigma_k, metal.sd_k_rho2, metal.sd_k_rho2 > 0.1 ? 0.00051 : 0.000051)
            << metal.name;
        EXPECT_NEAR(rho2.condition, metal.condition_rho2, 0.051) << metal.name;
        EXPECT_NEAR(rho2.correlation, metal.correlation_rho2, 0.0051) << metal.name;
    }
}

TEST(Fit, InversionIsAsPreciseAsLeastSquaresForAMetal) {
    FitOptions options;
    options.estimator = "inversion";
    for (const MetalCase& metal : metal_cases()) {
        const Measurement data = measured(metal, paper_angles(), 0);
        const FittedPoint inverted = fit_measurement(data, options).points[0];
        const FittedPoint fitted = fit_measurement(data, {}).points[0];
        // Never better than the Cramer-Rao bound, and not much worse.
        EXPECT_GT(inverted.sigma_n, 0.999 * fitted.sigma_n) << metal.name;
        EXPECT_LT(inverted.sigma_n, 1.3 * fitted.sigma_n) << metal.name;
        EXPECT_GT(inverted.sigma_k, 0.999 * fitted.sigma_k) << metal.name;
        EXPECT_LT(inverted.sigma_k, 1.3 * fitted.sigma_k) << metal.name;
        EXPECT_NEAR(inverted.correlation, fitted.correlation, 0.2) << metal.name;
        EXPECT_LT(inverted.spread_n, 1e-9) << metal.name;
    }
}

TEST(Fit, DeltaInAnyWindowAndRowsInAnyOrderGiveTheSameBits) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 7);
    const FittedPoint expected = fit_measurement(data, {}).points[0];
    std::reverse(data.rows.begin(), data.rows.end());
    for (size_t i = 0; i < data.rows.size(); ++i) {
        // Dyadic values, so that turning by 360 degrees is exact.
        data.rows[i].delta_deg = std::round(data.rows[i].delta_deg * 1024) / 1024;
    }
    const FittedPoint rounded = fit_measurement(data, {}).points[0];
    EXPECT_NEAR(rounded.n, expected.n, 1e-3);
    for (size_t i = 0; i < data.rows.size(); ++i) data.rows[i].delta_deg += i % 2 ? 360 : -360;
    const FittedPoint turned = fit_measurement(data, {}).points[0];
    EXPECT_EQ(turned.n, rounded.n);
    EXPECT_EQ(turned.k, rounded.k);
    EXPECT_EQ(turned.chi2, rounded.chi2);
}

TEST(Fit, ThreadsDoNotChangeTheBits) {
    Measurement data;
    for (int i = 0; i < 40; ++i) {
        Measurement one = measured({"x", 0.5 + 0.02 * i, 2 + 0.05 * i}, paper_angles(), 100 + i);
        for (MeasurementRow& row : one.rows) {
            row.wavelength_nm = 400 + i;
            data.rows.push_back(row);
        }
    }
    FitOptions options;
    options.threads = 1;
    const FitResult serial = fit_measurement(data, options);
    options.threads = 7;
    const FitResult parallel = fit_measurement(data, options);
    ASSERT_EQ(serial.points.size(), 40u);
    EXPECT_EQ(serial.chi2, parallel.chi2);
    for (size_t i = 0; i < serial.points.size(); ++i) {
        EXPECT_EQ(serial.points[i].n, parallel.points[i].n);
        EXPECT_EQ(serial.points[i].k, parallel.points[i].k);
        EXPECT_EQ(serial.points[i].sigma_k, parallel.points[i].sigma_k);
    }
}

// Values of the notes' overlayer table: a thin oxide hides in pseudo constants.
TEST(Fit, ThinOxideIsAbsorbedInPseudoConstants) {
    Measurement data;
    for (const double angle : paper_angles()) {
        const ThinFilm<double> oxide{{1.77, 0}, 3};
        const Reflection<double> r = reflect(&oxide, 1, ComplexIndex<double>{0.871, 6.235},
                                             std::cos(angle * pi / 180), 516.0);
        MeasurementRow row;
        row.wavelength_nm = 516;
        row.angle_deg = angle;
        row.psi_deg = psi(r) * 180 / pi;
        row.delta_deg = delta(r) * 180 / pi;
        row.sigma_psi_deg = 0.05;
        row.sigma_delta_deg = 0.1;
        data.rows.push_back(row);
    }
    const FitResult fit = fit_measurement(data, {});
    EXPECT_NEAR(fit.points[0].n, 0.653, 0.02);
    EXPECT_NEAR(fit.points[0].k, 5.357, 0.03);
    EXPECT_LT(fit.chi2, 1);
}

Error refusal(const Measurement& data, const FitOptions& options) {
    try {
        fit_measurement(data, options);
    } catch (const Error& error) {
        return error;
    }
    return Error(Cause::outside, "was not refused");
}

TEST(Fit, OneAngleOfTan2PsiIsRefusedWithTheReason) {
    FitOptions options;
    options.estimator = "rho2";
    const Error error = refusal(measured(metal_cases()[0], {70}, 0), options);
    EXPECT_EQ(error.cause(), Cause::answer_is_no);
    EXPECT_NE(error.message().find("tan^2 Psi"), std::string::npos) << error.message();
    EXPECT_NE(error.message().find("1 angle"), std::string::npos) << error.message();
}

TEST(Fit, WavelengthsWithoutEnoughDataAreMarkedAmongTheOthers) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 0);
    MeasurementRow lonely = data.rows[0];
    lonely.wavelength_nm = 700;
    data.rows.push_back(lonely);
    FitOptions options;
    options.estimator = "rho2";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.points.size(), 2u);
    EXPECT_TRUE(fit.points[0].identifiable);
    EXPECT_FALSE(fit.points[1].identifiable);
    EXPECT_TRUE(std::isnan(fit.points[1].n));
    EXPECT_TRUE(std::isnan(fit.points[1].sigma_k));
    EXPECT_EQ(fit.parameters, 2);
    ASSERT_FALSE(fit.warnings.empty());
    EXPECT_NE(fit.warnings[0].find("700 nm"), std::string::npos) << fit.warnings[0];
}

TEST(Fit, NothingAboutDeltaWherePsiIsZero) {
    Measurement data;
    data.rows = {{550, 60, 0, 30, 0.05, 0.1}};
    const Error error = refusal(data, {});
    EXPECT_EQ(error.cause(), Cause::answer_is_no) << error.message();
}

TEST(Fit, RoughnessIsRefusedWithTheReason) {
    FitOptions options;
    options.lobe = "beckmann";
    const Error error = refusal(measured(metal_cases()[0], paper_angles(), 0), options);
    EXPECT_EQ(error.cause(), Cause::answer_is_no);
    EXPECT_NE(error.message().find("cancel"), std::string::npos);
}

TEST(Fit, UnknownWordsNameTheNearestAndAllThatExist) {
    FitOptions options;
    options.estimator = "psi-detla";
    Error error = refusal(measured(metal_cases()[0], paper_angles(), 0), options);
    EXPECT_EQ(error.cause(), Cause::user);
    EXPECT_NE(error.message().find("did you mean 'psi-delta'"), std::string::npos);
    options = {};
    options.model = "blk";
    error = refusal(measured(metal_cases()[0], paper_angles(), 0), options);
    EXPECT_EQ(error.cause(), Cause::user);
    EXPECT_NE(error.message().find("bulk"), std::string::npos);
}

TEST(Fit, MissingStandardDeviationsAreAssumedAloud) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 0);
    const FittedPoint stated = fit_measurement(data, {}).points[0];
    for (MeasurementRow& row : data.rows) row.sigma_psi_deg = row.sigma_delta_deg = 0;
    const FitResult fit = fit_measurement(data, {});
    EXPECT_EQ(fit.points[0].sigma_n, stated.sigma_n);
    ASSERT_EQ(fit.warnings.size(), 1u);
    EXPECT_NE(fit.warnings[0].find("0.05"), std::string::npos);
}

TEST(Fit, OppositeSignOfDeltaIsSaidAndEndsAtTheBound) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 0);
    for (MeasurementRow& row : data.rows) row.delta_deg = -row.delta_deg;
    const FitResult fit = fit_measurement(data, {});
    EXPECT_TRUE(fit.points[0].at_bound);
    EXPECT_GE(fit.points[0].n, 0);
    ASSERT_FALSE(fit.warnings.empty());
    EXPECT_NE(fit.warnings[0].find("sign"), std::string::npos) << fit.warnings[0];
}

TEST(Fit, TransparentMaterialsStayWithinTheBounds) {
    const Measurement data = measured({"glass", 1.52, 0}, paper_angles(), 0);
    const FittedPoint point = fit_measurement(data, {}).points[0];
    EXPECT_NEAR(point.n, 1.52, 1e-7);
    EXPECT_NEAR(point.k, 0, 1e-7);
    EXPECT_GE(point.k, 0);
}

// Whatever the numbers, a fit ends, and ends finite or refused.
TEST(Fit, RandomAnglesNeverGiveNaN) {
    for (uint64_t seed = 1; seed <= 300; ++seed) {
        Measurement data;
        for (int i = 0; i < 1 + static_cast<int>(seed % 4); ++i) {
            const auto a =
                philox({static_cast<uint32_t>(i), 1, 2, 3}, {static_cast<uint32_t>(seed), 0});
            MeasurementRow row;
            row.wavelength_nm = 550;
            row.angle_deg = 1 + 22.0 * i + a[0] * 0x1p-32 * 20;
            row.psi_deg = a[1] * 0x1p-32 * 90;
            row.delta_deg = a[2] * 0x1p-32 * 360;
            data.rows.push_back(row);
        }
        for (const std::string& estimator : estimator_names()) {
            FitOptions options;
            options.estimator = estimator;
            try {
                const FittedPoint point = fit_measurement(data, options).points[0];
                EXPECT_TRUE(std::isfinite(point.n) && point.n > 0) << seed << estimator;
                EXPECT_TRUE(std::isfinite(point.k) && point.k >= 0) << seed << estimator;
                EXPECT_TRUE(point.sigma_n > 0 && point.sigma_k > 0) << seed << estimator;
            } catch (const Error& error) {
                EXPECT_EQ(error.cause(), Cause::answer_is_no) << error.message();
            }
        }
    }
}

}  // namespace
}  // namespace drude
