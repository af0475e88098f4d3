#include "device/instruments/apt_message.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "device/device_error.h"

namespace drude {

namespace {

constexpr size_t header_size = 6;
constexpr uint8_t data_follow = 0x80;

uint16_t word(std::span<const uint8_t> bytes, size_t at) {
    return static_cast<uint16_t>(bytes[at] | (bytes[at + 1] << 8));
}

uint32_t double_word(std::span<const uint8_t> bytes, size_t at) {
    return word(bytes, at) | (static_cast<uint32_t>(word(bytes, at + 2)) << 16);
}

// A field of characters that ends with its first zero.
std::string text(std::span<const uint8_t> bytes, size_t at, size_t size) {
    std::string result;
    for (const uint8_t byte : bytes.subspan(at, size)) {
        if (byte == 0) break;
        result += static_cast<char>(byte);
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

bool printable(const std::string& characters) {
    for (const char c : characters) {
        if (c < ' ' || c > '~') return false;
    }
    return true;
}

}  // namespace

std::vector<uint8_t> encode_apt(const AptMessage& message) {
    if (message.data.size() > 255) throw std::logic_error("an APT message of more than 255 bytes");
    const bool data = !message.data.empty();
    std::vector<uint8_t> bytes(header_size + message.data.size());
    bytes[0] = static_cast<uint8_t>(message.id & 0xFF);
    bytes[1] = static_cast<uint8_t>(message.id >> 8);
    bytes[2] = data ? static_cast<uint8_t>(message.data.size()) : message.parameter_1;
    bytes[3] = data ? uint8_t{0} : message.parameter_2;
    bytes[4] = static_cast<uint8_t>(data ? message.destination | data_follow : message.destination);
    bytes[5] = message.source;
    std::copy(message.data.begin(), message.data.end(), bytes.begin() + header_size);
    return bytes;
}

size_t apt_data_size(std::span<const uint8_t> header, const std::string& where) {
    if (header.size() < header_size) {
        device_error(Fault::short_read, "{}: {} bytes of a message; its header has 6", where,
                     header.size());
    }
    const uint8_t destination = header[4], source = header[5];
    const bool data = (destination & data_follow) != 0;
    const size_t size = data ? word(header, 2) : 0;
    // Of the bytes on the line nothing but these two says where a message begins.
    if ((destination & ~data_follow) != apt::host || source != apt::unit || size > 255) {
        device_error(Fault::bad_frame,
                     "{}: {:02X} {:02X} {:02X} {:02X} {:02X} {:02X} is no header of a message from "
                     "unit 50 to host 01",
                     where, header[0], header[1], header[2], header[3], header[4], header[5]);
    }
    return size;
}

AptMessage parse_apt(std::span<const uint8_t> bytes, const std::string& where) {
    const size_t size = apt_data_size(bytes, where);
    if (bytes.size() != header_size + size) {
        device_error(bytes.size() < header_size + size ? Fault::short_read : Fault::bad_frame,
                     "{}: a message of {} bytes; its header says {}", where, bytes.size(),
                     header_size + size);
    }
    AptMessage message;
    message.id = word(bytes, 0);
    if (size == 0) {
        message.parameter_1 = bytes[2];
        message.parameter_2 = bytes[3];
    }
    message.destination = static_cast<uint8_t>(bytes[4] & ~data_follow);
    message.source = bytes[5];
    message.data.assign(bytes.begin() + header_size, bytes.end());
    return message;
}

bool AptStatus::moving() const {
    // Moving or jogging either way, homing.
    return (bits & 0x2F0) != 0;
}

bool AptStatus::homed() const {
    return (bits & 0x400) != 0;
}

AptStatus parse_apt_status(const AptMessage& message, const std::string& where) {
    if (message.data.size() != 14) {
        device_error(Fault::bad_frame, "{}: a status of {} bytes; expected 14", where,
                     message.data.size());
    }
    AptStatus status;
    status.channel = word(message.data, 0);
    status.position = static_cast<int32_t>(double_word(message.data, 2));
    status.bits = double_word(message.data, 10);
    return status;
}

AptInfo parse_apt_info(const AptMessage& message, const std::string& where) {
    if (message.data.size() != 84) {
        device_error(Fault::bad_frame, "{}: {} bytes about itself; expected 84", where,
                     message.data.size());
    }
    AptInfo info;
    info.serial = double_word(message.data, 0);
    info.model = text(message.data, 4, 8);
    if (info.model.empty() || !printable(info.model)) {
        device_error(Fault::bad_frame, "{}: the name of its model is not text", where);
    }
    info.firmware = fmt::format("{}.{}.{}", message.data[16], message.data[15], message.data[14]);
    return info;
}

std::string apt_status_errors(uint32_t bits) {
    struct Bit {
        uint32_t mask;
        const char* words;
    };
    constexpr Bit errors[] = {{0x00004000, "position error too large"},
                              {0x00008000, "instrument error"},
                              {0x00010000, "interlock open"},
                              {0x00020000, "too hot"},
                              {0x00040000, "supply voltage"},
                              {0x00080000, "commutation error"},
                              {0x01000000, "motor current limit"},
                              {0x02000000, "encoder fault"},
                              {0x04000000, "over-current"},
                              {0x08000000, "current fault"},
                              {0x40000000, "error"}};
    std::string words;
    for (const Bit& error : errors) {
        if ((bits & error.mask) == 0) continue;
        if (!words.empty()) words += ", ";
        words += error.words;
    }
    return words;
}

std::string apt_response_words(const AptMessage& message) {
    if (message.id != apt::rich_response || message.data.size() < 4) return "an error of its own";
    const std::string note = text(message.data, 4, message.data.size() - 4);
    return fmt::format("code {} about message {:04X}{}{}", word(message.data, 2),
                       word(message.data, 0), note.empty() ? "" : ": ",
                       printable(note) ? note : "");
}

}  // namespace drude
