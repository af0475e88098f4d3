// The error that the wavelengths of an angle share, from the header of a file to chi-square.
#include "fitter/common_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "fitter/fit.h"

namespace drude {
namespace {

Measurement two_angles() {
    Measurement measurement;
    for (const double nm : {500.0, 600.0}) {
        for (const double angle : {45.0, 70.0}) {
            MeasurementRow row;
            row.wavelength_nm = nm;
            row.angle_deg = angle;
            row.psi_deg = 40;
            row.delta_deg = 100;
            row.sigma_psi_deg = 0.03;
            row.sigma_delta_deg = 0.06;
            measurement.rows.push_back(row);
        }
    }
    return measurement;
}

Measurement with_header(const std::string& value) {
    Measurement measurement = two_angles();
    measurement.file = "cu.csv";
    measurement.header.emplace_back("sigma_common_deg", value);
    return measurement;
}

TEST(CommonErrors, JoinTheNoiseInSquares) {
    const Measurement measurement = two_angles();
    const std::vector<CommonError> common = {{45, 0.04, 0.08}};
    const Measurement both = with_common_error(measurement, common);
    EXPECT_NEAR(both.rows[0].sigma_psi_deg, 0.05, 1e-15);
    EXPECT_NEAR(both.rows[0].sigma_delta_deg, 0.1, 1e-15);
    EXPECT_EQ(both.rows[1].sigma_psi_deg, 0.03);  // at 70 degrees none is stated
    // Half the rows with (4/3)^2, and 16/25 of their variance.
    EXPECT_NEAR(chi2_by_common_error(measurement, common), 1 + 16.0 / 18, 1e-12);
    EXPECT_NEAR(chi2_slack(measurement, common, 200), 4 * (0.1 + 0.32), 1e-12);
    EXPECT_NEAR(chi2_slack(measurement, {}, 200), 0.4, 1e-12);
    EXPECT_EQ(chi2_by_common_error(measurement, {}), 1);
}

TEST(CommonErrors, AreReadFromTheHeader) {
    EXPECT_TRUE(common_errors(two_angles()).empty());
    for (const char* text : {"45: 0.04 0.08; 70: 0.025 1e-3 (angle: psi delta; shared)",
                             "45:0.04 0.08 ;70: 0.025  1e-3"}) {
        const std::vector<CommonError> read = common_errors(with_header(text));
        ASSERT_EQ(read.size(), 2u) << text;
        EXPECT_EQ(read[0].angle_deg, 45);
        EXPECT_EQ(read[0].sigma_psi_deg, 0.04);
        EXPECT_EQ(read[0].sigma_delta_deg, 0.08);
        EXPECT_EQ(read[1].angle_deg, 70);
        EXPECT_EQ(read[1].sigma_psi_deg, 0.025);
        EXPECT_EQ(read[1].sigma_delta_deg, 1e-3);
    }
}

TEST(CommonErrors, RefuseWhatTheyCannotBe) {
    for (const char* text : {"45", "45:", "45: 0.04", "45: 0.04 0.08 0.1", "45: -0.04 0.08",
                             "45: 0.04 inf", "45: nan 0.08", "45: a b", ";", "45: 0.04 0.08;;"}) {
        try {
            common_errors(with_header(text));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user) << text;
            EXPECT_EQ(std::string(error.what()).find("cu.csv: sigma_common_deg: found"), 0u)
                << error.what();
        }
    }
}

TEST(CommonErrors, LeaveRowsThatStateNoNoise) {
    Measurement measurement = two_angles();
    measurement.rows[0].sigma_psi_deg = measurement.rows[0].sigma_delta_deg = 0;
    const std::vector<CommonError> common = {{45, 0.04, 0.08}};
    // A fit takes its default for it, which is more than the common error alone.
    EXPECT_EQ(with_common_error(measurement, common).rows[0].sigma_psi_deg, 0);
    // Of the four rows one of two at 45 degrees is left: (4/3)^2 over three rows.
    EXPECT_NEAR(chi2_by_common_error(measurement, common), 1 + 16.0 / 27, 1e-12);
}

TEST(CommonErrors, WidenWhatIsExpectedOfChiSquare) {
    FitResult result;
    result.data = 210;
    result.parameters = 10;
    FitOptions options;
    EXPECT_NEAR(chi2_scatter(result, options), 0.1, 1e-15);
    options.chi2_common_scatter = chi2_common_scatter(two_angles(), {{45, 0.04, 0.08}});
    EXPECT_NEAR(chi2_scatter(result, options), 0.1 + 0.32, 1e-12);
    result.parameters = 210;
    EXPECT_TRUE(std::isnan(chi2_scatter(result, options)));
}

}  // namespace
}  // namespace drude
