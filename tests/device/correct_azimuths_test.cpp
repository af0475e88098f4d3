// A lobe scan on a bench whose axes stand beside their marks.
#include "device/sweep/correct_azimuths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/virtual/virtual_bench.h"
#include "materials/scalar.h"

namespace drude {
namespace {

// Where an axis that is sent to `wanted` truly stands.
double true_axis(const Azimuth& azimuth, double wanted, double offset) {
    return azimuth.direction * wanted + azimuth.zero_deg + offset;
}

TEST(CorrectAzimuths, AxesStandWhereTheyAreSent) {
    VirtualBenchSettings settings;
    settings.polariser_offset_deg = 0.3;
    settings.analyser_offset_deg = -0.2;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    const std::string before = bench.description;
    correct_azimuths(true_calibration(settings), &bench);
    for (const double wanted : {0.0, 45.0, 90.0}) {
        EXPECT_NEAR(true_axis(bench.polariser, wanted, 0.3), wanted, 1e-12);
        EXPECT_NEAR(true_axis(bench.analyser, wanted, -0.2), wanted, 1e-12);
    }
    // A journal of the bench that was not corrected is not gone on with.
    EXPECT_NE(bench.description, before);
    EXPECT_NE(bench.description.find("azimuths_corrected_by"), std::string::npos);
}

// axis = direction (reported - zero): a mount that turns the other way round, and a fixed element.
TEST(CorrectAzimuths, FollowsTheDirectionOfTheMount) {
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), {});
    bench.polariser.direction = -1;
    bench.polariser.zero_deg = 10;
    bench.analyser.rotator.reset();
    bench.analyser.fixed_deg = 45;
    Calibration calibration;
    calibration.polariser_offset_deg = 0.5;
    calibration.analyser_offset_deg = 0.25;
    correct_azimuths(calibration, &bench);
    // Reported 100 made the axis -90 before, whose true azimuth is -90.5.
    EXPECT_DOUBLE_EQ(-(100 - bench.polariser.zero_deg), -90.5);
    EXPECT_DOUBLE_EQ(bench.analyser.fixed_deg, 44.75);
}

}  // namespace
}  // namespace drude
