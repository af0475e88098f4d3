// Scans of a bench by Jones calculus, on their own: nothing of materials/ or device/signal/.
//
// Time factor exp(+i omega t), rho = r_p / r_s = tan Psi exp(i Delta), azimuths from p; the
// retarder behind the sample brings p ahead of s by d (Azzam & Bashara 1977, section 2.2 and
// chapter 3).
#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "base/counter_random.h"
#include "device/signal/scan.h"

namespace drude {

constexpr double oracle_degree = 3.14159265358979323846 / 180;

struct OracleBench {
    double psi_deg = 41.3, delta_deg = 120;
    double retardance_deg = 90, diattenuation = 1;
    // True azimuths are the reported ones less these.
    double polariser_offset_deg = 0, analyser_offset_deg = 0;
    double source_degree = 0, source_azimuth_deg = 0;  // linear polarisation of the lamp
    double depth = 1;                                  // the rest is light without any modulation
    double drift = 0;                                  // over the scan
    double quadratic = 0;  // counts (1 + this * counts / brightest of the scan's mean * 2)
    double eccentricity_deg = 0;
    double jitter_deg = 0;  // of each stop of the polariser
    double analyser_jitter_deg = 0;
    double level = 10000;  // counts of the mean intensity, without the sample's factor
    double dark = 0, dark_noise = 0;
    double noise = 0;           // standard deviation over the scan's mean counts
    double relative_noise = 0;  // standard deviation over the reading
    int steps = 24;
    double turn_deg = 360;
    bool shuffled = false;
    uint64_t seed = 1;
};

// Light behind the analyser, 1 for the mean of a scan; angles in radians, true azimuths.
inline double oracle_intensity(const OracleBench& bench, double p, double a, bool retarder,
                               bool straight) {
    using Complex = std::complex<double>;
    const Complex i(0, 1);
    const double psi = straight ? 45 : bench.psi_deg, delta = straight ? 0 : bench.delta_deg;
    Complex rho = std::tan(psi * oracle_degree) * std::exp(i * delta * oracle_degree);
    if (retarder) {
        rho *= bench.diattenuation * std::exp(i * bench.retardance_deg * oracle_degree);
    }
    const Complex field = std::cos(a) * rho * std::cos(p) + std::sin(a) * std::sin(p);
    // Mean over p of |field|^2 is half of this.
    const double mean = (std::norm(std::cos(a) * rho) + std::sin(a) * std::sin(a)) / 2;
    const double source =
        1 + bench.source_degree * std::cos(2 * (p - bench.source_azimuth_deg * oracle_degree));
    return source * (bench.depth * std::norm(field) / mean + (1 - bench.depth));
}

struct OracleNoise {
    uint64_t seed, index = 0;
    double next() { return normal_pair(seed, index++)[0]; }
};

// `pixels` of the same light, each with noise of its own; jitter is common to them.
inline Scan oracle_scan(const OracleBench& bench, size_t pixels, double analyser_deg,
                        bool retarder = false, double incidence_deg = 70, uint64_t stream = 0) {
    OracleNoise noise{bench.seed * 1000003 + stream};
    Scan scan;
    scan.incidence_deg = incidence_deg;
    scan.analyser_deg = analyser_deg;
    scan.retarder_in = retarder;
    scan.dark.assign(pixels, bench.dark);
    for (double& d : scan.dark) d += bench.dark_noise * noise.next();
    scan.dark_variance.assign(pixels, bench.dark_noise * bench.dark_noise);
    const double a =
        (analyser_deg - bench.analyser_offset_deg + bench.analyser_jitter_deg * noise.next()) *
        oracle_degree;
    for (int k = 0; k < bench.steps; ++k) {
        // An order without any trend: multiples of a number prime to the steps.
        const int at = bench.shuffled ? (k * 7 + 3) % bench.steps : k;
        ScanStep step;
        step.polariser_deg = bench.turn_deg * at / bench.steps;
        step.time_s = k;
        step.frames = 1;
        const double p = (step.polariser_deg - bench.polariser_offset_deg +
                          bench.eccentricity_deg * std::cos(step.polariser_deg * oracle_degree) +
                          bench.jitter_deg * noise.next()) *
                         oracle_degree;
        double light = oracle_intensity(bench, p, a, retarder, incidence_deg == 90);
        light *= 1 + bench.drift * (double(k) / (bench.steps - 1) - 0.5);
        light *= 1 + bench.quadratic * light;
        const double counts = bench.level * light;
        const double sigma = std::hypot(bench.noise * bench.level, bench.relative_noise * counts);
        step.counts.resize(pixels);
        for (double& c : step.counts) c = bench.dark + counts + sigma * noise.next();
        step.variance.assign(pixels, sigma * sigma);
        step.saturated.assign(pixels, 0);
        scan.steps.push_back(std::move(step));
    }
    return scan;
}

}  // namespace drude
