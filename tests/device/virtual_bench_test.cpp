#include "device/virtual/virtual_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "device/sweep/fresh_frame.h"
#include "device/virtual/free_run.h"
#include "materials/optical_elements.h"

namespace drude {
namespace {

VirtualBenchSettings noisy_settings() {
    VirtualBenchSettings settings;
    settings.pixels = 64;
    settings.read_noise_counts = 15;
    return settings;
}

Bench bench_of(const VirtualBenchSettings& settings, FaultInjection faults = {}) {
    return make_virtual_bench(find_material("Cu-McPeak"), settings, std::move(faults));
}

OpticalState state_of(double incidence_deg, double polariser_deg, double analyser_deg) {
    OpticalState state;
    state.incidence_deg = incidence_deg;
    state.polariser_deg = polariser_deg;
    state.analyser_deg = analyser_deg;
    return state;
}

// ---- when a free-running spectrometer exposes
// ----------------------------------------------------

TEST(FreeRun, HandsOutTheBufferedExposureHoweverOldItIs) {
    FreeRun run(0, 0.1);
    EXPECT_EQ(run.next().start_s, 0);
    // Nobody reads for a second: the first exposure is still there.
    const FreeRun::Exposure first = run.hand_out(1.0);
    EXPECT_EQ(first.start_s, 0);
    // The next is the one that was running then.
    EXPECT_LE(run.next().start_s, 1.0);
    EXPECT_GT(run.next().end_s(), 1.0 - FreeRun::clearing_s);
    EXPECT_NEAR(std::remainder(run.next().start_s, 0.1 + FreeRun::clearing_s), 0, 1e-9);
}

TEST(FreeRun, ReadAsTheyEndExposuresFollowOneAnother) {
    FreeRun run(5, 0.1);
    double last = 0;
    for (int i = 0; i < 100; ++i) {
        const FreeRun::Exposure given = run.hand_out(run.next().end_s());
        EXPECT_NEAR(given.start_s, 5 + i * (0.1 + FreeRun::clearing_s), 1e-9);
        EXPECT_EQ(given.integration_s, 0.1);
        EXPECT_GE(given.start_s, last);
        last = given.end_s();
    }
}

TEST(FreeRun, ANewIntegrationTimeHoldsFromTheNextExposureOn) {
    FreeRun run(0, 1.0);
    run.set_integration(0.3, 0.1);
    EXPECT_EQ(run.integration(), 0.1);
    run.set_integration(0.4, 0.2);  // changed before it held
    EXPECT_EQ(run.next().integration_s, 1.0);
    EXPECT_EQ(run.hand_out(1.0).start_s, 0);
    EXPECT_NEAR(run.next().start_s, 1.0 + FreeRun::clearing_s, 1e-12);
    EXPECT_EQ(run.next().integration_s, 0.2);
    EXPECT_EQ(run.hand_out(run.next().end_s()).integration_s, 0.2);
    // A buffered frame keeps the time it was exposed with.
    const double later = run.next().end_s() + 3;
    run.set_integration(later, 0.5);
    EXPECT_EQ(run.hand_out(later).integration_s, 0.2);
    EXPECT_EQ(run.hand_out(later + 0.2).integration_s, 0.2);  // was running
    EXPECT_EQ(run.next().integration_s, 0.5);
}

// ---- stale frames
// --------------------------------------------------------------------------------

TEST(VirtualBench, TheFirstFrameAfterAMoveIsOfTheStateBeforeIt) {
    VirtualBenchSettings settings;
    settings.pixels = 64;
    const Bench bench = bench_of(settings);
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    bench.goniometer->move_to(60, 0);
    bench.analyser.rotator->move_to(45);
    bench.spectrometer->set_integration_time(0.05);
    const double before = bench.polariser.rotator->move_to(0);
    for (int i = 0; i < 3; ++i) bench.spectrometer->acquire();
    const double after = bench.polariser.rotator->move_to(90);
    const auto counts_at = [&](double polariser_deg) {
        return optics.frame(state_of(60, polariser_deg, 45), 0.05, 0, 0);
    };
    const Frame stale = bench.spectrometer->acquire();
    EXPECT_EQ(stale.counts, counts_at(before));
    // It had waited in the buffer.
    EXPECT_LT(stale.arrived_s - stale.requested_s, 0.05);
    // The second was running when the first was asked for, half in the old state.
    const Frame second = bench.spectrometer->acquire();
    EXPECT_NE(second.counts, counts_at(after));
    EXPECT_LT(second.arrived_s - second.requested_s, 0.05);
    const Frame fresh = bench.spectrometer->acquire();
    EXPECT_EQ(fresh.counts, counts_at(after));
    EXPECT_GE(fresh.arrived_s - fresh.requested_s, 0.05);
}

TEST(VirtualBench, AFrameThatStraddlesAMoveIsOfBothStates) {
    VirtualBenchSettings settings;
    settings.pixels = 64;
    const Bench bench = bench_of(settings);
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    Spectrometer& spectrometer = *bench.spectrometer;
    bench.goniometer->move_to(60, 0);
    bench.analyser.rotator->move_to(45);
    spectrometer.set_integration_time(1);
    bench.polariser.rotator->move_to(0);
    for (int i = 0; i < 3; ++i) spectrometer.acquire();
    // Exposing since the last byte of the last frame, less readout; the mount arrives in its
    // middle.
    const double began = bench.clock->now() - spectrometer.info().readout_s + FreeRun::clearing_s;
    bench.polariser.rotator->move_to(90);
    const double moved = bench.clock->now() - began;
    ASSERT_GT(moved, 0.2);
    ASSERT_LT(moved, 0.8);
    const auto expected = optics.expected_counts(
        {{state_of(60, 0, 45), moved}, {state_of(60, 90, 45), 1 - moved}}, began);
    const Frame frame = spectrometer.acquire();
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(frame.counts[i], std::min(expected[i], 65535.0), 0.51);
    }
    EXPECT_EQ(spectrometer.acquire().counts, optics.frame(state_of(60, 90, 45), 1, 0, 0));
}

TEST(VirtualBench, TheFirstFrameAfterANewExposureTimeHasTheOldOne) {
    VirtualBenchSettings settings;
    settings.pixels = 64;
    settings.dark_counts_per_s = 10000;
    const Bench bench = bench_of(settings);
    Spectrometer& spectrometer = *bench.spectrometer;
    spectrometer.set_lamp(false);
    spectrometer.set_integration_time(0.5);
    for (int i = 0; i < 3; ++i) spectrometer.acquire();
    spectrometer.set_integration_time(0.2);
    EXPECT_EQ(spectrometer.acquire().counts[0], 5000u);
    EXPECT_EQ(spectrometer.acquire().counts[0], 2000u);
}

// ---- the same frames again
// -----------------------------------------------------------------------

// What a measurement keeps of one stand of the parts: the first fresh frame and those after it.
std::vector<Frame> kept_frames(const Bench& bench, int count) {
    std::vector<Frame> kept{acquire_fresh(*bench.spectrometer, bench.clock->now()).frame};
    while (static_cast<int>(kept.size()) < count) kept.push_back(bench.spectrometer->acquire());
    return kept;
}

TEST(VirtualBench, KeptFramesAreTheFreshExposuresInOrder) {
    const VirtualBenchSettings settings = noisy_settings();
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    for (const double integration_s : {0.0003, 0.001, 0.0019, 0.003, 0.0035, 0.02, 0.1, 0.9}) {
        const Bench bench = bench_of(settings);
        bench.spectrometer->set_integration_time(integration_s);
        bench.goniometer->move_to(70, 0);
        bench.analyser.rotator->move_to(45);
        for (const double target : {15.0, 200.0, 15.0}) {
            const double reported = bench.polariser.rotator->move_to(target);
            const std::vector<Frame> kept = kept_frames(bench, 3);
            for (size_t i = 0; i < kept.size(); ++i) {
                EXPECT_EQ(kept[i].counts,
                          optics.frame(state_of(70, reported, 45), integration_s, 0, i))
                    << integration_s << " s, " << target << " degrees, frame " << i;
            }
        }
    }
}

TEST(VirtualBench, WhatIsKeptDoesNotDependOnWhatWentBefore) {
    const auto measured = [](int idle, bool recovers) {
        const Bench bench = bench_of(noisy_settings());
        bench.spectrometer->set_integration_time(0.1);
        bench.analyser.rotator->move_to(45);
        bench.goniometer->move_to(50, 0);
        // Another time of the clock, another phase of the exposures, other frames thrown away.
        bench.clock->sleep(0.037 * idle);
        for (int i = 0; i < idle; ++i) bench.spectrometer->acquire();
        bench.polariser.rotator->move_to(30);
        std::vector<Frame> kept = kept_frames(bench, 2);
        if (recovers) bench.spectrometer->recover();
        for (Frame& frame : kept_frames(bench, 2)) kept.push_back(std::move(frame));
        std::vector<std::vector<uint32_t>> counts;
        for (const Frame& frame : kept) counts.push_back(frame.counts);
        return counts;
    };
    const auto once = measured(0, true);
    for (const int idle : {1, 2, 3, 5, 8}) EXPECT_EQ(measured(idle, true), once) << idle;
    EXPECT_NE(once[0], once[1]);
    EXPECT_NE(once[1], once[2]);
}

// ---- parts
// ---------------------------------------------------------------------------------------

TEST(VirtualBench, MountsReportWhatTheirEncoderReads) {
    VirtualBenchSettings settings;
    settings.mount_jitter_deg = 0.03;
    const Bench bench = bench_of(settings);
    Rotator& polariser = *bench.polariser.rotator;
    EXPECT_NEAR(polariser.info().units_per_degree, 143360 / 360.0, 1e-12);
    EXPECT_EQ(polariser.info().repeatability_deg, 0.03);
    const double pulse = 360.0 / 143360;
    for (const double target : {0.0, 12.3456, -45.0, 359.99999, 725.1}) {
        const double reported = polariser.move_to(target);
        EXPECT_NEAR(reported, target, pulse / 2 * (1 + 1e-9));
        EXPECT_NEAR(std::remainder(reported / pulse, 1.0), 0, 1e-6);
        const double position = polariser.position();
        EXPECT_GE(position, 0);
        EXPECT_LT(position, 360);
        EXPECT_NEAR(std::remainder(position - reported, 360.0), 0, 1e-9);
    }
    polariser.home();
    EXPECT_EQ(polariser.position(), 0);
    EXPECT_THROW(polariser.move_to(std::nan("")), Error);
}

TEST(VirtualBench, TimePassesWhileThePartsMoveAndExpose) {
    const Bench bench = bench_of(noisy_settings());
    const auto took = [&](const auto& action) {
        const double before = bench.clock->now();
        action();
        return bench.clock->now() - before;
    };
    EXPECT_NEAR(took([&] { bench.polariser.rotator->move_to(43); }), 0.06 + 43 / 430.0, 1e-5);
    EXPECT_NEAR(took([&] { bench.polariser.rotator->move_to(43); }), 0.06, 1e-5);
    bench.spectrometer->set_integration_time(0.25);
    bench.spectrometer->acquire();
    bench.spectrometer->acquire();
    EXPECT_NEAR(took([&] { bench.spectrometer->acquire(); }), 0.25, 1e-3);
    EXPECT_GT(took([&] { bench.goniometer->move_to(45, 0); }), 1);
}

TEST(VirtualBench, RetarderAndGoniometerReachTheLight) {
    VirtualBenchSettings settings;
    settings.pixels = 64;
    const Bench bench = bench_of(settings);
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    bench.spectrometer->set_integration_time(0.04);
    OpticalState state =
        state_of(55, bench.polariser.rotator->move_to(20), bench.analyser.rotator->move_to(45));
    const auto check = [&] {
        EXPECT_EQ(kept_frames(bench, 1)[0].counts, optics.frame(state, 0.04, 0, 0));
    };
    bench.goniometer->move_to(55, 0);
    check();
    bench.retarder.rotator->move_to(bench.retarder.in_deg);
    state.retarder_in = true;
    check();
    bench.retarder.rotator->move_to(bench.retarder.out_deg);
    state.retarder_in = false;
    bench.goniometer->straight_through();
    state.straight_through = true;
    check();
    bench.goniometer->move_to(55, 3);
    bench.spectrometer->set_lamp(true);
    state.straight_through = false;
    state.offset_deg = 3;
    check();
    EXPECT_THROW(bench.goniometer->move_to(90, 0), Error);
    EXPECT_THROW(bench.goniometer->move_to(80, 10), Error);
    EXPECT_THROW(bench.goniometer->move_to(std::nan(""), 0), Error);
    EXPECT_THROW(bench.spectrometer->set_integration_time(0), Error);
    EXPECT_THROW(bench.spectrometer->set_integration_time(100), Error);
}

TEST(VirtualBench, FaultsComeAtTheirTransfersAndChangeNothing) {
    std::vector<std::string> parts;
    uint64_t broken = UINT64_MAX;
    bool gone = false;
    const Bench bench = bench_of(noisy_settings(), [&](uint64_t transfer, const char* part) {
        EXPECT_EQ(transfer, parts.size());
        parts.emplace_back(part);
        if (transfer == broken) device_error(Fault::stall, "{}: halted", part);
        if (gone) device_error(Fault::unplugged, "{}: gone", part);
    });
    bench.polariser.rotator->move_to(30);
    bench.spectrometer->acquire();
    bench.goniometer->move_to(45, 0);
    EXPECT_EQ(parts, (std::vector<std::string>{"polariser", "spectrometer", "goniometer"}));
    broken = 3;
    try {
        bench.polariser.rotator->move_to(60);
        FAIL();
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault(), Fault::stall);
    }
    EXPECT_NEAR(bench.polariser.rotator->position(), 30, 0.01);
    gone = true;
    EXPECT_THROW(bench.spectrometer->acquire(), DeviceError);
    EXPECT_THROW(bench.spectrometer->recover(), DeviceError);
    const double before = bench.clock->now();
    EXPECT_FALSE(bench.spectrometer->reconnect(3));
    EXPECT_FALSE(bench.polariser.rotator->reconnect(3));
    EXPECT_NEAR(bench.clock->now() - before, 6, 1e-9);
    gone = false;
    EXPECT_TRUE(bench.spectrometer->reconnect(3));
    EXPECT_EQ(bench.spectrometer->acquire().counts.size(), 64u);
}

