#include "device/signal/bench_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "device/scan_oracle.h"

namespace drude {
namespace {

SpectrometerInfo pixels_apart(size_t count) {
    SpectrometerInfo info;
    for (size_t j = 0; j < count; ++j) info.wavelength_nm.push_back(400 + 0.01 * double(j));
    return info;
}
ReductionOptions one_pixel_bins(size_t count) {
    ReductionOptions options;
    options.first_nm = 400;
    options.last_nm = 400 + 0.01 * double(count - 1);
    options.step_nm = 0.01;
    return options;
}

OracleBench ordinary() {
    OracleBench bench;
    bench.polariser_offset_deg = 0.3;
    bench.analyser_offset_deg = -0.2;
    bench.source_degree = 0.02;
    bench.source_azimuth_deg = 30;
    bench.depth = 0.998;
    bench.retardance_deg = 75;
    bench.diattenuation = 0.97;
    return bench;
}
std::vector<Scan> straight(const OracleBench& bench, size_t pixels) {
    return {
        oracle_scan(bench, pixels, 45, false, 90, 1), oracle_scan(bench, pixels, -45, false, 90, 2),
        oracle_scan(bench, pixels, 45, true, 90, 3), oracle_scan(bench, pixels, -45, true, 90, 4)};
}
std::vector<Scan> stepped(const OracleBench& bench, size_t pixels, std::vector<double> about) {
    std::vector<Scan> scans;
    for (const double centre : about) {
        for (int i = -4; i <= 4; ++i) {
            scans.push_back(oracle_scan(bench, pixels, centre + 1.25 * i, false, 70, scans.size()));
        }
    }
    return scans;
}

TEST(BenchCalibration, StraightThroughFindsTheBench) {
    const OracleBench bench = ordinary();
    std::vector<std::string> warnings;
    const Calibration c = calibrate_straight_through(straight(bench, 3), pixels_apart(3),
                                                     one_pixel_bins(3), &warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_NEAR(c.polariser_offset_deg, 0.5, 1e-7);
    EXPECT_NEAR(c.modulation_depth.at(400, 0), 0.998, 1e-9);
    // The retarder's axis is off by the analyser's error here, as p is only known so.
    EXPECT_NEAR(c.retardance_deg.at(400, 0), 75, 0.01);
    EXPECT_NEAR(c.diattenuation.at(400, 0), 0.97, 1e-4);
    // The source, from a polariser that is still off by the analyser's 0.2 degrees.
    Calibration turned = c;
    rotate_source(&turned, -0.2);
    EXPECT_NEAR(turned.source_s1.at(400, 0), -0.02 * std::cos(60 * oracle_degree), 1e-8);
    EXPECT_NEAR(turned.source_s2.at(400, 0), -0.02 * std::sin(60 * oracle_degree), 1e-8);
}

TEST(BenchCalibration, StraightThroughSigmaIsHonest) {
    OracleBench bench = ordinary();
    bench.noise = 2e-3;
    double chi2 = 0;
    const int draws = 400;
    for (int i = 0; i < draws; ++i) {
        bench.seed = static_cast<uint64_t>(i + 1);
        std::vector<std::string> warnings;
        const Calibration c = calibrate_straight_through(straight(bench, 4), pixels_apart(4),
                                                         one_pixel_bins(4), &warnings);
        // Few wavelengths: their scatter is a rough estimate and only ever raises the sigma.
        chi2 += std::pow((c.polariser_offset_deg - 0.5) / c.polariser_offset_sigma_deg, 2) / draws;
    }
    EXPECT_LT(chi2, 1 + 4 * std::sqrt(2.0 / draws));
    EXPECT_GT(chi2, 0.6);
}

TEST(BenchCalibration, ZonesThatAreParallelOrCrossedAreRefused) {
    const OracleBench bench = ordinary();
    std::vector<std::string> warnings;
    const auto run = [&](const std::vector<Scan>& scans) {
        return calibrate_straight_through(scans, pixels_apart(1), one_pixel_bins(1), &warnings);
    };
    EXPECT_THROW(run({oracle_scan(bench, 1, 45, false, 90)}), Error);
    EXPECT_THROW(run({oracle_scan(bench, 1, 45, false, 90), oracle_scan(bench, 1, 45, false, 90)}),
                 Error);
    EXPECT_THROW(run({oracle_scan(bench, 1, 45), oracle_scan(bench, 1, -45)}), Error);
}

TEST(BenchCalibration, AzimuthsByResidualAndPhase) {
    struct Case {
        double psi, delta;
        std::vector<double> about;
        const char* method;
    };
    const Case cases[] = {{41.3, 120, {0}, "residual"},
                          {41.3, 120, {90}, "residual"},
                          {35, 70, {0, 90}, "residual"},
                          {35, 165, {0, 90}, "phase"},
                          {30, 12, {0, 90}, "phase"}};
    for (const Case& c : cases) {
        OracleBench bench = ordinary();
        bench.psi_deg = c.psi;
        bench.delta_deg = c.delta;
        Calibration calibration;
        // The source as a straight-through calibration leaves it: in the polariser's frame.
        calibration.source_s1 = {{400}, {-0.02 * std::cos(60 * oracle_degree)}};
        calibration.source_s2 = {{400}, {-0.02 * std::sin(60 * oracle_degree)}};
        calibration.modulation_depth = {{400}, {0.998}};
        rotate_source(&calibration, -0.3);
        std::vector<std::string> warnings;
        calibrate_azimuth(stepped(bench, 2, c.about), pixels_apart(2), one_pixel_bins(2),
                          &calibration, &warnings);
        EXPECT_TRUE(warnings.empty());
        EXPECT_NEAR(calibration.analyser_offset_deg, -0.2, 2e-5) << c.psi << " " << c.delta;
        EXPECT_NEAR(calibration.polariser_offset_deg, 0.3, 2e-5) << c.psi << " " << c.delta;
        EXPECT_NEAR(calibration.source_s1.at(400, 0), -0.02 * std::cos(60 * oracle_degree), 1e-7);
        ASSERT_EQ(calibration.provenance.size(), 1u);
        EXPECT_EQ(calibration.provenance[0].second.find(c.method), 0u);
    }
}

TEST(BenchCalibration, AzimuthSigmaIsHonest) {
    for (const double delta : {120.0, 165.0}) {
        OracleBench bench;
        bench.polariser_offset_deg = 0.3;
        bench.analyser_offset_deg = -0.2;
        bench.psi_deg = 36;
        bench.delta_deg = delta;
        bench.noise = 1e-3;
        double analyser = 0, polariser = 0;
        const int draws = 200;
        for (int i = 0; i < draws; ++i) {
            bench.seed = static_cast<uint64_t>(i + 1);
            Calibration c;
            std::vector<std::string> warnings;
            calibrate_azimuth(stepped(bench, 8, {0, 90}), pixels_apart(8), one_pixel_bins(8), &c,
                              &warnings);
            analyser += std::pow((c.analyser_offset_deg + 0.2) / c.analyser_offset_sigma_deg, 2);
            polariser += std::pow((c.polariser_offset_deg - 0.3) / c.polariser_offset_sigma_deg, 2);
        }
        EXPECT_LT(analyser / draws, 1 + 4 * std::sqrt(2.0 / draws)) << delta;
        EXPECT_GT(analyser / draws, 0.5) << delta;
        EXPECT_LT(polariser / draws, 1 + 4 * std::sqrt(2.0 / draws)) << delta;
        EXPECT_GT(polariser / draws, 0.5) << delta;
    }
}

TEST(BenchCalibration, OneWindowIsToldToBeBluntNearZeroDelta) {
    OracleBench bench;
    bench.psi_deg = 36;
    bench.delta_deg = 170;
    Calibration c;
    std::vector<std::string> warnings;
    calibrate_azimuth(stepped(bench, 1, {0}), pixels_apart(1), one_pixel_bins(1), &c, &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("blunt"), std::string::npos);
    std::vector<Scan> scans = stepped(bench, 1, {0});
    scans.resize(2);
    EXPECT_THROW(calibrate_azimuth(scans, pixels_apart(1), one_pixel_bins(1), &c, &warnings),
                 Error);
    EXPECT_THROW(
        calibrate_azimuth(straight(bench, 1), pixels_apart(1), one_pixel_bins(1), &c, &warnings),
        Error);
}

}  // namespace
}  // namespace drude
