// Thorlabs Elliptec rotation mounts (ELL14 and its kin) on an RS-485 bus behind an FTDI chip.
//
// 9600 baud, 8N1, ASCII: a command is the mount's address (0 to F), two lower-case letters and
// hexadecimal digits; an answer the address, two upper-case letters, hexadecimal digits and CR LF.
// Verified against virtual instruments.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "device/instruments/elliptec_answer.h"
#include "device/instruments/ftdi_serial.h"
#include "device/rotator.h"

namespace drude {

struct ElliptecOptions {
    double silence_s = 2;  // a mount that says nothing for so long is not there
    double poll_s = 0.05;  // between questions to a mount that says that it is busy
    // Of the slowest mount in reach of its specification: half the 430 degrees a second of an
    // ELL14.
    double degrees_per_s = 215;
    double home_s = 10;          // for a search of the reference mark
    double tolerance_deg = 0.4;  // bidirectional accuracy of an ELL14
};

// The line that all mounts of a port share. Answers of other addresses, late ones and what is no
// answer at all are dropped and counted.
class ElliptecBus {
  public:
    // The bus of a port: one for all mounts opened on it as long as any of them lives.
    static std::shared_ptr<ElliptecBus> of(const std::shared_ptr<UsbPort>& port);
    explicit ElliptecBus(std::shared_ptr<UsbPort> port);

    FtdiSerial& line() { return line_; }
    void send(char address, std::string_view command);
    // The next answer of `address` whose letters are among `codes` (e.g. "PO GS").
    ElliptecAnswer receive(char address, std::string_view codes, Deadline deadline);
    int dropped() const { return dropped_; }

  private:
    std::shared_ptr<UsbPort> port_;
    FtdiSerial line_;
    int dropped_ = 0;
};

class Elliptec : public Rotator {
  public:
    // Asks the mount who it is; pulses a turn are taken from that answer and from nowhere else.
    // `address`: '0' to '9', 'A' to 'F'; throws Error (user) for others.
    Elliptec(std::shared_ptr<ElliptecBus> bus, char address, const ElliptecOptions& options);

    const RotatorInfo& info() const override { return info_; }
    // As Rotator says. A mount that reports a mechanical time-out, or another place than it was
    // sent to, is asked once more before that is an error; one that is busy is waited for.
    void home() override;
    double move_to(double degrees) override;
    double position() override;
    // Sets the line up anew, drops late answers and waits until the mount reports no error.
    void recover() override;
    // Also homes: a mount that lost its supply counts from where it stood.
    bool reconnect(double seconds) override;

    const ElliptecIdentity& identity() const { return identity_; }
    int answers_dropped() const { return bus_->dropped(); }

  private:
    ElliptecIdentity identify();
    int64_t ask_position();
    void wait_until_idle(Deadline deadline);
    int64_t move(const std::string& command, double seconds);
    void home_after_reconnection();
    double degrees_of(int64_t pulses) const;
    std::string where() const;

    std::shared_ptr<ElliptecBus> bus_;
    char address_;
    ElliptecOptions options_;
    ElliptecIdentity identity_;
    RotatorInfo info_;
    int connection_ = 0;  // of the bus, when this mount was last homed or opened
};

// A mount on the bus behind `port`. Throws Error (user) for an address that is none, DeviceError
// where no mount answers there or what answers is no rotation mount.
std::shared_ptr<Rotator> open_elliptec(std::shared_ptr<UsbPort> port, char address);

}  // namespace drude
