// How long a whole sweep takes from counts to Psi and Delta, on one thread.
//
//     capture_reduction        prints the median of 9 reductions after one that is not counted
//
// The sweep: 6 angles of incidence, two cycles, two zones, 24 steps over a turn, a spectrometer of
// 3648 pixels from 340 to 860 nm; photon and read noise, drift and 4P fitted, and once more with
// the brightest steps of every tenth pixel saturated.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "base/error.h"
#include "device/signal/reduction.h"
#include "device/virtual/virtual_bench.h"
#include "device/virtual/virtual_optics.h"

namespace {

using namespace drude;

std::vector<Scan> sweep(const VirtualOptics& optics, double integration_s) {
    const VirtualBenchSettings& settings = optics.settings();
    std::vector<Scan> scans;
    double clock = 0;
    for (const double angle : {45.0, 50.0, 60.0, 70.0, 75.0, 80.0}) {
        for (const bool retarder : {false, true}) {
            for (const double zone : {45.0, -45.0}) {
                OpticalState state;
                state.incidence_deg = angle;
                state.retarder_in = retarder;
                state.analyser_deg = zone;
                Scan scan;
                scan.incidence_deg = angle;
                scan.retarder_in = retarder;
                scan.analyser_deg = zone;
                state.lamp_on = false;
                scan.dark = optics.expected_counts(state, integration_s, clock);
                scan.dark_variance.assign(scan.dark.size(), 14);
                state.lamp_on = true;
                for (int k = 0; k < 24; ++k) {
                    state.polariser_deg = 15.0 * (k * 7 % 24);
                    ScanStep step;
                    step.polariser_deg = state.polariser_deg;
                    step.time_s = clock;
                    step.frames = 1;
                    const std::vector<uint32_t> frame =
                        optics.frame(state, integration_s, clock, 0);
                    step.counts.assign(frame.begin(), frame.end());
                    for (const double c : step.counts) {
                        step.variance.push_back(settings.read_noise_counts *
                                                    settings.read_noise_counts +
                                                c / settings.electrons_per_count);
                    }
                    for (const uint32_t c : frame) {
                        step.saturated.push_back(c >= settings.max_counts ? 1 : 0);
                    }
                    scan.steps.push_back(std::move(step));
                    clock += integration_s;
                }
                scans.push_back(std::move(scan));
            }
        }
    }
    return scans;
}

double median_ms(const std::vector<Scan>& scans, const SpectrometerInfo& info,
                 const Calibration& calibration, size_t* rows) {
    std::vector<double> times;
    for (int run = 0; run < 10; ++run) {
        const auto start = std::chrono::steady_clock::now();
        *rows = reduce_scans(scans, info, calibration, {}).rows.size();
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        if (run > 0) times.push_back(took.count());
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

void run() {
    VirtualBenchSettings settings = ordinary_bench_settings(1);
    settings.pixels = 3648;
    const VirtualOptics optics(find_material("Cu"), settings);
    SpectrometerInfo info;
    info.wavelength_nm = optics.wavelengths_nm();
    info.nonlinearity = settings.reported_nonlinearity;
    const Calibration calibration = true_calibration(settings);
    std::vector<Scan> scans = sweep(optics, settings.full_scale_s);
    size_t rows = 0;
    fmt::print("{} scans of 24 steps, 3648 pixels\n", scans.size());
    double took = median_ms(scans, info, calibration, &rows);
    fmt::print("  as they are                 {:6.1f} ms, {} rows\n", took, rows);
    for (Scan& scan : scans) {
        for (size_t j = 0; j < info.wavelength_nm.size(); j += 10) {
            for (ScanStep& step : scan.steps) {
                if (step.counts[j] > 0.7 * settings.max_counts) step.saturated[j] = 1;
            }
            scan.steps[j % 7].saturated[j] = 1;
        }
    }
    took = median_ms(scans, info, calibration, &rows);
    fmt::print("  a tenth of them saturated   {:6.1f} ms, {} rows\n", took, rows);
}

}  // namespace

int main() {
    try {
        run();
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "capture_reduction: {}\n", error.message());
        return static_cast<int>(error.cause());
    }
}
