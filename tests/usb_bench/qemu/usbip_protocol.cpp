#include "usb_bench/qemu/usbip_protocol.h"

#include <cstring>

#include "base/error.h"

namespace drude::usb_bench {

namespace {

enum : uint32_t { cmd_submit = 1, cmd_unlink = 2, ret_submit = 3, ret_unlink = 4 };

uint32_t number_at(std::string_view bytes, size_t word) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value = value << 8 | static_cast<uint8_t>(bytes[4 * word + i]);
    }
    return value;
}

void put_number(std::string* bytes, size_t word, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) {
        (*bytes)[4 * word + i] = static_cast<char>(value >> (24 - 8 * i) & 0xFF);
    }
}

// Words of the header; the first five are common to all messages.
enum : size_t {
    word_command = 0,
    word_sequence = 1,
    word_direction = 3,
    word_endpoint = 4,
    word_length = 6,   // of a submit
    word_frame = 7,    // of a submit and its answer: where an isochronous transfer begins
    word_packets = 8,  // of these: 0xFFFFFFFF or 0 where the transfer is not isochronous
    word_setup = 10,   // of a submit
    word_victim = 5,   // of an unlink
    word_status = 5,   // of both answers
    word_actual = 6,   // of the answer to a submit
};
constexpr uint32_t not_isochronous = 0xFFFFFFFF;

}  // namespace

std::optional<UsbipCommand> UsbipReader::next() {
    if (buffer_.size() < header_size) return std::nullopt;
    UsbipCommand command;
    command.sequence = number_at(buffer_, word_sequence);
    const uint32_t kind = number_at(buffer_, word_command);
    size_t size = header_size;
    if (kind == cmd_submit) {
        const uint32_t endpoint = number_at(buffer_, word_endpoint);
        const uint32_t packets = number_at(buffer_, word_packets);
        command.incoming = number_at(buffer_, word_direction) != 0;
        command.length = number_at(buffer_, word_length);
        if (endpoint > 15 || command.length > largest_data ||
            (packets != 0 && packets != not_isochronous)) {
            outside_error(
                "USB/IP: found a transfer of {} bytes in {} isochronous packets at endpoint {}; "
                "expected at most {} bytes in none, at 0 to 15",
                command.length, packets == not_isochronous ? 0 : packets, endpoint, largest_data);
        }
        command.endpoint = static_cast<uint8_t>(endpoint);
        std::memcpy(command.setup.data(), buffer_.data() + 4 * word_setup, command.setup.size());
        if (!command.incoming) size += command.length;
        if (buffer_.size() < size) return std::nullopt;
        command.data = buffer_.substr(header_size, size - header_size);
    } else if (kind == cmd_unlink) {
        command.kind = UsbipCommand::Kind::unlink;
        command.victim = number_at(buffer_, word_victim);
    } else {
        outside_error("USB/IP: found a message of kind {}; expected {} (submit) or {} (unlink)",
                      kind, cmd_submit + 0, cmd_unlink + 0);
    }
    buffer_.erase(0, size);
    return command;
}

std::string format_usbip_answer(uint32_t sequence, int status, size_t actual_length,
                                std::string_view data) {
    std::string bytes(UsbipReader::header_size, '\0');
    put_number(&bytes, word_command, ret_submit);
    put_number(&bytes, word_sequence, sequence);
    put_number(&bytes, word_status, static_cast<uint32_t>(status));
    put_number(&bytes, word_actual, static_cast<uint32_t>(actual_length));
    put_number(&bytes, word_frame, not_isochronous);
    return bytes.append(data);
}

std::string format_usbip_unlinked(uint32_t sequence, int status) {
    std::string bytes(UsbipReader::header_size, '\0');
    put_number(&bytes, word_command, ret_unlink);
    put_number(&bytes, word_sequence, sequence);
    put_number(&bytes, word_status, static_cast<uint32_t>(status));
    return bytes;
}

}  // namespace drude::usb_bench
