#include "device/virtual/virtual_bench.h"

#include <cmath>
#include <deque>
#include <utility>

#include "base/numbers.h"
#include "base/sha256.h"
#include "device/virtual/free_run.h"
#include "materials/surface.h"

namespace drude {

namespace {

// What the parts share.
class Rig {
  public:
    Rig(const Material& sample, const VirtualBenchSettings& settings, FaultInjection faults)
        : optics(sample, settings), faults_(std::move(faults)) {
        history_.push_back({clock->now(), {}});
    }

    VirtualOptics optics;
    std::shared_ptr<VirtualClock> clock = std::make_shared<VirtualClock>();

    void transfer(const char* part) {
        const uint64_t number = transfers_++;
        if (faults_) faults_(number, part);
    }
    // False where it does not come back within `seconds`, which then have passed.
    bool comes_back(const char* part, double seconds) {
        try {
            transfer(part);
        } catch (const DeviceError&) {
            clock->sleep(seconds);
            return false;
        }
        return true;
    }

    const OpticalState& state() const { return history_.back().state; }
    // From now on, whether it differs or not.
    void enter(const OpticalState& state) {
        if (!(state == this->state())) history_.push_back({clock->now(), state});
        entered_s_ = clock->now();
        ++entries_;
    }
    double entered_s() const { return entered_s_; }
    uint64_t entries() const { return entries_; }

    // What the parts stood at from `start_s` to `end_s`; forgets what was before that.
    std::vector<ExposurePart> between(double start_s, double end_s) {
        while (history_.size() > 1 && history_[1].since_s <= start_s) history_.pop_front();
        std::vector<ExposurePart> parts;
        for (size_t i = 0; i < history_.size(); ++i) {
            const double first = std::max(start_s, history_[i].since_s);
            const double last =
                i + 1 < history_.size() ? std::min(end_s, history_[i + 1].since_s) : end_s;
            if (last > first) parts.push_back({history_[i].state, last - first});
        }
        return parts;
    }

  private:
    struct Since {
        double since_s;
        OpticalState state;
    };

    FaultInjection faults_;
    uint64_t transfers_ = 0, entries_ = 0;
    double entered_s_ = 0;
    std::deque<Since> history_;
};

// ---- spectrometer
// --------------------------------------------------------------------------------

class VirtualSpectrometer : public Spectrometer {
  public:
    explicit VirtualSpectrometer(std::shared_ptr<Rig> rig) : rig_(std::move(rig)) {
        const VirtualBenchSettings& settings = rig_->optics.settings();
        info_.uri = "virtual:spectrometer";
        info_.model = "virtual spectrometer";
        info_.serial = "VIRTUAL-" + std::to_string(settings.seed);
        info_.wavelength_nm = rig_->optics.wavelengths_nm();
        info_.max_counts = settings.max_counts;
        info_.shortest_s = 10e-6;
        info_.longest_s = 65.535;
        info_.readout_s = 0.002;
        info_.nonlinearity = settings.reported_nonlinearity;
        info_.has_lamp_control = true;
    }

    const SpectrometerInfo& info() const override { return info_; }

    void set_integration_time(double seconds) override {
        if (!(seconds >= info_.shortest_s && seconds <= info_.longest_s)) {
            user_error("virtual spectrometer: found an integration time of {} s, expected {} to {}",
                       format_double(seconds), format_double(info_.shortest_s),
                       format_double(info_.longest_s));
        }
        rig_->transfer(part);
        if (seconds == run_.integration()) return;
        run_.set_integration(rig_->clock->now(), seconds);
        rig_->enter(rig_->state());
    }

    double integration_time() const override { return run_.integration(); }

    void set_lamp(bool on) override {
        rig_->transfer(part);
        OpticalState state = rig_->state();
        if (state.lamp_on == on) return;
        state.lamp_on = on;
        rig_->enter(state);
    }

    Frame acquire() override {
        rig_->transfer(part);
        Frame frame;
        frame.requested_s = rig_->clock->now();
        const double wait_s = run_.next().end_s() - frame.requested_s;
        if (wait_s > 0) rig_->clock->sleep(wait_s);
        const FreeRun::Exposure exposure = run_.hand_out(rig_->clock->now());
        frame.counts = counts_of(exposure);
        rig_->clock->sleep(info_.readout_s);
        frame.arrived_s = rig_->clock->now();
        return frame;
    }

