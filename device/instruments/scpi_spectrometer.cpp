#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.h"
#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/instruments/scpi_head.h"
#include "device/instruments/scpi_link.h"

namespace drude {

namespace {

constexpr double command_s = 5;
// From the end of an exposure to the last byte of some ten thousand numbers as text.
constexpr double readout_s = 1;
constexpr double margin_s = 2;

class ScpiSpectrometer : public Spectrometer {
  public:
    ScpiSpectrometer(std::shared_ptr<UsbPort> port, const ScpiCommands& commands)
        : link_(std::move(port), commands) {
        info_.uri = link_.uri();
        info_.model = link_.identity().model;
        info_.serial = link_.identity().serial;
        info_.wavelength_nm = link_.wavelengths();
        info_.max_counts = commands.max_counts;
        info_.shortest_s = commands.shortest_s;
        info_.longest_s = commands.longest_s;
        info_.readout_s = readout_s;
        info_.has_lamp_control = !commands.lamp.empty();
        integration_s_ = std::clamp(0.1, info_.shortest_s, info_.longest_s);
        set_up();
    }

    const SpectrometerInfo& info() const override { return info_; }

    void set_integration_time(double seconds) override {
        if (!(seconds >= info_.shortest_s && seconds <= info_.longest_s)) {
            user_error("{}: an integration time of {} s; expected {} to {} s", link_.name(),
                       seconds, info_.shortest_s, info_.longest_s);
        }
        integration_s_ = seconds;
        link_.command(scpi_command(link_.commands().integration, format_double(seconds)),
                      command_s);
    }
    double integration_time() const override { return integration_s_; }

    void set_lamp(bool on) override {
        lamp_on_ = on;
        if (!info_.has_lamp_control) return;
        link_.command(scpi_command(link_.commands().lamp, on ? "1" : "0"), command_s);
    }

    Frame acquire() override {
        Frame frame;
        frame.requested_s = real_clock().now();
        // A head in free run may hand out its next whole exposure: two integration times.
        const std::vector<double> numbers =
            link_.ask_numbers(link_.commands().spectrum, 2 * integration_s_ + readout_s + margin_s);
        frame.arrived_s = real_clock().now();
        frame.counts =
            scpi_counts(numbers, info_.wavelength_nm.size(), info_.max_counts, link_.name());
        return frame;
    }

    void recover() override {
        link_.recover();
        set_up();
    }
    bool reconnect(double seconds) override {
        if (!link_.reconnect(seconds)) return false;
        set_up();
        return true;
    }

  private:
    void set_up() {
        set_integration_time(integration_s_);
        set_lamp(lamp_on_);
    }

    ScpiLink link_;
    SpectrometerInfo info_;
    double integration_s_ = 0;
    bool lamp_on_ = true;
};

}  // namespace

std::vector<uint32_t> scpi_counts(const std::vector<double>& numbers, size_t pixels,
                                  uint32_t max_counts, const std::string& where) {
    if (numbers.size() != pixels) {
        device_error(Fault::bad_frame, "{}: answered {} intensities; expected {}", where,
                     numbers.size(), pixels);
    }
    std::vector<uint32_t> counts;
    counts.reserve(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        // Infinity is what an instrument says that overflowed.
        if (std::isnan(numbers[i]) || numbers[i] < 0) {
            device_error(Fault::bad_frame, "{}: pixel {} reads {}; expected a count of 0 or more",
                         where, i, numbers[i]);
        }
        const double count = std::min(std::round(numbers[i]), static_cast<double>(max_counts));
        counts.push_back(static_cast<uint32_t>(count));
    }
    return counts;
}

std::shared_ptr<Spectrometer> open_scpi_spectrometer(std::shared_ptr<UsbPort> port,
                                                     const ScpiCommands& commands) {
    return std::make_shared<ScpiSpectrometer>(std::move(port), commands);
}

}  // namespace drude
