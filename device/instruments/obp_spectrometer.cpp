#include "device/instruments/obp_spectrometer.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "device/device_error.h"
#include "device/instruments/obp_link.h"
#include "device/instruments/spectrometer_link.h"
#include "device/instruments/stored_calibration.h"
#include "device/instruments/usb_spectrometer.h"

namespace drude {

namespace {

constexpr double command_s = 1;  // for a reply from memory to come

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

class ObpSpectrometer final : public UsbSpectrometer {
  public:
    ObpSpectrometer(std::shared_ptr<UsbPort> port, const ObpModel& model, BenchClock& clock)
        : UsbSpectrometer(std::move(port), clock, model.unit_us, model.unit_us),
          model_(model),
          messages_(model.second ? second_version : first_version),
          link_(*port_, model) {
        open();
    }

    Frame acquire() override {
        forget_gathered();
        Frame frame;
        frame.requested_s = clock_.now();
        const Deadline deadline = frame_deadline();
        std::vector<uint8_t> data = link_.query(model_.spectrum_message, {}, deadline);
        // A device that buffers answers with nothing as long as its buffer is empty.
        while (data.empty() && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            data = link_.query(model_.spectrum_message, {}, deadline);
        }
        frame.arrived_s = clock_.now();
        frame.counts = parse_obp_spectrum(data, model_, port_->name());
        frame_came();
        return frame;
    }

  private:
    void start() override {
        link_.drain();
        link_.command(messages_.set_trigger_mode, {0});
        take_readout(model_.readout_s, model_.spectrum_bytes());
    }

    void clear() override { link_.clear(); }
    std::string serial_in_memory() override { return stored_text(ask(get_serial)); }
    void send_integration_time(uint32_t units) override {
        link_.command(messages_.set_integration_time, four_bytes(units));
    }
    void send_lamp(bool on) override {
        link_.command(set_lamp_state, {static_cast<uint8_t>(on ? 1 : 0)});
    }

    void read_calibration() override {
        take_identity(
            "obp",
            fmt::format("{} {}", model_.second ? "Ocean Insight" : "Ocean Optics", model_.name),
            model_);
        info_.wavelength_nm = polynomial_wavelengths(
            coefficients(messages_.wavelength, "wavelength"), model_.pixels, 0, port_->name());
        read_saturation();
        read_nonlinearity();
        info_.has_lamp_control = !model_.second && answers(get_lamp);
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

    std::vector<uint8_t> ask(uint32_t type, const std::vector<uint8_t>& data = {}) {
        return link_.query(type, data, deadline_in(command_s));
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
        std::string reason;
        std::vector<double> values;
        try {
            values = coefficients(messages_.nonlinearity, "non-linearity");
            reason = why_nonlinearity_is_unusable(values, info_.max_counts);
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::refused) throw;
            reason = "it gives none";
        }
        take_nonlinearity(std::move(values), reason);
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

    const ObpModel& model_;
    const Messages& messages_;
    ObpLink link_;
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
    const auto width = static_cast<size_t>(model.bytes_per_count);
    std::vector<uint32_t> counts(static_cast<size_t>(model.pixels));
    for (size_t i = 0; i < counts.size(); ++i) {
        for (size_t j = width; j-- > 0;) {
            counts[i] = counts[i] << 8 | data[model.metadata_bytes + i * width + j];
        }
    }
    return counts;
}

}  // namespace drude
