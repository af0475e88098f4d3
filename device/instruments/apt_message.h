// Messages of Thorlabs motor controllers (APT protocol), bytes in and values out.
//
// Six bytes: message number, then either two parameters or the length of the data that follow,
// which bit 7 of the destination says, then destination and source. Little endian.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace drude {

namespace apt {
constexpr uint8_t host = 0x01, unit = 0x50;
constexpr uint16_t request_info = 0x0005, get_info = 0x0006, stop_updates = 0x0012,
                   no_flash_programming = 0x0018, response = 0x0080, rich_response = 0x0081,
                   set_velocity = 0x0413, move_home = 0x0443, move_homed = 0x0444,
                   move_absolute = 0x0453, move_completed = 0x0464, move_stop = 0x0465,
                   move_stopped = 0x0466, request_status = 0x0480, get_status = 0x0481,
                   acknowledge_status = 0x0492;
}  // namespace apt

struct AptMessage {
    uint16_t id = 0;
    uint8_t parameter_1 = 0, parameter_2 = 0;  // of messages without data
    uint8_t destination = apt::unit, source = apt::host;
    std::vector<uint8_t> data;  // at most 255 bytes

    bool operator==(const AptMessage&) const = default;
};

std::vector<uint8_t> encode_apt(const AptMessage& message);

// How many bytes follow the six of a header. Throws DeviceError (bad_frame), its message beginning
// with `where`, where they are no header of a message from a controller to the host.
size_t apt_data_size(std::span<const uint8_t> header, const std::string& where);

// A whole message; throws DeviceError (bad_frame) where the size is not that of its header.
AptMessage parse_apt(std::span<const uint8_t> bytes, const std::string& where);

// Of messages 0481, 0464 and 0466.
struct AptStatus {
    int channel = 0;
    int32_t position = 0;  // microsteps
    uint32_t bits = 0;

    bool moving() const;  // homing included
    bool homed() const;
};
// Of message 0006.
struct AptInfo {
    uint32_t serial = 0;
    std::string model;     // "K10CR1", up to 8 characters
    std::string firmware;  // "1.0.3"
};
// Both throw DeviceError (bad_frame) for data of another length or with characters that no model
// name has.
AptStatus parse_apt_status(const AptMessage& message, const std::string& where);
AptInfo parse_apt_info(const AptMessage& message, const std::string& where);

// The bits that say what is wrong, in words; "" where none is set.
std::string apt_status_errors(uint32_t bits);
// What messages 0080 and 0081 complain of: "code 6 about message 0453: note".
std::string apt_response_words(const AptMessage& message);

}  // namespace drude
