#include "device/signal/lobe_reduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/counter_random.h"
#include "base/error.h"

namespace drude {
namespace {

constexpr size_t pixels = 2000;

SpectrometerInfo pixels_apart() {
    SpectrometerInfo info;
    for (size_t j = 0; j < pixels; ++j) info.wavelength_nm.push_back(400 + 0.01 * double(j));
    return info;
}
ReductionOptions one_pixel_bins() {
    ReductionOptions options;
    options.first_nm = 400;
    options.last_nm = 400 + 0.01 * double(pixels - 1);
    options.step_nm = 0.01;
    return options;
}

struct Light {
    double electrons_per_count = 2, dark = 1500, read_noise = 15;
    uint64_t index = 0;
    double normal() { return normal_pair(9, index++)[0]; }

    LobeReading reading(double incidence, double offset, bool s, double seconds, double rate) {
        LobeReading r;
        r.incidence_deg = incidence;
        r.offset_deg = offset;
        r.s_polarised = s;
        r.integration_s = seconds;
        const double mean = rate * seconds;
        const double variance = read_noise * read_noise + mean / electrons_per_count;
        r.step.counts.resize(pixels);
        for (double& c : r.step.counts) c = dark + mean + std::sqrt(variance) * normal();
        r.step.variance.assign(pixels, variance);
        r.step.saturated.assign(pixels, 0);
        r.step.frames = 1;
        r.dark.resize(pixels);
        for (double& d : r.dark) d = dark + read_noise / 4 * normal();
        r.dark_variance.assign(pixels, read_noise * read_noise / 16);
        return r;
    }
};

// Straight beam 1e6 counts a second; reflectances 0.02 (s) and 0.013 (p) at one offset.
std::vector<LobeReading> readings(Light* light) {
    return {light->reading(90, 0, true, 0.04, 1e6), light->reading(90, 0, false, 0.04, 0.9e6),
            light->reading(60, 2, true, 0.5, 0.02e6), light->reading(60, 2, false, 0.5, 0.0117e6)};
}
LobeScan reduce(const std::vector<LobeReading>& all, std::vector<std::string>* warnings,
                const SpectrometerInfo& info = pixels_apart()) {
    return reduce_lobe_readings(all, info, one_pixel_bins(), 1e-3, 0.5, warnings);
}

TEST(LobeReduction, RatiosAndTheirNoise) {
    Light light;
    std::vector<std::string> warnings;
    const LobeScan scan = reduce(readings(&light), &warnings);
    EXPECT_TRUE(warnings.empty());
    ASSERT_EQ(scan.rows.size(), pixels);
    double s = 0, p = 0, chi_s = 0, chi_p = 0;
    const double n = double(pixels);
    for (const LobeScanRow& row : scan.rows) {
        EXPECT_EQ(row.angle_deg, 60);
        EXPECT_EQ(row.offset_deg, 2);
        s += (row.reflectance_s - 0.02) / n;
        p += (row.reflectance_p - 0.013) / n;
        chi_s += std::pow((row.reflectance_s - 0.02) / row.sigma_s, 2) / n;
        chi_p += std::pow((row.reflectance_p - 0.013) / row.sigma_p, 2) / n;
    }
    EXPECT_NEAR(s, 0, 4 * scan.rows[0].sigma_s / std::sqrt(n));
    EXPECT_NEAR(p, 0, 4 * scan.rows[0].sigma_p / std::sqrt(n));
    EXPECT_NEAR(chi_s, 1, 4 * std::sqrt(2 / n));
    EXPECT_NEAR(chi_p, 1, 4 * std::sqrt(2 / n));
}

TEST(LobeReduction, SaturatedPixelsOfARepeatedReadingAreLeftOut) {
    Light light;
    std::vector<LobeReading> all = readings(&light);
    LobeReading again = all[2];
    for (size_t j = 0; j < pixels; ++j) {
        again.step.counts[j] = 65535;
        again.step.saturated[j] = 1;
    }
    all.push_back(again);
    all[3].step.saturated[7] = 1;
    std::vector<std::string> warnings;
    const LobeScan scan = reduce(all, &warnings);
    EXPECT_EQ(scan.rows.size(), pixels - 1);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("1 bin left out"), std::string::npos);
    EXPECT_NEAR(scan.rows[0].reflectance_s, 0.02, 0.002);
}

TEST(LobeReduction, TheDevicesPolynomialIsApplied) {
    Light light;
    light.read_noise = 0;
    light.electrons_per_count = 1e30;
    std::vector<LobeReading> all = readings(&light);
    const double q = -3e-7;
    for (LobeReading& reading : all) {
        for (double& c : reading.step.counts) {
            const double y = c - light.dark;
            c = light.dark + y * (1 + q * y);
        }
    }
    SpectrometerInfo info = pixels_apart();
    std::vector<std::string> warnings;
    EXPECT_GT(std::abs(reduce(all, &warnings).rows[0].reflectance_s - 0.02), 1e-4);
    info.nonlinearity = {1, q, -q * q, 2 * q * q * q, -5 * q * q * q * q};
    EXPECT_NEAR(reduce(all, &warnings, info).rows[0].reflectance_s, 0.02, 1e-8);
}

TEST(LobeReduction, WhatIsMissingIsSaid) {
    Light light;
    const std::vector<LobeReading> good = readings(&light);
    std::vector<std::string> warnings;
    const auto expect = [&](const std::vector<LobeReading>& all, const char* words) {
        try {
            reduce(all, &warnings);
            FAIL() << words;
        } catch (const Error& error) {
            EXPECT_NE(error.message().find(words), std::string::npos) << error.message();
        }
    };
    expect({good[0], good[1], good[2]}, "along p");
    expect({good[2], good[3]}, "no straight-through");
    expect({good[0], good[1]}, "none with a sample");
    std::vector<LobeReading> bad = good;
    bad[2].integration_s = 0;
    expect(bad, "integration time");
    bad = good;
    bad[1].dark.pop_back();
    expect(bad, "1999 pixels");
}

}  // namespace
}  // namespace drude
