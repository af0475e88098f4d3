// The spectrometer of the virtual bench.
#include <utility>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/free_run.h"
#include "device/virtual/virtual_parts.h"

namespace drude {

namespace {

// Free-running; how exposures are numbered is told at make_virtual_bench().
class VirtualSpectrometer : public Spectrometer {
  public:
    explicit VirtualSpectrometer(std::shared_ptr<VirtualRig> rig) : rig_(std::move(rig)) {
        const VirtualBenchSettings& settings = rig_->optics().settings();
        info_.uri = "virtual:spectrometer";
        info_.model = "virtual spectrometer";
        info_.serial = "VIRTUAL-" + std::to_string(settings.seed);
        info_.wavelength_nm = rig_->optics().wavelengths_nm();
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
        run_.set_integration(rig_->clock()->now(), seconds);
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
        frame.requested_s = rig_->clock()->now();
        const double wait_s = run_.next().end_s() - frame.requested_s;
        if (wait_s > 0) rig_->clock()->sleep(wait_s);
        const FreeRun::Exposure exposure = run_.hand_out(rig_->clock()->now());
        frame.counts = counts_of(exposure);
        rig_->clock()->sleep(info_.readout_s);
        frame.arrived_s = rig_->clock()->now();
        return frame;
    }

    void recover() override {
        rig_->transfer(part);
        rig_->clock()->sleep(setup_s);
        restart();
    }

    bool reconnect(double seconds) override {
        if (!rig_->comes_back(part, seconds)) return false;
        rig_->clock()->sleep(setup_s);
        restart();
        return true;
    }

  private:
    static constexpr const char* part = "spectrometer";
    static constexpr double setup_s = 0.1;

    void restart() {
        run_ = FreeRun(rig_->clock()->now(), run_.integration());
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
            return rig_->optics().frame(rig_->state(), exposure.integration_s, exposure.start_s,
                                        fresh_++);
        }
        return rig_->optics().frame(parts, exposure.start_s, discarded_++);
    }

    std::shared_ptr<VirtualRig> rig_;
    SpectrometerInfo info_;
    FreeRun run_{0, 0.1};
    uint64_t entries_ = 0, fresh_ = 0, discarded_ = 0;
    bool first_ = true;
};

}  // namespace

std::shared_ptr<Spectrometer> make_virtual_spectrometer(std::shared_ptr<VirtualRig> rig) {
    return std::make_shared<VirtualSpectrometer>(std::move(rig));
}

}  // namespace drude
