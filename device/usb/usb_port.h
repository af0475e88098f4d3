// One opened USB device as protocols see it: control and bulk transfers, each with a deadline.
//
// Protocols (device/instruments/) are written against this, so that they run over libusb
// (usb_device.h) and, in tests, over anything that answers in bytes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace drude {

using Deadline = std::chrono::steady_clock::time_point;

inline Deadline deadline_in(double seconds) {
    return std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(
               std::chrono::duration<double>(seconds));
}

// The setup packet of a control transfer (USB 2.0, section 9.3), without its length.
struct ControlRequest {
    uint8_t request_type = 0, request = 0;
    uint16_t value = 0, index = 0;
};

class UsbPort {
  public:
    virtual ~UsbPort() = default;

    // "Ocean Optics USB4000 (ooi:USB4C00001)": the beginning of every error message about it.
    virtual std::string name() const = 0;
    virtual std::string serial() const = 0;
    virtual uint16_t vendor() const = 0;
    virtual uint16_t product() const = 0;
    virtual bool high_speed() const = 0;  // 480 Mbit/s or more
    // wMaxPacketSize of an endpoint (direction bit included); 0 where there is no such endpoint.
    virtual size_t packet_size(uint8_t endpoint) const = 0;
    // Endpoints of the claimed interface: address and bmAttributes & 3 (2 bulk, 3 interrupt).
    virtual std::vector<std::pair<uint8_t, uint8_t>> endpoints() const = 0;
    // bInterfaceNumber of the claimed interface, which class requests name.
    virtual uint8_t interface_number() const { return 0; }

    // All of `bytes`, or throws DeviceError.
    virtual void write(uint8_t endpoint, std::span<const uint8_t> bytes, Deadline deadline) = 0;
    // One bulk transfer: fills `buffer` until it is full or a short packet ends it, and returns the
    // number of bytes (0 for a zero-length packet). The buffer's size should be a multiple of the
    // packet size, or exactly what is expected. Throws DeviceError: timeout (what arrived before is
    // lost to the caller and counts as drained), stall, overflow, unplugged, io.
    virtual size_t read(uint8_t endpoint, std::span<uint8_t> buffer, Deadline deadline) = 0;
    // Control transfers; the data stage of control_in returns what the device sent, at most
    // `length` bytes.
    virtual void control_out(const ControlRequest& request, std::span<const uint8_t> data,
                             Deadline deadline) = 0;
    virtual std::vector<uint8_t> control_in(const ControlRequest& request, uint16_t length,
                                            Deadline deadline) = 0;
    virtual void clear_halt(uint8_t endpoint) = 0;
    // Reads and drops what an IN endpoint holds until it has been silent for `quiet_s`, at most
    // until the deadline; returns the number of bytes dropped. A time-out is the normal end.
    virtual size_t drain(uint8_t endpoint, double quiet_s, Deadline deadline) = 0;
    // After it was unplugged: waits up to `seconds` for a device of the same numbers and serial,
    // and opens and claims it. False where none came.
    virtual bool reopen(double seconds) = 0;
};

}  // namespace drude
