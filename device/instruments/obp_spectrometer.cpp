#include "device/instruments/obp_spectrometer.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "device/device_error.h"
#include "device/instruments/obp_link.h"
#include "device/instruments/spectrometer_link.h"
#include "device/instruments/stored_calibration.h"

namespace drude {

namespace {

constexpr double command_s = 1;  // for a reply from memory to come
constexpr double margin_s = 1;   // of a frame

// Message types of both versions.
struct Messages {
    uint32_t set_integration_time, set_trigger_mode;
    uint32_t wavelength, nonlinearity;  // first version: of one coefficient
};
constexpr Messages first_version = {0x00110010, 0x00110110, 0x00180101, 0x00181101};
constexpr Messages second_version = {0x00000C01, 0x00000D01, 0x00001100, 0x00001200};
constexpr uint32_t get_serial = 0x00000100;
constexpr uint32_t get_lamp = 0x00110400, set_lamp_state = 0x00110410;  // first version
constexpr uint32_t get_saturation = 0x00011D00;                         // second version

std::vector<uint8_t> four_bytes(uint32_t value) {
    return {static_cast<uint8_t>(value), static_cast<uint8_t>(value >> 8),
            static_cast<uint8_t>(value >> 16), static_cast<uint8_t>(value >> 24)};
}

class ObpSpectrometer : public Spectrometer {
  public:
    ObpSpectrometer(std::shared_ptr<UsbPort> port, const ObpModel& model, BenchClock& clock)
        : port_(std::move(port)),
          model_(model),
          messages_(model.second ? second_version : first_version),
          clock_(clock),
          link_(*port_, model) {
        with_retries(
            [&] {
                start();
                read_calibration();
                set_integration_time(std::clamp(0.1, info_.shortest_s, info_.longest_s));
            },
            [&] { link_.clear(); });
    }

    const SpectrometerInfo& info() const override { return info_; }
    double integration_time() const override { return integration_s_; }

    void set_integration_time(double seconds) override {
        const uint32_t units = integration_units(seconds, info_.shortest_s, info_.longest_s,
                                                 model_.unit_us, model_.unit_us, port_->name());
        link_.command(messages_.set_integration_time, four_bytes(units));
        units_ = units;
        // The exposure that runs now keeps the time that it began with.
        running_s_ = std::max(running_s_, integration_s_);
        integration_s_ = 1.0 * model_.unit_us * units / 1e6;
    }

    void set_lamp(bool on) override {
        if (!info_.has_lamp_control) return;
        link_.command(set_lamp_state, {static_cast<uint8_t>(on ? 1 : 0)});
        lamp_ = on;
        lamp_is_ours_ = true;
    }

    Frame acquire() override {
        forget_gathered();
        Frame frame;
        frame.requested_s = clock_.now();
        // The exposure that runs now, at worst the whole of the next, its readout.
        const Deadline deadline = deadline_in(std::max(running_s_, integration_s_) +
                                              integration_s_ + info_.readout_s + margin_s);
        std::vector<uint8_t> data = link_.query(model_.spectrum_message, {}, deadline);
        // A device that buffers answers with nothing as long as its buffer is empty.
        while (data.empty() && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            data = link_.query(model_.spectrum_message, {}, deadline);
        }
        frame.arrived_s = clock_.now();
        frame.counts = parse_obp_spectrum(data, model_, port_->name());
        running_s_ = integration_s_;
        return frame;
    }

    void recover() override { set_up_again(false); }

    bool reconnect(double seconds) override {
        if (!port_->reopen(seconds)) return false;
        set_up_again(true);
        return true;
    }

  private:
    void set_up_again(bool maybe_another) {
        link_.clear();
        with_retries(
            [&] {
                start();
                if (maybe_another) check_serial(read_serial(), info_.serial, port_->name());
                link_.command(messages_.set_integration_time, four_bytes(units_));
                running_s_ = integration_s_;
                if (lamp_is_ours_) set_lamp(lamp_);
            },
            [&] { link_.clear(); });
    }

    std::string read_serial() {
        const std::string in_memory = stored_text(ask(get_serial));
        return in_memory.empty() ? port_->serial() : in_memory;
    }

    // A device that gathers spectra by itself has some of before the request.
    void forget_gathered() {
        if (model_.clear_message == 0 || !gathers_) return;
        try {
            link_.command(model_.clear_message, {});
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::refused) throw;
            gathers_ = false;  // firmware from before it could
        }
    }

    void start() {
        link_.drain();
        link_.command(messages_.set_trigger_mode, {0});
        info_.readout_s = model_.readout_s;
        // 12 Mbit/s carry about 1 MB a second.
        if (!port_->high_speed()) {
            info_.readout_s += 1.2e-6 * static_cast<double>(model_.spectrum_bytes());
        }
    }

