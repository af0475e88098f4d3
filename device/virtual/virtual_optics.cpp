#include "device/virtual/virtual_optics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "base/counter_random.h"
#include "base/error.h"
#include "device/virtual/light_path.h"
#include "device/virtual/state_hash.h"
#include "materials/optical_elements.h"

namespace drude {

namespace {

StateHash frame_hash(const OpticalState& state, double integration_s, uint64_t exposure) {
    StateHash hash(state.lamp_on ? Draw::frame : Draw::dark_frame);
    hash.add_arms(state).add(integration_s * 1e3).add(exposure);
    if (!state.lamp_on) return hash;
    return hash.add_azimuth(state.polariser_deg)
        .add_azimuth(state.analyser_deg)
        .add(uint64_t{state.retarder_in});
}

// ---- elements
// ------------------------------------------------------------------------------------

// The axis of an element, whose azimuth counts from p, in the frame whose x is s: p stands 90
// degrees from s towards p.
Rotation<double> axis_at(double azimuth_deg) {
    const double twice = 2 * azimuth_deg * degree;
    return {-std::cos(twice), -std::sin(twice)};
}

// A polariser that leaks: two ideal ones, crossed, without a phase between them.
Mueller<double> leaking_polariser(double azimuth_deg, double leak) {
    Mueller<double> sum = linear_polariser(axis_at(azimuth_deg));
    const Mueller<double> across = linear_polariser(axis_at(azimuth_deg + 90));
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) sum.m[i][j] += leak * across.m[i][j];
    }
    return sum;
}

// The fast axis is along p. An amplitude transmittance of p over s above 1 means that
// less of s comes through.
Mueller<double> retarder(double retardance_deg, double diattenuation) {
    const double most = std::max(1.0, diattenuation);
    const double s = 1 / most, p = diattenuation / most;
    const Reflection<double> transmitted{s * s, p * p, s * p, 0};
    return mueller(transmitted) * linear_retarder(axis_at(0), retardance_deg * degree);
}

// Relative spectral energy of a black body (Planck) times a bell-shaped response of the detector.
double lamp_shape(double wavelength_nm, double kelvin) {
    constexpr double second_radiation_constant = 1.438776877e7;  // nm K
    const double x = second_radiation_constant / (wavelength_nm * kelvin);
    const double planck = std::pow(wavelength_nm / 1000, -5) / std::expm1(x);
    const double bell = (wavelength_nm - 500) / 180;
    return planck * std::exp(-bell * bell / 2);
}

}  // namespace

// ---- light paths
// ---------------------------------------------------------------------------------

// Sample and retarder between two elements that know no S3, at every pixel.
using BetweenElements = std::vector<std::array<double, 9>>;

// What is kept of the positions of arms and retarder that were asked for.
struct VirtualOptics::LightPaths {
    explicit LightPaths(SampledSurface sampled) : surface(std::move(sampled)) {}

    // Straight through, incidence, offset, retarder.
    using Key = std::array<double, 4>;
    static constexpr size_t most_kept = 64;

    SampledSurface surface;
    std::mutex mutex;
    std::map<Key, std::shared_ptr<const BetweenElements>> kept;

    std::shared_ptr<const BetweenElements> at(const VirtualOptics& optics,
                                              const OpticalState& state) {
        Key key{state.straight_through ? 1.0 : 0.0, 0, 0, state.retarder_in ? 1.0 : 0.0};
        if (!state.straight_through) {
            key[1] = state.incidence_deg;
            key[2] = state.offset_deg;
        }
        const std::lock_guard lock(mutex);
        const auto found = kept.find(key);
        if (found != kept.end()) return found->second;
        // Sweeps go through the positions one after the other and do not come back.
        if (kept.size() >= most_kept) kept.clear();
        return kept[key] = std::make_shared<BetweenElements>(computed(optics, state));
    }

    BetweenElements computed(const VirtualOptics& optics, const OpticalState& state) const {
        const VirtualBenchSettings& settings = optics.settings();
        const std::vector<PathRows> rows =
            state.straight_through
                ? straight_path(surface.size())
                : sample_path(optics.sample(), surface, state.incidence_deg, state.offset_deg,
                              settings.detector_half_angle_deg);
        BetweenElements between(rows.size());
        for (size_t pixel = 0; pixel < rows.size(); ++pixel) {
            const double retardance =
                settings.retardance_deg * settings.retarder_nm / optics.wavelengths_nm()[pixel];
            const Mueller<double> plate =
                state.retarder_in ? retarder(retardance, settings.retarder_diattenuation)
                                  : Mueller<double>::identity();
            for (size_t i = 0; i < 3; ++i) {
                for (size_t j = 0; j < 3; ++j) {
                    double sum = 0;
                    for (size_t l = 0; l < 4; ++l) sum += plate.m[i][l] * rows[pixel].m[l][j];
                    between[pixel][3 * i + j] = sum;
                }
            }
        }
        return between;
    }
};

// ---- the bench
// -----------------------------------------------------------------------------------

VirtualOptics::VirtualOptics(Material sample, VirtualBenchSettings settings)
    : sample_(std::move(sample)), settings_(std::move(settings)) {
    settings_.check("virtual bench");
    const double step =
        (settings_.last_nm - settings_.first_nm) / std::max(1, settings_.pixels - 1);
    for (int pixel = 0; pixel < settings_.pixels; ++pixel) {
        wavelengths_nm_.push_back(settings_.first_nm + pixel * step);
        lamp_.push_back(lamp_shape(wavelengths_nm_.back(), settings_.lamp_temperature_K));
    }
    const double brightest = *std::max_element(lamp_.begin(), lamp_.end());
    for (double& counts : lamp_) {
        counts *= 0.8 * settings_.max_counts / settings_.full_scale_s / brightest;
    }
    paths_ = std::make_shared<LightPaths>(SampledSurface(sample_, wavelengths_nm_));
}

