// A whole sweep of the virtual light path with noise, from frames to Psi and Delta.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "device/signal/reduction.h"
#include "device/virtual/virtual_bench.h"
#include "device/virtual/virtual_optics.h"
#include "materials/surface.h"

namespace drude {
namespace {

// Photometric noise of 1e-3 of the reading and nothing else wrong, 24 steps, two cycles.
std::vector<Scan> sweep(const VirtualOptics& optics, const std::vector<double>& angles) {
    const double seconds = optics.settings().full_scale_s, noise = optics.settings().relative_noise;
    std::vector<Scan> scans;
    for (const double angle : angles) {
        for (const bool retarder : {false, true}) {
            OpticalState state;
            state.incidence_deg = angle;
            state.retarder_in = retarder;
            state.analyser_deg = 45;
            Scan scan;
            scan.incidence_deg = angle;
            scan.retarder_in = retarder;
            scan.analyser_deg = 45;
            scan.dark.assign(optics.wavelengths_nm().size(), 0);
            scan.dark_variance = scan.dark;
            for (int k = 0; k < 24; ++k) {
                state.polariser_deg = 15.0 * k;
                ScanStep step;
                step.polariser_deg = state.polariser_deg;
                step.time_s = k;
                step.frames = 1;
                const std::vector<uint32_t> frame = optics.frame(state, seconds, 0, 0);
                step.counts.assign(frame.begin(), frame.end());
                // Rounding up or down at random costs up to a quarter.
                for (const double c : step.counts) {
                    step.variance.push_back(noise * noise * c * c + 1.0 / 6);
                }
                step.saturated.assign(frame.size(), 0);
                scan.steps.push_back(std::move(step));
            }
            scans.push_back(std::move(scan));
        }
    }
    return scans;
}

TEST(NoisySweep, FiveMetalsWithinTheirSigmas) {
    for (const char* metal : {"Cu", "Ag", "Au", "Al", "Zn"}) {
        VirtualBenchSettings settings;
        settings.pixels = 81;
        settings.first_nm = 380;
        settings.last_nm = 780;
        settings.relative_noise = 1e-3;
        settings.quantise = false;
        settings.max_counts = 1u << 24;
        const VirtualOptics optics(find_material(metal), settings);
        SpectrometerInfo info;
        info.wavelength_nm = optics.wavelengths_nm();
        const Reduction r = reduce_scans(sweep(optics, {45, 50, 60, 70, 75, 80}), info,
                                         true_calibration(settings), {});
        ASSERT_EQ(r.rows.size(), 486u) << metal;
        double chi2 = 0;
        for (const MeasurementRow& row : r.rows) {
            const Reflection<double> truth =
                reflect(optics.sample(), row.wavelength_nm, std::cos(row.angle_deg * pi / 180));
            const double d_psi = row.psi_deg - psi(truth) * 180 / pi;
            const double d_delta = std::remainder(row.delta_deg - delta(truth) * 180 / pi, 360.0);
            EXPECT_LT(std::abs(d_psi), 0.05) << metal << " " << row.wavelength_nm;
            EXPECT_LT(std::abs(d_delta), 0.1) << metal << " " << row.wavelength_nm;
            chi2 += std::pow(d_psi / row.sigma_psi_deg, 2) / 972;
            chi2 += std::pow(d_delta / row.sigma_delta_deg, 2) / 972;
        }
        EXPECT_NEAR(chi2, 1, 4 * std::sqrt(2.0 / 972)) << metal;
    }
}

// Bins of 20 pixels. The constants are a table that is interpolated linearly, so Psi and Delta have
// kinks every 10 nm, which any bin rounds off; where they have none the sigmas hold.
TEST(NoisySweep, BinsOfManyPixelsStayTrue) {
    VirtualBenchSettings settings;
    settings.relative_noise = 1e-3;
    settings.quantise = false;
    settings.max_counts = 1u << 24;
    const VirtualOptics optics(find_material("Cu"), settings);
    SpectrometerInfo info;
    info.wavelength_nm = optics.wavelengths_nm();
    const Reduction r = reduce_scans(sweep(optics, {60, 75}), info, true_calibration(settings), {});
    ASSERT_EQ(r.rows.size(), 162u);
    double chi2 = 0;
    int smooth = 0;
    for (const MeasurementRow& row : r.rows) {
        const auto truth = [&](double nm) {
            const Reflection<double> surface =
                reflect(optics.sample(), nm, std::cos(row.angle_deg * pi / 180));
            return std::array<double, 2>{psi(surface) * 180 / pi, delta(surface) * 180 / pi};
        };
        const auto at = truth(row.wavelength_nm);
        const auto above = truth(row.wavelength_nm + 2.5), below = truth(row.wavelength_nm - 2.5);
        const double d_psi = row.psi_deg - at[0];
        const double d_delta = std::remainder(row.delta_deg - at[1], 360.0);
        EXPECT_LT(std::abs(d_psi), 0.03) << row.wavelength_nm;
        EXPECT_LT(std::abs(d_delta), 0.06) << row.wavelength_nm;
        const double bend =
            std::hypot(above[0] + below[0] - 2 * at[0], above[1] + below[1] - 2 * at[1]);
        if (bend > 0.01) continue;
        ++smooth;
        chi2 += std::pow(d_psi / row.sigma_psi_deg, 2) + std::pow(d_delta / row.sigma_delta_deg, 2);
    }
    ASSERT_GT(smooth, 60);
    EXPECT_NEAR(chi2 / (2 * smooth), 1, 4 / std::sqrt(double(smooth)));
}

}  // namespace
}  // namespace drude
