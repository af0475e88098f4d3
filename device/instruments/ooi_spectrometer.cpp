#include "device/instruments/ooi_spectrometer.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "device/instruments/ooi_models.h"
#include "device/instruments/ooi_protocol.h"
#include "device/instruments/spectrometer_link.h"
#include "device/instruments/stored_calibration.h"
#include "device/instruments/usb_spectrometer.h"

namespace drude {

namespace {

constexpr double command_s = 1;  // for a request to be taken, and a reply from memory to come
constexpr size_t first_part_bytes = 2048;

// Requests and their replies, without state of the spectrometer.
class OoiLink {
  public:
    OoiLink(UsbPort& port, const OoiModel& model) : port_(port), model_(model) {}

    void send(const OoiBytes& request) { port_.write(model_.out, request, deadline_in(command_s)); }

    // The reply to `request` that `belongs`; what an earlier request left behind is dropped. Where
    // only such replies came, the last of them is returned, for its parser to complain about.
    OoiBytes query(const OoiBytes& request,
                   const std::function<bool(std::span<const uint8_t>)>& belongs) {
        send(request);
        const Deadline deadline = deadline_in(command_s);
        OoiBytes stale;
        for (int replies = 0; replies < 16; ++replies) {
            OoiBytes reply(whole_packets(port_, model_.reply, ooi_slot_bytes));
            try {
                reply.resize(port_.read(model_.reply, reply, deadline));
            } catch (const DeviceError& error) {
                if (error.fault() != Fault::timeout || stale.empty()) throw;
                break;
            }
            if (belongs(reply)) return reply;
            if (!reply.empty()) stale = std::move(reply);
        }
        return stale;
    }

    std::array<uint8_t, 15> slot(uint8_t number) {
        const OoiBytes reply = query(ooi_query_slot(number), [&](std::span<const uint8_t> bytes) {
            return is_ooi_slot_reply(bytes, number);
        });
        return parse_ooi_slot(reply, number, port_.name());
    }

    OoiStatus status() {
        const OoiBytes reply = query(ooi_query_status(), [](std::span<const uint8_t> bytes) {
            return bytes.size() == ooi_status_bytes;
        });
        return parse_ooi_status(reply, port_.name());
    }

    void initialize(BenchClock& clock) {
        send(ooi_initialize());
        clock.sleep(0.1);
    }
    void drain() { drain_all(port_, {model_.reply, model_.spectrum, model_.first}); }
    void clear() {
        clear_transport(port_, {model_.out, model_.reply, model_.spectrum, model_.first});
    }

  private:
    UsbPort& port_;
    const OoiModel& model_;
};

class OoiSpectrometer final : public UsbSpectrometer {
  public:
    OoiSpectrometer(std::shared_ptr<UsbPort> port, const OoiModel& model, BenchClock& clock)
        : UsbSpectrometer(std::move(port), clock, model.unit_us, model.step_us),
          model_(model),
          link_(*port_, model) {
        open();
    }

    Frame acquire() override {
        Frame frame;
        frame.requested_s = clock_.now();
        link_.send(ooi_request_spectrum());
        const Deadline deadline = frame_deadline();
        OoiBytes bytes;
        bytes.reserve(model_.frame_bytes());
        if (high_speed_ && model_.first != 0)
            read_part(model_.first, first_part_bytes, deadline, &bytes);
        read_part(model_.spectrum, model_.frame_bytes() - bytes.size(), deadline, &bytes);
        frame.arrived_s = clock_.now();
        frame.counts = parse_ooi_frame(bytes, model_, port_->name());
        frame_came();
        return frame;
    }

  private:
    void start() override {
        link_.drain();
        link_.initialize(clock_);
        link_.drain();  // an exposure that the initialisation did not stop
        // A full-speed link has no second endpoint of frames: all of one comes from `spectrum`. The
        // oldest models are full-speed devices that know nothing else.
        high_speed_ = !model_.has_status || link_.status().high_speed;
        link_.send(ooi_set_trigger_mode(0));
        take_readout(model_.readout_s, model_.frame_bytes());
    }

    void clear() override { link_.clear(); }
    std::string serial_in_memory() override { return stored_text(link_.slot(0)); }
    void send_integration_time(uint32_t units) override {
        link_.send(ooi_set_integration_time(units));
    }
    void send_lamp(bool on) override { link_.send(ooi_set_lamp(on)); }

    void read_calibration() override {
        take_identity("ooi", fmt::format("Ocean Optics {}", model_.name), model_);
        info_.has_lamp_control = true;
        std::vector<double> wavelength;
        for (uint8_t slot = 1; slot <= 4; ++slot) {
            wavelength.push_back(ooi_slot_number(link_.slot(slot)));
        }
        info_.wavelength_nm =
            polynomial_wavelengths(wavelength, model_.pixels, model_.pixel_origin, port_->name());
        if (model_.saturation != SaturationSlot::none) {
            info_.max_counts = parse_ooi_saturation(link_.slot(17), model_);
        }
        read_nonlinearity();
        if (model_.has_status && !high_speed_) {
            info_.warnings.emplace_back(
                "it is on a full-speed link (12 Mbit/s): spectra take longer; a USB 2 port without "
                "an old hub between would be faster");
        }
    }

    void read_nonlinearity() {
        const double order = ooi_slot_number(link_.slot(14));
        if (!(order >= 0 && order <= 7)) {
            return take_nonlinearity({}, "their order is not a number from 0 to 7");
        }
        std::vector<double> coefficients;
        for (uint8_t i = 0; i <= static_cast<uint8_t>(order); ++i) {
            coefficients.push_back(ooi_slot_number(link_.slot(static_cast<uint8_t>(6 + i))));
        }
        const std::string reason = why_nonlinearity_is_unusable(coefficients, info_.max_counts);
        take_nonlinearity(std::move(coefficients), reason);
    }

    void read_part(uint8_t endpoint, size_t wanted, Deadline deadline, OoiBytes* bytes) {
        OoiBytes part(whole_packets(*port_, endpoint, wanted));
        size_t count = port_->read(endpoint, part, deadline);
        // An empty packet that ended an earlier message.
        if (count == 0) count = port_->read(endpoint, part, deadline);
        if (count != wanted) {
            device_error(count < wanted ? Fault::short_read : Fault::overflow,
                         "{}: {} bytes of a spectrum came from endpoint {:02x} instead of {}",
                         port_->name(), count, endpoint, wanted);
        }
        bytes->insert(bytes->end(), part.begin(),
                      part.begin() + static_cast<std::ptrdiff_t>(count));
    }

    const OoiModel& model_;
    OoiLink link_;
    bool high_speed_ = true;
};

}  // namespace

std::shared_ptr<Spectrometer> open_ooi(std::shared_ptr<UsbPort> port, BenchClock& clock) {
    const OoiModel* model = find_ooi_model(port->product());
    if (!model) {
        user_error("{}: it is no spectrometer of the OOI protocol ({:04x}:{:04x})", port->name(),
                   port->vendor(), port->product());
    }
    return std::make_shared<OoiSpectrometer>(std::move(port), *model, clock);
}

std::string ask_ooi_serial(UsbPort& port) {
    const OoiModel* model = find_ooi_model(port.product());
    if (!model) return {};
    OoiLink link(port, *model);
    std::string serial;
    with_retries(
        [&] {
            link.drain();
            link.initialize(real_clock());
            serial = stored_text(link.slot(0));
        },
        [&] { link.clear(); });
    return serial;
}

}  // namespace drude