double VirtualOptics::true_polariser_deg(const OpticalState& state) const {
    const double reported = state.polariser_deg;
    const uint64_t stream = StateHash(Draw::polariser_jitter)
                                .add_arms(state)
                                .add(uint64_t{state.retarder_in})
                                .add_azimuth(state.analyser_deg)
                                .add_azimuth(reported)
                                .value();
    return reported + settings_.polariser_offset_deg +
           settings_.eccentricity_deg * std::sin(reported * degree) +
           settings_.mount_jitter_deg * normal_pair(settings_.seed, 0, stream)[0];
}

double VirtualOptics::true_analyser_deg(const OpticalState& state) const {
    const uint64_t stream = StateHash(Draw::analyser_jitter)
                                .add_arms(state)
                                .add(uint64_t{state.retarder_in})
                                .add_azimuth(state.analyser_deg)
                                .value();
    return state.analyser_deg + settings_.analyser_offset_deg +
           settings_.mount_jitter_deg * normal_pair(settings_.seed, 0, stream)[0];
}

void VirtualOptics::add_light(const OpticalState& state, double seconds, double mid_s,
                              std::vector<double>* light) const {
    if (!state.lamp_on) return;
    const Rotation<double> source_axis = axis_at(settings_.source_aolp_deg);
    const Stokes<double> source{
        {1, settings_.source_dop * source_axis.cos2, settings_.source_dop * source_axis.sin2, 0}};
    const Stokes<double> in =
        leaking_polariser(true_polariser_deg(state), settings_.polariser_extinction) * source;
    const Mueller<double> analyser =
        leaking_polariser(true_analyser_deg(state), settings_.analyser_extinction);
    // Two parallel polarisers let half of unpolarised light through; lamp_ counts that as 1.
    const double scale = 2 * seconds * (1 + settings_.drift_per_hour * mid_s / 3600);
    std::array<double, 9> weight;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            weight[3 * static_cast<size_t>(i) + static_cast<size_t>(j)] =
                scale * analyser.m[0][i] * in[j];
        }
    }
    const std::shared_ptr<const BetweenElements> between = paths_->at(*this, state);
    for (size_t pixel = 0; pixel < light->size(); ++pixel) {
        double sum = 0;
        for (size_t j = 0; j < 9; ++j) sum += weight[j] * (*between)[pixel][j];
        (*light)[pixel] += lamp_[pixel] * sum;
    }
}

std::vector<double> VirtualOptics::detect(std::vector<double> light, double integration_s) const {
    const double bend = settings_.nonlinearity / settings_.max_counts;
    const double dark = settings_.dark_counts + settings_.dark_counts_per_s * integration_s;
    for (double& counts : light) counts = dark + counts * (1 + bend * counts);
    return light;
}

std::vector<double> VirtualOptics::expected_counts(const OpticalState& state, double integration_s,
                                                   double start_s) const {
    return expected_counts({{state, integration_s}}, start_s);
}

std::vector<double> VirtualOptics::expected_counts(const std::vector<ExposurePart>& parts,
                                                   double start_s) const {
    std::vector<double> light(wavelengths_nm_.size());
    double passed = 0;
    for (const ExposurePart& part : parts) {
        add_light(part.state, part.seconds, start_s + passed + part.seconds / 2, &light);
        passed += part.seconds;
    }
    return detect(std::move(light), passed);
}

std::vector<uint32_t> VirtualOptics::read_out(const std::vector<double>& expected,
                                              double integration_s, uint64_t stream) const {
    const double dark = settings_.dark_counts + settings_.dark_counts_per_s * integration_s;
    const double photons =
        settings_.electrons_per_count > 0 ? 1 / settings_.electrons_per_count : 0;
    const double read2 = settings_.read_noise_counts * settings_.read_noise_counts;
    const double relative2 = settings_.relative_noise * settings_.relative_noise;
    const bool noisy = photons > 0 || read2 > 0 || relative2 > 0;
    const double most = settings_.max_counts;
    std::vector<uint32_t> frame(expected.size());
    std::array<double, 2> deviates{};
    for (size_t pixel = 0; pixel < expected.size(); ++pixel) {
        double counts = expected[pixel];
        if (noisy) {
            if (pixel % 2 == 0) deviates = normal_pair(settings_.seed, pixel / 2, stream);
            const double light = counts - dark;
            counts += deviates[pixel % 2] * std::sqrt(std::max(0.0, photons * counts) + read2 +
                                                      relative2 * light * light);
        }
        const double threshold = settings_.quantise ? 0.5 : uniform(settings_.seed, stream, pixel);
        frame[pixel] = static_cast<uint32_t>(std::clamp(std::floor(counts + threshold), 0.0, most));
    }
    return frame;
}

std::vector<uint32_t> VirtualOptics::frame(const OpticalState& state, double integration_s,
                                           double start_s, uint64_t exposure) const {
    return read_out(expected_counts(state, integration_s, start_s), integration_s,
                    frame_hash(state, integration_s, exposure).value());
}

std::vector<uint32_t> VirtualOptics::frame(const std::vector<ExposurePart>& parts, double start_s,
                                           uint64_t exposure) const {
    StateHash hash(Draw::mixed_frame);
    hash.add(exposure);
    double integration_s = 0;
    for (const ExposurePart& part : parts) {
        hash.add(frame_hash(part.state, part.seconds, 0).value());
        integration_s += part.seconds;
    }
    return read_out(expected_counts(parts, start_s), integration_s, hash.value());
}

}  // namespace drude