    std::vector<uint8_t> ask(uint32_t type, const std::vector<uint8_t>& data = {}) {
        return link_.query(type, data, deadline_in(command_s));
    }

    void read_calibration() {
        info_.warnings.clear();
        info_.serial = read_serial();
        info_.uri = "obp:" + (port_->serial().empty() ? info_.serial : port_->serial());
        info_.model =
            fmt::format("{} {}", model_.second ? "Ocean Insight" : "Ocean Optics", model_.name);
        info_.max_counts = model_.max_counts;
        info_.shortest_s = model_.shortest_us / 1e6;
        info_.longest_s = model_.longest_us / 1e6;
        info_.dark_first = model_.dark_first;
        info_.dark_count = model_.dark_count;
        info_.wavelength_nm = polynomial_wavelengths(
            coefficients(messages_.wavelength, "wavelength"), model_.pixels, 0, port_->name());
        read_saturation();
        read_nonlinearity();
        info_.has_lamp_control = !model_.second && answers(get_lamp);
    }

    // The second version sends all coefficients at once, after four bytes that are none of them.
    std::vector<double> coefficients(uint32_t type, const char* what) {
        if (model_.second) {
            std::vector<double> values = parse_obp_floats(ask(type), what, port_->name());
            values.erase(values.begin());
            return values;
        }
        // The message before that of a coefficient asks for their number.
        const uint32_t count = parse_obp_number(ask(type - 1), what, port_->name());
        if (count > 16) {
            device_error(Fault::bad_frame, "{}: it says that it has {} {} coefficients",
                         port_->name(), count, what);
        }
        std::vector<double> values;
        for (uint32_t i = 0; i < count; ++i) {
            const std::vector<uint8_t> one = ask(type, {static_cast<uint8_t>(i)});
            values.push_back(parse_obp_floats(one, what, port_->name())[0]);
        }
        return values;
    }

    void read_nonlinearity() {
        info_.nonlinearity.clear();
        std::string reason;
        std::vector<double> values;
        try {
            values = coefficients(messages_.nonlinearity, "non-linearity");
            reason = why_nonlinearity_is_unusable(values, info_.max_counts);
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::refused) throw;
            reason = "it gives none";
        }
        if (reason.empty()) {
            info_.nonlinearity = std::move(values);
        } else {
            info_.warnings.push_back("the non-linearity coefficients in its memory are not used: " +
                                     reason);
        }
    }

    void read_saturation() {
        if (!model_.second) return;
        try {
            const uint32_t counts =
                parse_obp_number(ask(get_saturation), "the saturation level", port_->name());
            if (counts > 0 && counts < model_.max_counts) info_.max_counts = counts;
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::refused) throw;
        }
    }

    bool answers(uint32_t type) {
        try {
            ask(type);
            return true;
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::refused) throw;
            return false;
        }
    }

    std::shared_ptr<UsbPort> port_;
    const ObpModel& model_;
    const Messages& messages_;
    BenchClock& clock_;
    ObpLink link_;
    SpectrometerInfo info_;
    uint32_t units_ = 0;
    double integration_s_ = 0;
    double running_s_ = 0;  // of the exposure that may be running: set before the last change
    bool lamp_ = false, lamp_is_ours_ = false;
    bool gathers_ = true;
};

}  // namespace

std::shared_ptr<Spectrometer> open_obp(std::shared_ptr<UsbPort> port, BenchClock& clock) {
    const ObpModel* model = find_obp_model(port->vendor(), port->product());
    if (!model) {
        user_error("{}: it is no spectrometer of the OBP protocol ({:04x}:{:04x})", port->name(),
                   port->vendor(), port->product());
    }
    return std::make_shared<ObpSpectrometer>(std::move(port), *model, clock);
}

std::string ask_obp_serial(UsbPort& port) {
    const ObpModel* model = find_obp_model(port.vendor(), port.product());
    if (!model) return {};
    ObpLink link(port, *model);
    std::string serial;
    with_retries(
        [&] {
            link.drain();
            serial = stored_text(link.query(get_serial, {}, deadline_in(command_s)));
        },
        [&] { link.clear(); });
    return serial;
}

std::vector<uint32_t> parse_obp_spectrum(std::span<const uint8_t> data, const ObpModel& model,
                                         const std::string& device) {
    const size_t expected = model.spectrum_bytes();
    if (data.size() != expected) {
        device_error(data.size() < expected ? Fault::short_read : Fault::overflow,
                     "{}: {} bytes came for a spectrum, which has {}", device, data.size(),
                     expected);
    }
    const size_t width = static_cast<size_t>(model.bytes_per_count);
    std::vector<uint32_t> counts(static_cast<size_t>(model.pixels));
    for (size_t i = 0; i < counts.size(); ++i) {
        for (size_t j = width; j-- > 0;) {
            counts[i] = counts[i] << 8 | data[model.metadata_bytes + i * width + j];
        }
    }
    return counts;
}

}  // namespace drude
