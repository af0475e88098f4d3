// The light path of a simulated bench: lamp, polariser, sample, retarder, analyser, detector.
//
// Mueller matrices of materials/ from the lamp to the detector, so that nothing of the formulae by
// which a scan is reduced (device/signal/) is used here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "materials/material.h"

namespace drude {

// Every imperfection of the bench; the defaults are a bench without any, and the values in comments
// what a bench of parts that people own has.
struct VirtualBenchSettings {
    uint64_t seed = 1;
    // Spectrometer.
    int pixels = 2048;  // from first_nm to last_nm, evenly spaced
    double first_nm = 340, last_nm = 860;
    uint32_t max_counts = 65535;
    double full_scale_s = 0.05;  // integration time at which the brightest pixel of a crossed-free
                                 // straight beam of full modulation reads 80 % of max_counts
    double electrons_per_count = 0;  // photon noise: variance = counts / this; 0: none (2)
    double read_noise_counts = 0;    // standard deviation (15)
    double relative_noise = 0;       // of the reading of each pixel, besides photon noise
    double dark_counts = 0;          // offset (1500), and per second (200)
    double dark_counts_per_s = 0;
    double nonlinearity = 0;  // counts' = counts (1 + this * counts / max_counts) (-0.02)
    std::vector<double> reported_nonlinearity;  // the correction that the device holds; empty: none
    bool quantise = true;
    // Light.
    double lamp_temperature_K = 2900;  // a black body through a detector of bell-shaped response
    double source_dop = 0, source_aolp_deg = 0;  // linear polarisation of the lamp (0.02)
    double drift_per_hour = 0;                   // relative change of the lamp (0.01)
    // Optics; azimuths from the plane of incidence (p).
    double polariser_extinction = 0;  // leak: transmittance across over along the axis (1e-5)
    double analyser_extinction = 0;
    double polariser_offset_deg = 0, analyser_offset_deg = 0;  // of the true axis (0.3)
    double retardance_deg = 90;  // at retarder_nm; a zero-order plate: goes as 1/wavelength
    double retarder_nm = 550;
    double retarder_diattenuation = 1;  // amplitude of p over that of s
    double eccentricity_deg = 0;        // azimuth error of once a turn (0.2)
    double mount_jitter_deg = 0;        // standard deviation of each stop against what it reports
    // Detector of lobe scans.
    double detector_half_angle_deg = 0.5;
};

// What the parts stand at, as they report it.
struct OpticalState {
    double polariser_deg = 0, analyser_deg = 45;
    bool retarder_in = false;
    bool straight_through = false;  // no sample; incidence_deg is without meaning
    double incidence_deg = 70;
    double offset_deg = 0;  // of the detector from the mirror direction
    bool lamp_on = true;

    bool operator==(const OpticalState&) const = default;
};

class VirtualOptics {
  public:
    // Throws Error (user) for settings that make no bench, and for a material that does not check.
    VirtualOptics(Material sample, VirtualBenchSettings settings);

    const VirtualBenchSettings& settings() const { return settings_; }
    const Material& sample() const { return sample_; }
    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }

    // Expected counts of every pixel of a frame without noise, not quantised and not clipped: an
    // exposure of `integration_s` beginning at `start_s` of the bench's clock (drift).
    std::vector<double> expected_counts(const OpticalState& state, double integration_s,
                                        double start_s) const;

    // A frame as the detector reads it: noise, quantisation, saturation. Deterministic: a function
    // of the arguments and the seed alone. `exposure` numbers the exposures made in one state; a
    // repeated exposure has the number of its repetition, so that a sweep that was interrupted and
    // taken up again sees the same noise.
    std::vector<uint32_t> frame(const OpticalState& state, double integration_s, double start_s,
                                uint64_t exposure) const;

  private:
    Material sample_;
    VirtualBenchSettings settings_;
    std::vector<double> wavelengths_nm_;
};

// JSON of the settings, defaults left out; parse: `where` names it in errors, unknown keys are
// Errors (user) with the nearest word.
std::string format_virtual_bench_settings(const VirtualBenchSettings& settings);
VirtualBenchSettings parse_virtual_bench_settings(const std::string& json,
                                                  const std::string& where);

}  // namespace drude
