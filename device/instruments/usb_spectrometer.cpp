#include "device/instruments/usb_spectrometer.h"

#include <algorithm>

#include "device/instruments/spectrometer_link.h"

namespace drude {

namespace {

constexpr double margin_s = 1;  // of a frame

}  // namespace

void UsbSpectrometer::open() {
    with_retries(
        [&] {
            start();
            read_calibration();
            set_integration_time(std::clamp(0.1, info_.shortest_s, info_.longest_s));
        },
        [&] { clear(); });
}

void UsbSpectrometer::set_integration_time(double seconds) {
    const uint32_t units = integration_units(seconds, info_.shortest_s, info_.longest_s, unit_us_,
                                             step_us_, port_->name());
    send_integration_time(units);
    units_ = units;
    // The exposure that runs now keeps the time that it began with.
    running_s_ = std::max(running_s_, integration_s_);
    integration_s_ = 1.0 * unit_us_ * units / 1e6;
}

void UsbSpectrometer::set_lamp(bool on) {
    if (!info_.has_lamp_control) return;
    send_lamp(on);
    lamp_ = on;
    lamp_is_ours_ = true;
}

bool UsbSpectrometer::reconnect(double seconds) {
    if (!port_->reopen(seconds)) return false;
    set_up_again(true);
    return true;
}

// After an unplugging it may be another one: descriptors seldom have serial numbers, so the port
// cannot tell.
void UsbSpectrometer::set_up_again(bool maybe_another) {
    clear();
    with_retries(
        [&] {
            start();
            if (maybe_another) check_serial(read_serial(), info_.serial, port_->name());
            send_integration_time(units_);
            running_s_ = integration_s_;
            if (lamp_is_ours_) send_lamp(lamp_);
        },
        [&] { clear(); });
}

std::string UsbSpectrometer::read_serial() {
    const std::string in_memory = serial_in_memory();
    return in_memory.empty() ? port_->serial() : in_memory;
}

Deadline UsbSpectrometer::frame_deadline() const {
    return deadline_in(std::max(running_s_, integration_s_) + integration_s_ + info_.readout_s +
                       margin_s);
}

void UsbSpectrometer::take_nonlinearity(std::vector<double> coefficients,
                                        const std::string& reason) {
    info_.nonlinearity.clear();
    if (reason.empty()) {
        info_.nonlinearity = std::move(coefficients);
    } else {
        info_.warnings.push_back("the non-linearity coefficients in its memory are not used: " +
                                 reason);
    }
}

void UsbSpectrometer::take_readout(double readout_s, size_t bytes) {
    info_.readout_s = readout_s;
    // 12 Mbit/s carry about 1 MB a second.
    if (!port_->high_speed()) info_.readout_s += 1.2e-6 * static_cast<double>(bytes);
}

}  // namespace drude