TEST(VirtualBench, SaysWhatItIs) {
    const Bench bench = bench_of(noisy_settings());
    EXPECT_TRUE(bench.is_virtual);
    EXPECT_EQ(bench.name, "virtual:Cu-McPeak");
    EXPECT_EQ(bench.sample, "Cu-McPeak");
    EXPECT_NE(bench.description.find("\"settings\": {\"pixels\": 64, \"read_noise_counts\": 15}"),
              std::string::npos)
        << bench.description;
    ASSERT_FALSE(bench.notes.empty());
    EXPECT_NE(bench.notes[0].second.find("no hardware"), std::string::npos);
    VirtualBenchSettings other = noisy_settings();
    other.seed = 2;
    EXPECT_NE(bench_of(other).description, bench.description);
    EXPECT_NE(make_virtual_bench(find_material("Ag"), noisy_settings()).description,
              bench.description);
}

// ---- what is known of it
// -------------------------------------------------------------------------

TEST(VirtualBench, TheStoredCorrectionUndoesTheNonlinearity) {
    const std::vector<double> c = nonlinearity_correction(-0.02, 65535);
    ASSERT_EQ(c.size(), 8u);
    for (const double light : {0.0, 100.0, 30000.0, 65535.0}) {
        const double reading = light * (1 - 0.02 * light / 65535);
        double divisor = 0;
        for (size_t k = c.size(); k-- > 0;) divisor = divisor * reading + c[k];
        // The first term left out, 429 (0.02)^8.
        EXPECT_NEAR(reading / divisor, light, 2e-11 * light);
    }
}

