// The light path of a simulated bench: lamp, polariser, sample, retarder, analyser, detector.
//
// Mueller matrices of materials/ from the lamp to the detector, so that nothing of the formulae by
// which a scan is reduced (device/signal/) is used here.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "materials/material.h"

namespace drude {

class JsonValue;

// Every imperfection of the bench; the defaults are a bench without any, and the values in comments
// what a bench of parts that people own has.
struct VirtualBenchSettings {
    uint64_t seed = 1;
    // Spectrometer.
    int pixels = 2048;  // from first_nm to last_nm, evenly spaced
    double first_nm = 340, last_nm = 860;
    uint32_t max_counts = 65535;
    double full_scale_s = 0.05;  // integration time at which the brightest pixel of the straight
                                 // beam, polariser and analyser parallel, without a retarder and
                                 // with nothing else wrong, reads 80 % of max_counts
    double electrons_per_count = 0;  // photon noise: variance = counts / this; 0: none (2)
    double read_noise_counts = 0;    // standard deviation (15)
    double relative_noise = 0;       // of the light that each pixel reads, besides photon noise
    double dark_counts = 0;          // offset (1500), and per second (200)
    double dark_counts_per_s = 0;
    double nonlinearity = 0;  // of the light: counts (1 + this * counts / max_counts) (-0.02)
    std::vector<double> reported_nonlinearity;  // the correction that the device holds, as
                                                // SpectrometerInfo has it; empty: none
    bool quantise = true;  // rounds to the nearest count; false: up or down at random, with the
                           // unrounded value as the mean, so that rounding biases nothing
    // Light.
    double lamp_temperature_K = 2900;  // a black body through a detector of bell-shaped response
    double source_dop = 0, source_aolp_deg = 0;  // linear polarisation of the lamp (0.02), its
                                                 // azimuth counted as that of the polariser
    double drift_per_hour = 0;                   // relative change of the lamp (0.01)
    // Optics; azimuths from the plane of incidence (p).
    double polariser_extinction = 0;  // leak: transmittance across over along the axis (1e-5)
    double analyser_extinction = 0;
    double polariser_offset_deg = 0, analyser_offset_deg = 0;  // of the true axis against what
                                                               // the mount reports (0.3)
    double retardance_deg = 90;  // of p ahead of s at retarder_nm; a zero-order plate whose fast
                                 // axis is along p: goes as 1/wavelength
    double retarder_nm = 550;
    double retarder_diattenuation = 1;  // amplitude of p over that of s
    double eccentricity_deg = 0;  // of the polariser's mount: azimuth error of once a turn (0.2)
    double mount_jitter_deg = 0;  // standard deviation of each stop of polariser and analyser
                                  // against what it reports (0.05)
    // Detector of lobe scans.
    double detector_half_angle_deg = 0.5;

    // Throws Error (user) that begins with `where` for settings that make no bench.
    void check(const std::string& where) const;
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

// A part of an exposure: what the parts stood at during `seconds` of it.
struct ExposurePart {
    OpticalState state;
    double seconds = 0;
};

// May be used from several threads; copies share the tables that are kept of the light paths.
class VirtualOptics {
  public:
    // Throws Error (user) for settings that make no bench, and for a material that does not check.
    VirtualOptics(Material sample, VirtualBenchSettings settings);

    const VirtualBenchSettings& settings() const { return settings_; }
    const Material& sample() const { return sample_; }
    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }

    // Azimuths in degrees at which the axes truly stand while the mounts report those of `state`:
    // with offset, eccentricity (of the polariser) and jitter. The jitter is a function of the seed
    // and of the state, not of the order of moves, so that a sweep that was interrupted finds the
    // parts as they would have stood; that of the analyser does not change with the polariser.
    double true_polariser_deg(const OpticalState& state) const;
    double true_analyser_deg(const OpticalState& state) const;

    // Expected counts of every pixel of a frame without noise, not quantised and not clipped: an
    // exposure of `integration_s` beginning at `start_s` of the bench's clock (drift).
    std::vector<double> expected_counts(const OpticalState& state, double integration_s,
                                        double start_s) const;
    // The same of an exposure during which parts moved.
    std::vector<double> expected_counts(const std::vector<ExposurePart>& parts,
                                        double start_s) const;

    // A frame as the detector reads it: noise, quantisation, saturation. Deterministic: a function
    // of the arguments and the seed alone. `exposure` numbers the exposures made in one state; a
    // repeated exposure has the number of its repetition, so that a sweep that was interrupted and
    // taken up again sees the same noise. That of dark frames (lamp off) sees of the state no more
    // than the arms, because polariser and retarder may then stand anywhere.
    std::vector<uint32_t> frame(const OpticalState& state, double integration_s, double start_s,
                                uint64_t exposure) const;
    // Of an exposure during which parts moved: a stale frame, whose noise is that of no frame of
    // the other function. `parts` not empty.
    std::vector<uint32_t> frame(const std::vector<ExposurePart>& parts, double start_s,
                                uint64_t exposure) const;

  private:
    struct LightPaths;

    void add_light(const OpticalState& state, double seconds, double mid_s,
                   std::vector<double>* light) const;
    std::vector<double> detect(std::vector<double> light, double integration_s) const;
    std::vector<uint32_t> read_out(const std::vector<double>& expected, double integration_s,
                                   uint64_t stream) const;

    Material sample_;
    VirtualBenchSettings settings_;
    std::vector<double> wavelengths_nm_;
    std::vector<double> lamp_;  // counts a second of every pixel, polariser and analyser parallel
    std::shared_ptr<LightPaths> paths_;
};

// JSON of the settings, defaults left out; parse: `where` names it in errors, unknown keys are
// Errors (user) with the nearest word. The result was checked.
std::string format_virtual_bench_settings(const VirtualBenchSettings& settings);
VirtualBenchSettings parse_virtual_bench_settings(const std::string& json,
                                                  const std::string& where);
// As part of another document; errors name its file, line and column.
VirtualBenchSettings read_virtual_bench_settings(const JsonValue& value);

}  // namespace drude