    void recover() override {
        rig_->transfer(part);
        rig_->clock->sleep(setup_s);
        restart();
    }

    bool reconnect(double seconds) override {
        if (!rig_->comes_back(part, seconds)) return false;
        rig_->clock->sleep(setup_s);
        restart();
        return true;
    }

  private:
    static constexpr const char* part = "spectrometer";
    static constexpr double setup_s = 0.1;

    void restart() {
        run_ = FreeRun(rig_->clock->now(), run_.integration());
        first_ = true;
    }

    std::vector<uint32_t> counts_of(const FreeRun::Exposure& exposure) {
        if (entries_ != rig_->entries()) {
            entries_ = rig_->entries();
            first_ = true;
            fresh_ = discarded_ = 0;
        }
        const bool fresh = !std::exchange(first_, false) && exposure.start_s >= rig_->entered_s();
        const std::vector<ExposurePart> parts = rig_->between(exposure.start_s, exposure.end_s());
        if (fresh) {
            return rig_->optics.frame(rig_->state(), exposure.integration_s, exposure.start_s,
                                      fresh_++);
        }
        return rig_->optics.frame(parts, exposure.start_s, discarded_++);
    }

    std::shared_ptr<Rig> rig_;
    SpectrometerInfo info_;
    FreeRun run_{0, 0.1};
    uint64_t entries_ = 0, fresh_ = 0, discarded_ = 0;
    bool first_ = true;
};

// ---- mounts
// --------------------------------------------------------------------------------------

constexpr double pulses_per_turn = 143360;  // ELL14

class VirtualRotator : public Rotator {
  public:
    // What the optics are to know of a new position.
    using Moved = std::function<void(double degrees, OpticalState* state)>;

    VirtualRotator(std::shared_ptr<Rig> rig, const char* part, Moved moved)
        : rig_(std::move(rig)), part_(part), moved_(std::move(moved)) {
        info_.uri = std::string("virtual:") + part;
        info_.model = "virtual rotation mount";
        info_.serial = std::string("VIRTUAL-") + part;
        info_.units_per_degree = pulses_per_turn / 360;
        info_.repeatability_deg = rig_->optics.settings().mount_jitter_deg;
        info_.tolerance_deg = 0.1;
    }

    const RotatorInfo& info() const override { return info_; }
    void home() override {
        rig_->transfer(part_);
        go(0);
    }
    double move_to(double degrees) override {
        if (!(std::abs(degrees) <= 1e6)) {
            user_error("virtual {}: found an angle of {} degrees, expected one within 1e6", part_,
                       format_double(degrees));
        }
        rig_->transfer(part_);
        const double pulses = std::round(degrees * info_.units_per_degree);
        const double turns = std::floor(pulses / pulses_per_turn);
        go((pulses - turns * pulses_per_turn) / info_.units_per_degree);
        return pulses / info_.units_per_degree;
    }
    double position() override {
        rig_->transfer(part_);
        return position_deg_;
    }
    void recover() override {
        rig_->transfer(part_);
        rig_->clock->sleep(0.1);
    }
    bool reconnect(double seconds) override { return rig_->comes_back(part_, seconds); }

  private:
    // In [0, 360), through the angles between, as a mount of absolute positions does.
    void go(double degrees) {
        rig_->clock->sleep(0.06 + std::abs(degrees - position_deg_) / 430);
        position_deg_ = degrees;
        OpticalState state = rig_->state();
        moved_(degrees, &state);
        rig_->enter(state);
    }

    std::shared_ptr<Rig> rig_;
    const char* part_;
    Moved moved_;
    RotatorInfo info_;
    double position_deg_ = 0;
};

class VirtualGoniometer : public Goniometer {
  public:
    explicit VirtualGoniometer(std::shared_ptr<Rig> rig) : rig_(std::move(rig)) {}

