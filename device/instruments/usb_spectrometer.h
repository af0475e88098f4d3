// What drivers of spectrometers on USB share, whatever their protocol: opening with retries, and an
// integration time and a lamp that are as they were after a recovery.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/bench_clock.h"
#include "device/spectrometer.h"
#include "device/usb/usb_port.h"

namespace drude {

class UsbSpectrometer : public Spectrometer {
  public:
    const SpectrometerInfo& info() const override { return info_; }
    double integration_time() const override { return integration_s_; }
    void set_integration_time(double seconds) override;
    void set_lamp(bool on) override;
    void recover() override { set_up_again(false); }
    bool reconnect(double seconds) override;

  protected:
    // Of the integration time, in microseconds: the protocol's unit, and the device's resolution,
    // a multiple of it.
    UsbSpectrometer(std::shared_ptr<UsbPort> port, BenchClock& clock, uint32_t unit_us,
                    uint32_t step_us)
        : port_(std::move(port)), clock_(clock), unit_us_(unit_us), step_us_(step_us) {}

    // The last step of a driver's constructor; a fault that may pass is met with two more attempts.
    void open();

    // From any state to one in which requests are answered.
    virtual void start() = 0;
    // Halts cleared, what lies unread dropped.
    virtual void clear() = 0;
    virtual std::string serial_in_memory() = 0;
    virtual void read_calibration() = 0;
    virtual void send_integration_time(uint32_t units) = 0;
    virtual void send_lamp(bool on) = 0;

    // The exposure that runs now, at worst the whole of the next, its readout.
    Deadline frame_deadline() const;
    void frame_came() { running_s_ = integration_s_; }

    // For read_calibration(): serial number, name and the numbers of the model's table.
    template <class Model>
    void take_identity(const std::string& scheme, std::string name, const Model& model) {
        info_.warnings.clear();
        info_.serial = read_serial();
        info_.uri = scheme + ":" + (port_->serial().empty() ? info_.serial : port_->serial());
        info_.model = std::move(name);
        info_.max_counts = model.max_counts;
        info_.shortest_s = model.shortest_us / 1e6;
        info_.longest_s = model.longest_us / 1e6;
        info_.dark_first = model.dark_first;
        info_.dark_count = model.dark_count;
    }
    // `reason`: why the coefficients cannot be used; empty where they can.
    void take_nonlinearity(std::vector<double> coefficients, const std::string& reason);
    // For start(): `readout_s` is that of a high-speed link, `bytes` those of a frame.
    void take_readout(double readout_s, size_t bytes);

    std::shared_ptr<UsbPort> port_;
    BenchClock& clock_;
    SpectrometerInfo info_;

  private:
    void set_up_again(bool maybe_another);
    std::string read_serial();

    uint32_t unit_us_, step_us_;
    uint32_t units_ = 0;
    double integration_s_ = 0;
    double running_s_ = 0;  // of the exposure that may be running: set before the last change
    bool lamp_ = false, lamp_is_ours_ = false;
};

}  // namespace drude
