// What each imperfection of a bench does to Psi and Delta, and what is left of it after its
// countermeasure: the virtual light path (Mueller matrices) against the reduction, without noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "device/signal/bench_calibration.h"
#include "device/virtual/virtual_bench.h"
#include "device/virtual/virtual_optics.h"
#include "materials/surface.h"

namespace drude {

// How a sweep is made and reduced. The retarder's properties are always known.
struct SweepPlan {
    bool zones = false;      // +45 and -45 instead of +45
    bool half_turn = false;  // of the polariser
    bool shuffled = false;
    bool harmonic_4 = false, drift = false;
    bool polynomial = false;        // the device's own correction of its non-linearity
    bool straight_through = false;  // calibration on the same bench
    bool azimuth = false;
};

struct Systematic {
    std::string name, countermeasure;
    std::function<void(VirtualBenchSettings*)> imperfection;
    SweepPlan before, after;
    int seeds = 1;  // of mounts that miss at random
};

struct Bias {
    double max_psi = 0, max_delta = 0, rms_psi = 0, rms_delta = 0;  // degrees
    double harmonic_4 = 0;                                          // largest of a scan
    double depolarization = 0;                                      // largest
    double common_psi = 0, common_delta = 0;  // the reduction's own statement, rms
    int rows = 0, missing = 0;
};

inline const std::vector<std::string>& systematic_metals() {
    static const std::vector<std::string> metals = {"Cu", "Ag", "Au", "Al", "Zn"};
    return metals;
}
inline const std::vector<double>& systematic_angles() {
    static const std::vector<double> angles = {45, 50, 60, 70, 75, 80};
    return angles;
}

inline std::vector<Systematic> systematics() {
    const auto plan = [](std::function<void(SweepPlan*)> change) {
        SweepPlan p;
        change(&p);
        return p;
    };
    const SweepPlan bare;
    return {
        {"none", "none", [](auto*) {}, bare, bare},
        {"source polarised by 2 %", "straight-through calibration, divided out",
         [](auto* s) { s->source_dop = 0.02, s->source_aolp_deg = 30; }, bare,
         plan([](auto* p) { p->straight_through = true; })},
        {"detector 2 % short of linear at full scale", "polynomial that the device holds",
         [](auto* s) {
             s->nonlinearity = -0.02;
             s->reported_nonlinearity = nonlinearity_correction(s->nonlinearity, s->max_counts);
         },
         bare, plan([](auto* p) { p->polynomial = true; })},
        {"lamp drifts by 1 % over a scan, steps in order", "steps shuffled",
         [](auto* s) { s->drift_per_hour = 0.01; }, bare,
         plan([](auto* p) { p->shuffled = true; })},
        {"lamp drifts by 1 % over a scan, steps in order", "drift fitted",
         [](auto* s) { s->drift_per_hour = 0.01; }, bare, plan([](auto* p) { p->drift = true; })},
        {"polariser's mount eccentric by 0.2°, half a turn", "a whole turn",
         [](auto* s) { s->eccentricity_deg = 0.2; }, plan([](auto* p) { p->half_turn = true; }),
         bare},
        {"analyser off by 0.3°", "zones ±45°", [](auto* s) { s->analyser_offset_deg = 0.3; }, bare,
         plan([](auto* p) { p->zones = true; })},
        {"polariser off by 0.3°", "zones ±45°", [](auto* s) { s->polariser_offset_deg = 0.3; },
         bare, plan([](auto* p) { p->zones = true; })},
        {"both off, by 0.3° and -0.3°", "plane of incidence calibrated",
         [](auto* s) { s->polariser_offset_deg = 0.3, s->analyser_offset_deg = -0.3; }, bare,
         plan([](auto* p) { p->azimuth = true; })},
        {"polarisers leak 1e-5", "modulation depth calibrated: mends the depolarisation, not Ψ",
         [](auto* s) { s->polariser_extinction = s->analyser_extinction = 1e-5; }, bare,
         plan([](auto* p) { p->straight_through = true; })},
        {"polarisers leak 1e-3", "modulation depth calibrated: mends the depolarisation, not Ψ",
         [](auto* s) { s->polariser_extinction = s->analyser_extinction = 1e-3; }, bare,
         plan([](auto* p) { p->straight_through = true; })},
        {"mounts miss by 0.05° at random", "zones ±45°; stated as common sigma",
         [](auto* s) { s->mount_jitter_deg = 0.05; }, bare, plan([](auto* p) { p->zones = true; }),
         12},
        {"all of these (extinction 1e-5, mounts exact)", "all of these",
         [](auto* s) {
             s->source_dop = 0.02, s->source_aolp_deg = 30;
             s->nonlinearity = -0.02;
             s->reported_nonlinearity = nonlinearity_correction(s->nonlinearity, s->max_counts);
             s->drift_per_hour = 0.01;
             s->eccentricity_deg = 0.2;
             s->polariser_offset_deg = 0.3, s->analyser_offset_deg = -0.3;
             s->polariser_extinction = s->analyser_extinction = 1e-5;
         },
         plan([](auto* p) { p->half_turn = true; }), plan([](auto* p) {
             p->zones = p->shuffled = p->harmonic_4 = p->drift = p->polynomial = true;
             p->straight_through = p->azimuth = true;
         })},
    };
}

class SystematicsBench {
  public:
    SystematicsBench(const std::string& metal, const VirtualBenchSettings& settings,
                     const SweepPlan& plan)
        : optics_(find_material(metal), settings), plan_(plan) {
        info_.wavelength_nm = optics_.wavelengths_nm();
        if (plan.polynomial) info_.nonlinearity = settings.reported_nonlinearity;
        options_.first_nm = settings.first_nm;
        options_.last_nm = settings.last_nm;
        options_.harmonic_4 = plan.harmonic_4;
        options_.drift = plan.drift;
        options_.mount_repeatability_deg = settings.mount_jitter_deg;
        options_.analyser_repeatability_deg = settings.mount_jitter_deg;
    }

