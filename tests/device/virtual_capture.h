// A sweep over a virtual bench in the plainest way: every point once, stale frames thrown away.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "device/signal/reduction.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

struct VirtualCapture {
    std::vector<double> angles_deg = {45, 50, 60, 70, 75, 80};
    std::vector<double> zones_deg = {45, -45};
    int cycles = 2, steps = 24;
    double integration_s = 0.05;
};

// One frame that began after the bench stood still: the first is from the buffer.
inline Frame fresh_frame(const Bench& bench) {
    const double settled_s = bench.clock->now();
    Spectrometer& spectrometer = *bench.spectrometer;
    spectrometer.acquire();
    for (;;) {
        Frame frame = spectrometer.acquire();
        const double began_s =
            frame.arrived_s - spectrometer.integration_time() - spectrometer.info().readout_s;
        if (began_s >= settled_s) return frame;
    }
}

// Variances as the settings' noise makes them, from the counts that were read.
inline std::vector<Scan> capture(const Bench& bench, const VirtualBenchSettings& settings,
                                 const VirtualCapture& plan) {
    constexpr int dark_frames = 16;
    std::vector<Scan> scans;
    Spectrometer& spectrometer = *bench.spectrometer;
    spectrometer.set_integration_time(plan.integration_s);
    const size_t pixels = spectrometer.info().wavelength_nm.size();
    const auto variance = [&](double counts, double dark) {
        const double light = counts - dark, relative = settings.relative_noise * light;
        const double photons =
            settings.electrons_per_count > 0 ? counts / settings.electrons_per_count : 0;
        return photons + settings.read_noise_counts * settings.read_noise_counts +
               relative * relative + 1.0 / 12;
    };
    for (const double angle : plan.angles_deg) {
        bench.goniometer->move_to(angle, 0);
        spectrometer.set_lamp(false);
        Scan proto;
        proto.incidence_deg = angle;
        proto.dark.resize(pixels);
        for (int i = 0; i < dark_frames; ++i) {
            const Frame frame = fresh_frame(bench);
            for (size_t j = 0; j < pixels; ++j) {
                proto.dark[j] += static_cast<double>(frame.counts[j]) / dark_frames;
            }
        }
        for (const double dark : proto.dark) {
            proto.dark_variance.push_back(variance(dark, dark) / dark_frames);
        }
        spectrometer.set_lamp(true);
        for (int cycle = 0; cycle < plan.cycles; ++cycle) {
            bench.retarder.rotator->move_to(cycle == 0 ? bench.retarder.out_deg
                                                       : bench.retarder.in_deg);
            for (const double zone : plan.zones_deg) {
                Scan scan = proto;
                scan.retarder_in = cycle == 1;
                scan.analyser_deg = bench.analyser.rotator->move_to(zone);
                for (int k = 0; k < plan.steps; ++k) {
                    ScanStep step;
                    step.polariser_deg = bench.polariser.rotator->move_to(360.0 * k / plan.steps);
                    const Frame frame = fresh_frame(bench);
                    step.time_s = frame.arrived_s - plan.integration_s / 2;
                    step.frames = 1;
                    for (size_t j = 0; j < pixels; ++j) {
                        step.counts.push_back(frame.counts[j]);
                        step.variance.push_back(variance(frame.counts[j], scan.dark[j]));
                        step.saturated.push_back(frame.counts[j] >= settings.max_counts);
                    }
                    scan.steps.push_back(step);
                }
                scans.push_back(scan);
            }
        }
    }
    return scans;
}

}  // namespace drude
