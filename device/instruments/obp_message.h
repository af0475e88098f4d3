// Messages of the Ocean Binary Protocol as bytes.
//
// A message is a header of 44 bytes, a payload, a checksum of 16 and a footer of 4; numbers are
// little endian. Up to 16 bytes of data travel in the header ("immediate"). Layout as in Ocean
// Optics' STS data sheet and python-seabreeze (pyseabreeze/protocol.py).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace drude {

constexpr size_t obp_header_bytes = 44;
constexpr size_t obp_trailer_bytes = 20;
// More than any spectrum of the models here; what claims to be longer is no message.
constexpr size_t obp_longest_message = size_t{1} << 20;

enum ObpFlag : uint16_t {
    obp_response = 0x01,
    obp_ack = 0x02,
    obp_ack_request = 0x04,
    obp_nack = 0x08,
    obp_exception = 0x10,
};

struct ObpMessage {
    uint16_t version = 0x1100;  // 0x2000: OBP2
    uint16_t flags = 0;
    uint16_t error = 0;
    uint32_t type = 0;
    uint32_t regarding = 0;  // a number of the host's that replies repeat
    std::vector<uint8_t> data;
    bool operator==(const ObpMessage&) const = default;
};

// `with_checksum` puts an MD5 of everything before it.
std::vector<uint8_t> format_obp_message(const ObpMessage& message, bool with_checksum = false);

// The length of the message whose header `bytes` begin with: at least 44 of them. Throws
// DeviceError (bad_frame), its message beginning with `device`, where they are no header (start,
// version, length).
size_t obp_message_bytes(std::span<const uint8_t> bytes, const std::string& device);

// Takes a whole message apart. Throws DeviceError: short_read, overflow (length), bad_frame (start,
// version, footer, an MD5 checksum that does not fit, a checksum of another kind, data both in the
// header and in the payload). Flags and error are for the caller.
ObpMessage parse_obp_message(std::span<const uint8_t> bytes, const std::string& device);

// "unknown message type": what an error number means.
std::string obp_error_text(uint16_t error);

// Helpers for payloads; `what` and `device` name them in DeviceError (bad_frame) for a length that
// does not fit.
std::vector<double> parse_obp_floats(std::span<const uint8_t> data, const char* what,
                                     const std::string& device);
uint32_t parse_obp_number(std::span<const uint8_t> data, const char* what,
                          const std::string& device);  // of 1, 2 or 4 bytes

}  // namespace drude