    Calibration calibrate() {
        std::vector<std::string> warnings;
        Calibration calibration;
        if (plan_.straight_through) {
            std::vector<Scan> scans;
            for (const double zone : {45.0, -45.0}) {
                scans.push_back(scan(90, zone, false));
                scans.push_back(scan(90, zone, true));
            }
            calibration = calibrate_straight_through(scans, info_, options_, &warnings);
            // Straight through tells the azimuths against each other only: without the plane of
            // incidence the difference belongs to neither.
            if (!plan_.azimuth) {
                rotate_source(&calibration, -calibration.polariser_offset_deg);
                calibration.polariser_offset_deg = calibration.polariser_offset_sigma_deg = 0;
            }
        }
        if (plan_.azimuth) {
            std::vector<Scan> scans;
            for (const double centre : {0.0, 90.0}) {
                for (int i = -4; i <= 4; ++i) {
                    scans.push_back(scan(70, centre + 1.25 * i, false));
                }
            }
            calibrate_azimuth(scans, info_, options_, &calibration, &warnings);
        }
        if (!calibration.retardance_deg.known()) {
            const Calibration exact = true_calibration(optics_.settings());
            calibration.retardance_deg.wavelength_nm = info_.wavelength_nm;
            for (const double nm : info_.wavelength_nm) {
                calibration.retardance_deg.value.push_back(exact.retardance_deg.at(nm, 90));
            }
            calibration.diattenuation = exact.diattenuation;
        }
        return calibration;
    }

    Reduction sweep(const Calibration& calibration) {
        std::vector<Scan> scans;
        for (const double angle : systematic_angles()) {
            for (const bool retarder : {false, true}) {
                scans.push_back(scan(angle, 45, retarder));
                if (plan_.zones) scans.push_back(scan(angle, -45, retarder));
            }
        }
        return reduce_scans(scans, info_, calibration, options_);
    }

