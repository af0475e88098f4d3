// The messages of USB/IP after a device was attached, as bytes.
//
// Linux, Documentation/usb/usbip_protocol.rst, version 1.1.1: every message begins with 48 bytes of
// 32-bit numbers, most significant byte first; the data stage follows. The kernel sends
// USBIP_CMD_SUBMIT and USBIP_CMD_UNLINK, the side that has the device answers with USBIP_RET_SUBMIT
// and USBIP_RET_UNLINK. The messages that list and import devices over a network are not used:
// the kernel is handed the socket itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace drude::usb_bench {

// What the kernel asks for.
struct UsbipCommand {
    enum class Kind { submit, unlink };
    Kind kind = Kind::submit;
    uint32_t sequence = 0;  // its name for this command
    bool incoming = false;  // submit: data from the device to the host
    uint8_t endpoint = 0;   // submit: 0 to 15, without the direction bit
    uint32_t length = 0;    // submit: how much is asked for, or sent
    std::array<uint8_t, 8> setup{};
    std::string data;     // submit, to the device: the data stage
    uint32_t victim = 0;  // unlink: the sequence number of the submit to take back
};

// Takes bytes as they come off the socket, in pieces of any size, and gives out whole commands.
class UsbipReader {
  public:
    void append(std::string_view bytes) { buffer_.append(bytes); }
    // The next command, or nothing until more bytes are here. Throws Error (outside) for bytes that
    // are no command: an unknown kind, isochronous packets, an endpoint above 15, or a data stage
    // larger than `largest_data`.
    std::optional<UsbipCommand> next();

    static constexpr size_t header_size = 48;
    static constexpr uint32_t largest_data = 1u << 24;

  private:
    std::string buffer_;
};

// USBIP_RET_SUBMIT with its data stage. `status` is 0 or a negative errno; `actual_length` counts
// the bytes that went either way, `data` holds them only where they came from the device.
std::string format_usbip_answer(uint32_t sequence, int status, size_t actual_length,
                                std::string_view data);
// USBIP_RET_UNLINK: -ECONNRESET where the submit was taken back, 0 where it had been answered.
std::string format_usbip_unlinked(uint32_t sequence, int status);

}  // namespace drude::usb_bench
