// What is known of virtual benches because they were set up so.
#include <cmath>

#include "device/virtual/virtual_bench.h"
#include "materials/scalar.h"

namespace drude {

std::vector<double> nonlinearity_correction(double nonlinearity, uint32_t max_counts) {
    // y = c (1 + a c) is divided by y/c = (1 + sqrt(1 + 4 a y))/2 = 1 + a y - (a y)^2 + 2 (a y)^3
    // - 5 (a y)^4 ...: Catalan's numbers with alternating signs.
    const double a = nonlinearity / max_counts;
    std::vector<double> coefficients{1};
    double catalan = 1, power = 1;
    for (int k = 1; k <= 7; ++k) {
        power *= k == 1 ? a : -a;
        coefficients.push_back(catalan * power);
        catalan *= 2.0 * (2 * k - 1) / (k + 1);
    }
    return coefficients;
}

VirtualBenchSettings noise_only_bench_settings(uint64_t seed) {
    VirtualBenchSettings settings;
    settings.seed = seed;
    settings.electrons_per_count = 2;
    settings.read_noise_counts = 15;
    settings.dark_counts = 1500;
    settings.dark_counts_per_s = 200;
    return settings;
}

VirtualBenchSettings ordinary_bench_settings(uint64_t seed) {
    VirtualBenchSettings settings = noise_only_bench_settings(seed);
    settings.nonlinearity = -0.02;
    settings.reported_nonlinearity =
        nonlinearity_correction(settings.nonlinearity, settings.max_counts);
    settings.source_dop = 0.02;
    settings.source_aolp_deg = 30;
    settings.drift_per_hour = 0.01;
    settings.polariser_extinction = settings.analyser_extinction = 1e-5;
    settings.polariser_offset_deg = 0.3;
    settings.analyser_offset_deg = -0.3;
    settings.eccentricity_deg = 0.2;
    settings.mount_jitter_deg = 0.05;
    return settings;
}

Calibration true_calibration(const VirtualBenchSettings& settings) {
    settings.check("virtual bench");
    Calibration calibration;
    // What is subtracted from a reported azimuth; the true one is the reported plus the offset.
    calibration.polariser_offset_deg = -settings.polariser_offset_deg;
    calibration.analyser_offset_deg = -settings.analyser_offset_deg;
    const std::vector<double> ends{settings.first_nm, settings.last_nm};
    const auto constant = [&](double value) { return WavelengthCurve{ends, {value, value}}; };
    // Azimuths count from p, S1 > 0 is along s and S2 > 0 from s towards p.
    const double twice = 2 * settings.source_aolp_deg * pi / 180;
    calibration.source_s1 = constant(-settings.source_dop * std::cos(twice));
    calibration.source_s2 = constant(-settings.source_dop * std::sin(twice));
    const auto depth = [](double leak) { return (1 - leak) / (1 + leak); };
    calibration.modulation_depth =
        constant(depth(settings.polariser_extinction) * depth(settings.analyser_extinction));
    calibration.diattenuation = constant(settings.retarder_diattenuation);
    // Close enough for linear interpolation of 1/wavelength to 2e-4 degrees.
    const int steps = static_cast<int>(std::ceil(settings.last_nm - settings.first_nm));
    for (int i = 0; i <= steps; ++i) {
        const double nm = settings.first_nm + i * (settings.last_nm - settings.first_nm) / steps;
        calibration.retardance_deg.wavelength_nm.push_back(nm);
        calibration.retardance_deg.value.push_back(settings.retardance_deg * settings.retarder_nm /
                                                   nm);
    }
    calibration.provenance = {{"method", "settings of the virtual bench, exact"}};
    return calibration;
}

}  // namespace drude