  private:
    Scan scan(double angle, double analyser, bool retarder) {
        const size_t pixels = info_.wavelength_nm.size();
        OpticalState state;
        state.straight_through = angle == 90;
        if (!state.straight_through) state.incidence_deg = angle;
        state.analyser_deg = analyser;
        state.retarder_in = retarder;
        Scan result;
        result.incidence_deg = angle;
        // The virtual analyser misses anew with the retarder, as one that was moved away and back,
        // which reports not quite the same place.
        result.analyser_deg = analyser + (retarder ? 1e-9 : 0);
        result.retarder_in = retarder;
        result.dark.assign(pixels, 0);
        result.dark_variance.assign(pixels, 0);
        constexpr int steps = 24;
        for (int k = 0; k < steps; ++k) {
            const int at = plan_.shuffled ? (7 * k + 3) % steps : k;
            state.polariser_deg = (plan_.half_turn ? 180.0 : 360.0) * at / steps;
            ScanStep step;
            step.polariser_deg = state.polariser_deg;
            step.time_s = 3600.0 * k / (steps - 1);  // a scan an hour: drifts are given by the hour
            step.frames = 1;
            step.counts =
                optics_.expected_counts(state, optics_.settings().full_scale_s, step.time_s);
            step.variance.assign(pixels, 1);
            step.saturated.assign(pixels, 0);
            result.steps.push_back(std::move(step));
        }
        return result;
    }

    VirtualOptics optics_;
    SweepPlan plan_;
    SpectrometerInfo info_;
    ReductionOptions options_;
};

// Against Psi and Delta of the metals, 380 to 780 nm by 5, one pixel a bin.
inline Bias measure_bias(const Systematic& systematic, const SweepPlan& plan) {
    Bias bias;
    double common_psi = 0, common_delta = 0, commons = 0;
    for (int seed = 1; seed <= systematic.seeds; ++seed) {
        for (const std::string& metal : systematic_metals()) {
            VirtualBenchSettings settings;
            settings.seed = static_cast<uint64_t>(seed);
            settings.pixels = 81;
            settings.first_nm = 380;
            settings.last_nm = 780;
            settings.quantise = false;
            systematic.imperfection(&settings);
            SystematicsBench bench(metal, settings, plan);
            const Reduction reduction = bench.sweep(bench.calibrate());
            const Material material = find_material(metal);
            for (const MeasurementRow& row : reduction.rows) {
                const Reflection<double> truth =
                    reflect(material, row.wavelength_nm, std::cos(row.angle_deg * pi / 180));
                const double d_psi = row.psi_deg - psi(truth) * 180 / pi;
                const double d_delta =
                    std::remainder(row.delta_deg - delta(truth) * 180 / pi, 360.0);
                bias.max_psi = std::max(bias.max_psi, std::abs(d_psi));
                bias.max_delta = std::max(bias.max_delta, std::abs(d_delta));
                bias.rms_psi += d_psi * d_psi;
                bias.rms_delta += d_delta * d_delta;
                bias.depolarization = std::max(bias.depolarization, row.depolarization);
                ++bias.rows;
            }
            bias.missing += static_cast<int>(systematic_angles().size()) * settings.pixels -
                            static_cast<int>(reduction.rows.size());
            for (const ScanQuality& quality : reduction.quality) {
                bias.harmonic_4 = std::max(bias.harmonic_4, quality.harmonic_4);
            }
            for (size_t i = 0; i < reduction.angles_deg.size(); ++i) {
                common_psi += std::pow(reduction.common_sigma_psi_deg[i], 2);
                common_delta += std::pow(reduction.common_sigma_delta_deg[i], 2);
                commons += 1;
            }
        }
    }
    bias.rms_psi = std::sqrt(bias.rms_psi / bias.rows);
    bias.rms_delta = std::sqrt(bias.rms_delta / bias.rows);
    bias.common_psi = std::sqrt(common_psi / commons);
    bias.common_delta = std::sqrt(common_delta / commons);
    return bias;
}

}  // namespace drude