    std::string description() const override { return "virtual goniometer"; }
    void move_to(double incidence_deg, double offset_deg) override {
        const double exit_deg = incidence_deg + offset_deg;
        if (!(incidence_deg > 0 && incidence_deg < 90)) {
            user_error(
                "virtual goniometer: found an angle of incidence of {} degrees, expected one above "
                "0 and below 90",
                format_double(incidence_deg));
        }
        if (!(exit_deg > -90 && exit_deg < 90)) {
            user_error(
                "virtual goniometer: found a detector at {} + {} degrees from the sample's normal, "
                "expected it above -90 and below 90",
                format_double(incidence_deg), format_double(offset_deg));
        }
        rig_->transfer(part);
        OpticalState state = rig_->state();
        // The detector's arm goes furthest.
        const double from_deg = state.straight_through ? 180 : state.incidence_deg * 2;
        travel(from_deg - incidence_deg * 2 - offset_deg + state.offset_deg);
        state.straight_through = false;
        state.incidence_deg = incidence_deg;
        state.offset_deg = offset_deg;
        rig_->enter(state);
    }
    void straight_through() override {
        rig_->transfer(part);
        OpticalState state = rig_->state();
        if (!state.straight_through) travel(180 - state.incidence_deg * 2 - state.offset_deg);
        state.straight_through = true;
        state.offset_deg = 0;
        rig_->enter(state);
    }
    void recover() override {
        rig_->transfer(part);
        rig_->clock->sleep(0.1);
    }
    bool reconnect(double seconds) override { return rig_->comes_back(part, seconds); }

  private:
    static constexpr const char* part = "goniometer";
    void travel(double degrees) { rig_->clock->sleep(0.2 + std::abs(degrees) / 10); }

    std::shared_ptr<Rig> rig_;
};

std::string describe(const Material& sample, const VirtualBenchSettings& settings) {
    return "{\"virtual\": {\"material_sha256\": \"" + sha256(format_material(sample)) +
           "\", \"settings\": " + format_virtual_bench_settings(settings) + "}}";
}

}  // namespace

Bench make_virtual_bench(const Material& sample, const VirtualBenchSettings& settings,
                         FaultInjection faults) {
    const auto rig = std::make_shared<Rig>(sample, settings, std::move(faults));
    // Mounts wake up at 0.
    OpticalState awake;
    awake.analyser_deg = 0;
    rig->enter(awake);

    Bench bench;
    bench.name = "virtual:" + sample.name;
    bench.description = describe(sample, settings);
    bench.is_virtual = true;
    bench.clock = rig->clock;
    bench.spectrometer = std::make_shared<VirtualSpectrometer>(rig);
    bench.polariser.rotator = std::make_shared<VirtualRotator>(
        rig, "polariser",
        [](double degrees, OpticalState* state) { state->polariser_deg = degrees; });
    bench.analyser.rotator = std::make_shared<VirtualRotator>(
        rig, "analyser",
        [](double degrees, OpticalState* state) { state->analyser_deg = degrees; });
    bench.retarder.present = true;
    bench.retarder.in_deg = 90;
    bench.retarder.out_deg = 0;
    const double in_deg = bench.retarder.in_deg;
    bench.retarder.rotator = std::make_shared<VirtualRotator>(
        rig, "retarder", [in_deg](double degrees, OpticalState* state) {
            state->retarder_in =
                std::abs(degrees - in_deg) < 5;  // the plate is wider than the beam
        });
    bench.goniometer = std::make_shared<VirtualGoniometer>(rig);
    bench.sample = sample.name;
    bench.notes = {{"instrument", "virtual bench (simulated; no hardware was used)"},
                   {"virtual_bench_seed", std::to_string(settings.seed)}};
    if (!sample.substrate.citation.empty()) {
        bench.notes.emplace_back("optical_constants", sample.substrate.citation);
    }
    bench.warnings = range_warnings(sample, settings.first_nm, settings.last_nm);
    return bench;
}

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

VirtualBenchSettings ordinary_bench_settings(uint64_t seed) {
    VirtualBenchSettings settings;
    settings.seed = seed;
    settings.electrons_per_count = 2;
    settings.read_noise_counts = 15;
    settings.dark_counts = 1500;
    settings.dark_counts_per_s = 200;
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