TEST(VirtualBench, TheTrueCalibrationIsThatOfItsOptics) {
    VirtualBenchSettings settings;
    settings.pixels = 3;
    settings.first_nm = 500;
    settings.last_nm = 600;
    settings.polariser_offset_deg = 0.4;
    settings.analyser_offset_deg = -0.7;
    settings.source_dop = 0.05;
    settings.source_aolp_deg = 20;
    settings.polariser_extinction = 1e-3;
    settings.retardance_deg = 80;
    settings.retarder_diattenuation = 1.1;
    const VirtualOptics optics(find_material("Ag"), settings);
    const Calibration calibration = true_calibration(settings);
    const auto counts = [&](double polariser_deg, double analyser_deg, bool retarder) {
        OpticalState state;
        state.straight_through = true;
        state.retarder_in = retarder;
        // Reported azimuths at which the corrected ones are those wanted.
        state.polariser_deg = polariser_deg + calibration.polariser_offset_deg;
        state.analyser_deg = analyser_deg + calibration.analyser_offset_deg;
        return optics.expected_counts(state, 0.01, 0)[1];
    };
    // Parallel at two azimuths: the source alone differs, 1 + s.p with p = -(cos 2P, sin 2P).
    const double s1 = calibration.source_s1.value[0], s2 = calibration.source_s2.value[0];
    const auto source = [&](double azimuth) {
        const double twice = 2 * azimuth * degree;
        return 1 - s1 * std::cos(twice) - s2 * std::sin(twice);
    };
    EXPECT_NEAR(counts(0, 0, false) / counts(30, 30, false), source(0) / source(30), 1e-3);
    EXPECT_NEAR(counts(0, 0, false) / counts(90, 90, false), source(0) / source(90), 1e-3);
    // Depth: open against crossed. What leaks was polarised by the source, a product of small
    // numbers: 1e-3 x 0.05 x 4.
    const double open = counts(0, 0, false) / source(0);
    const double shut = counts(90, 0, false) / source(90);
    EXPECT_NEAR((open - shut) / (open + shut), calibration.modulation_depth.value[0], 2e-4);
    // The retarder: p against s, and cos d between them.
    const double t2 = (counts(0, 0, true) / source(0)) / (counts(90, 90, true) / source(90));
    EXPECT_NEAR(std::sqrt(t2), calibration.diattenuation.value[1], 1e-3);
    ASSERT_EQ(calibration.retardance_deg.wavelength_nm[50], 550);
    EXPECT_EQ(calibration.retardance_deg.value[50], 80);
    EXPECT_NEAR(calibration.retardance_deg.value[0], 88, 1e-12);
    const double plus = counts(45, 45, true) / source(45),
                 minus = counts(45, -45, true) / source(45);
    const double expected = 2 * 1.1 * std::cos(80 * degree) / (1 + 1.1 * 1.1);
    EXPECT_NEAR((plus - minus) / (plus + minus), expected, 2e-3);
}

TEST(VirtualBench, OrdinaryPartsHaveEveryImperfection) {
    const VirtualBenchSettings settings = ordinary_bench_settings(7);
    EXPECT_EQ(settings.seed, 7u);
    settings.check("ordinary bench");
    EXPECT_EQ(settings.electrons_per_count, 2);
    EXPECT_EQ(settings.reported_nonlinearity.size(), 8u);
    EXPECT_GT(settings.mount_jitter_deg, 0);
    const Bench bench = bench_of(settings);
    EXPECT_EQ(bench.spectrometer->info().nonlinearity, settings.reported_nonlinearity);
}

}  // namespace
}  // namespace drude
