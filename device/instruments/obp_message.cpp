#include "device/instruments/obp_message.h"

#include <algorithm>
#include <bit>

#include "base/md5.h"
#include "device/device_error.h"

namespace drude {

namespace {

constexpr uint8_t checksum_none = 0, checksum_md5 = 1;
constexpr uint32_t footer = 0xC2C3C4C5;

// Where the fields of the header stand.
constexpr size_t at_version = 2, at_flags = 4, at_error = 6, at_type = 8, at_regarding = 12,
                 at_checksum_type = 22, at_immediate_length = 23, at_immediate = 24,
                 at_remaining = 40, immediate_bytes = 16;

uint32_t number_at(std::span<const uint8_t> bytes, size_t at, size_t count) {
    uint32_t value = 0;
    for (size_t i = count; i-- > 0;) value = value << 8 | bytes[at + i];
    return value;
}

void put(std::vector<uint8_t>& bytes, uint32_t value, size_t count) {
    for (size_t i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

void check_start(std::span<const uint8_t> bytes, const std::string& device) {
    if (bytes[0] != 0xC1 || bytes[1] != 0xC0) {
        device_error(Fault::bad_frame, "{}: a message begins with {:02x} {:02x} instead of c1 c0",
                     device, bytes[0], bytes[1]);
    }
    const uint32_t version = number_at(bytes, at_version, 2);
    if (version >> 12 != 1 && version >> 12 != 2) {
        device_error(Fault::bad_frame,
                     "{}: a message is of protocol version {:04x}; 1100 or 2000 was expected",
                     device, version);
    }
}

}  // namespace

std::vector<uint8_t> format_obp_message(const ObpMessage& message, bool with_checksum) {
    const bool immediate = message.data.size() <= immediate_bytes;
    const size_t payload = immediate ? 0 : message.data.size();
    std::vector<uint8_t> bytes = {0xC1, 0xC0};
    put(bytes, message.version, 2);
    put(bytes, message.flags, 2);
    put(bytes, message.error, 2);
    put(bytes, message.type, 4);
    put(bytes, message.regarding, 4);
    put(bytes, 0, 4), put(bytes, 0, 2);
    bytes.push_back(with_checksum ? checksum_md5 : checksum_none);
    bytes.push_back(immediate ? static_cast<uint8_t>(message.data.size()) : 0);
    if (immediate) bytes.insert(bytes.end(), message.data.begin(), message.data.end());
    bytes.resize(at_remaining);
    put(bytes, static_cast<uint32_t>(payload + obp_trailer_bytes), 4);
    if (!immediate) bytes.insert(bytes.end(), message.data.begin(), message.data.end());
    std::array<uint8_t, 16> checksum{};
    if (with_checksum) checksum = md5(bytes);
    bytes.insert(bytes.end(), checksum.begin(), checksum.end());
    put(bytes, footer, 4);
    return bytes;
}

size_t obp_message_bytes(std::span<const uint8_t> bytes, const std::string& device) {
    if (bytes.size() < obp_header_bytes) {
        device_error(Fault::short_read, "{}: {} bytes came of the {} of a message's header", device,
                     bytes.size(), obp_header_bytes);
    }
    check_start(bytes, device);
    const size_t remaining = number_at(bytes, at_remaining, 4);
    if (remaining < obp_trailer_bytes || remaining > obp_longest_message) {
        device_error(Fault::bad_frame, "{}: a message says that {} bytes follow its header", device,
                     remaining);
    }
    return obp_header_bytes + remaining;
}

ObpMessage parse_obp_message(std::span<const uint8_t> bytes, const std::string& device) {
    const size_t expected = obp_message_bytes(bytes, device);
    if (bytes.size() != expected) {
        device_error(bytes.size() < expected ? Fault::short_read : Fault::overflow,
                     "{}: {} bytes came of a message of {}", device, bytes.size(), expected);
    }
    const uint32_t end = number_at(bytes, expected - 4, 4);
    if (end != footer) {
        device_error(Fault::bad_frame,
                     "{}: a message ends with {:02x} {:02x} {:02x} {:02x} instead of c5 c4 c3 c2",
                     device, bytes[expected - 4], bytes[expected - 3], bytes[expected - 2],
                     bytes[expected - 1]);
    }
    const uint8_t kind = bytes[at_checksum_type];
    if (kind != checksum_none && kind != checksum_md5) {
        device_error(Fault::bad_frame, "{}: a message has a checksum of unknown kind {}", device,
                     int{kind});
    }
    const auto guarded = bytes.first(expected - obp_trailer_bytes);
    if (kind == checksum_md5) {
        const std::array<uint8_t, 16> sum = md5(guarded);
        if (!std::equal(sum.begin(), sum.end(), bytes.subspan(guarded.size()).begin())) {
            device_error(Fault::bad_frame,
                         "{}: the MD5 checksum of a message (type {:06x}) does not fit its {} "
                         "bytes; some were changed on the way",
                         device, number_at(bytes, at_type, 4), guarded.size());
        }
    }
    ObpMessage message;
    message.version = static_cast<uint16_t>(number_at(bytes, at_version, 2));
    message.flags = static_cast<uint16_t>(number_at(bytes, at_flags, 2));
    message.error = static_cast<uint16_t>(number_at(bytes, at_error, 2));
    message.type = number_at(bytes, at_type, 4);
    message.regarding = number_at(bytes, at_regarding, 4);
    const size_t immediate = bytes[at_immediate_length];
    const auto payload = guarded.subspan(obp_header_bytes);
    if (immediate > immediate_bytes || (immediate > 0 && !payload.empty())) {
        device_error(Fault::bad_frame,
                     "{}: a message (type {:06x}) gives {} bytes in its header and {} after it",
                     device, message.type, immediate, payload.size());
    }
    const auto data = immediate > 0 ? bytes.subspan(at_immediate, immediate) : payload;
    message.data.assign(data.begin(), data.end());
    return message;
}

std::string obp_error_text(uint16_t error) {
    switch (error) {
        case 0:
            return "no reason given";
        case 1:
            return "unsupported protocol";
        case 2:
            return "unknown message type";
        case 3:
            return "bad checksum";
        case 4:
            return "message too large";
        case 5:
            return "payload of the wrong length";
        case 6:
            return "payload invalid";
        case 7:
            return "not ready";
        case 8:
            return "unknown kind of checksum";
        case 9:
            return "it was reset unexpectedly";
        case 10:
            return "commands come over too many buses";
        case 11:
            return "out of memory";
        case 12:
            return "it does not have what was asked for";
        case 13:
            return "internal error of the device";
        default:
            return fmt::format("error {}", error);
    }
}

std::vector<double> parse_obp_floats(std::span<const uint8_t> data, const char* what,
                                     const std::string& device) {
    if (data.size() % 4 != 0 || data.empty()) {
        device_error(Fault::bad_frame, "{}: {} bytes came for {}, which takes a multiple of 4",
                     device, data.size(), what);
    }
    std::vector<double> values;
    for (size_t at = 0; at < data.size(); at += 4) {
        values.push_back(double{std::bit_cast<float>(number_at(data, at, 4))});
    }
    return values;
}

uint32_t parse_obp_number(std::span<const uint8_t> data, const char* what,
                          const std::string& device) {
    if (data.size() != 1 && data.size() != 2 && data.size() != 4) {
        device_error(Fault::bad_frame, "{}: {} bytes came for {}, which takes 1, 2 or 4", device,
                     data.size(), what);
    }
    return number_at(data, 0, data.size());
}

}  // namespace drude
