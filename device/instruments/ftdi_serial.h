// A serial line behind an FTDI chip, driven straight through USB.
//
// Rotation mounts speak ASCII or short binary messages over such a line. The chip puts two status
// bytes before every packet, also before those that carry nothing: an idle chip sends two bytes at
// every tick of its latency timer, so a read that succeeded need not hold any data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/usb/usb_port.h"

namespace drude {

enum class FlowControl { none, rts_cts, xon_xoff };

// Always eight data bits, no parity, one stop bit.
struct SerialSettings {
    uint32_t baud = 9600;  // 184 to 3 000 000
    FlowControl flow = FlowControl::none;
    uint8_t latency_ms = 2;  // how long the chip gathers bytes of a packet that is not full
    // Pause after the line was set up, and again after the chip was purged, before RTS goes on.
    double settle_s = 0;
};

// The wValue and wIndex of a baud rate request to a chip with one port: 3 MHz over the rate to the
// nearest eighth, its whole part in the lower 14 bits and a code for the eighths in bits 14 to 16,
// of which the last is bit 0 of wIndex. Two quotients have codes of their own: 0 is 1, 1 is 1.5.
// Throws Error (user) for a rate that no divisor comes within 3 % of.
struct FtdiDivisor {
    uint16_t value = 0, index = 0;
};
FtdiDivisor ftdi_divisor(uint32_t baud);

// What a transfer from the chip holds without the status bytes of its packets.
struct FtdiPayload {
    std::vector<uint8_t> data;
    uint8_t modem = 0;  // of the last packet: 0x10 CTS, 0x20 DSR, 0x40 RI, 0x80 carrier
    uint8_t line = 0;   // of all packets: 0x02 overrun, 0x04 parity, 0x08 framing, 0x10 break
};

// `transfer` is what one bulk read returned: packets of `packet_size` bytes, the last one possibly
// shorter. Throws DeviceError (bad_frame) for a packet of one byte. `where` begins its message.
FtdiPayload strip_ftdi_status(std::span<const uint8_t> transfer, size_t packet_size,
                              const std::string& where);

// "overrun, framing error", or "" where no bit says that bytes were damaged or lost.
std::string ftdi_line_errors(uint8_t line);

class FtdiSerial {
  public:
    // Sets the line up. Throws DeviceError where the chip does not answer, and where the device has
    // no pair of bulk endpoints.
    FtdiSerial(std::shared_ptr<UsbPort> port, const SerialSettings& settings);

    UsbPort& port() { return *port_; }
    std::string name() const { return port_->name(); }

    // Resets the chip and sets baud rate, frame, flow control, latency and DTR/RTS; what either
    // side had buffered is gone.
    void configure();
    // Clears halts of both endpoints, then configure() and drain().
    void recover();
    // UsbPort::reopen() and configure(); connections() tells all who share the line.
    bool reopen(double seconds);
    int connections() const { return connections_; }

    void write(std::span<const uint8_t> bytes, Deadline deadline);
    void write(std::string_view text, Deadline deadline);
    // Without its end ("\r\n" or "\n"). Throws DeviceError: timeout (what came is kept for the next
    // read), bad_frame where the chip reports damaged bytes or a line is longer than 256 bytes.
    std::string read_line(Deadline deadline);
    // Exactly `size` bytes; errors as read_line().
    std::vector<uint8_t> read_exact(size_t size, Deadline deadline);
    // Drops what was received and what still arrives, until nothing has come for `quiet_s`, at most
    // until the deadline; returns the number of data bytes dropped. UsbPort::drain() would not see
    // the end: an idle chip never stops sending its status.
    size_t drain(double quiet_s, Deadline deadline);
    // Drops what was received and not yet read; returns the number of bytes.
    size_t discard_received();

  private:
    void request(uint8_t number, uint16_t value, uint16_t index);
    void receive(Deadline deadline);

    std::shared_ptr<UsbPort> port_;
    SerialSettings settings_;
    uint8_t in_ = 0, out_ = 0;
    size_t packet_size_ = 0;
    std::vector<uint8_t> received_;
    int connections_ = 1;
};

}  // namespace drude
