// Thorlabs K10CR1: a stepper rotation mount with an APT controller behind an FTDI chip.
//
// 115200 baud, 8N1, RTS/CTS. Verified against virtual instruments.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/instruments/apt_message.h"
#include "device/instruments/ftdi_serial.h"
#include "device/rotator.h"

namespace drude {

// 409600/3 microsteps are a degree: not a whole number, but 360 degrees are, so angles go through
// turns and nothing accumulates.
constexpr int64_t k10cr1_microsteps_per_turn = int64_t{409600} * 120;

// The nearest microstep of an angle taken modulo a turn: 0 to k10cr1_microsteps_per_turn - 1.
int64_t k10cr1_microsteps(double degrees);
// In [0, 360).
double k10cr1_degrees(int64_t microsteps);

struct AptOptions {
    double silence_s = 2;        // a controller that says nothing for so long is not there
    double poll_s = 0.5;         // between questions while it moves
    double degrees_per_s = 10;   // set on opening; the fastest of a K10CR1
    double degrees_per_s2 = 10;  // acceleration, set likewise
    double settle_s = 0.05;      // of the line, see SerialSettings
    double tolerance_deg = 0.03;
};

class AptRotator : public Rotator {
  public:
    // Sets the line up, asks the controller who it is, and sets velocity and acceleration. Throws
    // DeviceError where it does not answer or is no K10CR1.
    AptRotator(std::shared_ptr<UsbPort> port, const AptOptions& options);

    const RotatorInfo& info() const override { return info_; }
    void home() override;
    double move_to(double degrees) override;
    double position() override;
    void recover() override;
    // Also homes: its count of microsteps begins anew with its supply.
    bool reconnect(double seconds) override;

    const AptInfo& identity() const { return identity_; }
    int messages_dropped() const { return dropped_; }

  private:
    void send(const AptMessage& message);
    AptMessage receive(Deadline deadline);
    AptMessage receive(uint16_t id, Deadline deadline);
    AptInfo start();
    AptStatus ask_status();
    void check(const AptStatus& status) const;
    AptStatus run(const AptMessage& command, uint16_t completed, double seconds);
    AptStatus finish(const AptMessage& command, uint16_t completed, double seconds);
    std::string where() const { return line_.name(); }

    FtdiSerial line_;
    AptOptions options_;
    AptInfo identity_;
    RotatorInfo info_;
    int dropped_ = 0;
};

// The K10CR1 behind `port`; errors as the constructor's.
std::shared_ptr<Rotator> open_apt(std::shared_ptr<UsbPort> port);

}  // namespace drude
