#include "device/instruments/usbtmc_message.h"

#include <fmt/format.h>

#include <algorithm>

#include "device/device_error.h"

namespace drude {

namespace {

// With room for `data` bytes and what fills them up to a multiple of four.
std::vector<uint8_t> message(uint8_t id, uint8_t tag, size_t size, uint8_t attributes,
                             size_t data) {
    std::vector<uint8_t> bytes(usbtmc_header + (data + 3) / 4 * 4);
    bytes[0] = id;
    bytes[1] = tag;
    bytes[2] = static_cast<uint8_t>(~tag);
    for (size_t byte = 0; byte < 4; ++byte) {
        bytes[4 + byte] = static_cast<uint8_t>((size >> (8 * byte)) & 0xFF);
    }
    bytes[8] = attributes;
    return bytes;
}

}  // namespace

uint8_t next_usbtmc_tag(uint8_t tag) {
    return tag == 255 ? uint8_t{1} : static_cast<uint8_t>(tag + 1);
}

std::vector<uint8_t> encode_usbtmc_out(uint8_t tag, std::string_view data, bool end) {
    std::vector<uint8_t> bytes =
        message(usbtmc::message_out, tag, data.size(), end ? 1 : 0, data.size());
    std::copy(data.begin(), data.end(), bytes.begin() + usbtmc_header);
    return bytes;
}

std::vector<uint8_t> encode_usbtmc_request(uint8_t tag, uint32_t size,
                                           std::optional<char> terminator) {
    std::vector<uint8_t> bytes = message(usbtmc::request_in, tag, size, terminator ? 2 : 0, 0);
    if (terminator) bytes[9] = static_cast<uint8_t>(*terminator);
    return bytes;
}

UsbtmcPart parse_usbtmc_in(std::span<const uint8_t> transfer, uint8_t tag, uint32_t requested,
                           const std::string& where) {
    if (transfer.size() < usbtmc_header) {
        device_error(Fault::short_read, "{}: a transfer of {} bytes; its header has {}", where,
                     transfer.size(), usbtmc_header);
    }
    const uint8_t complement = static_cast<uint8_t>(~transfer[1]);
    if (transfer[0] != usbtmc::request_in || transfer[2] != complement) {
        device_error(Fault::bad_frame,
                     "{}: {:02X} {:02X} {:02X} begins no answer; expected 02, a tag and its "
                     "complement",
                     where, transfer[0], transfer[1], transfer[2]);
    }
    if (transfer[1] != tag) {
        device_error(Fault::bad_frame, "{}: an answer to request {}; expected that to {}", where,
                     transfer[1], tag);
    }
    uint32_t size = 0;
    for (size_t byte = 0; byte < 4; ++byte) {
        size |= static_cast<uint32_t>(transfer[4 + byte]) << (8 * byte);
    }
    if (size > requested) {
        device_error(Fault::bad_frame, "{}: announces {} bytes where {} were asked for", where,
                     size, requested);
    }
    const std::span<const uint8_t> data = transfer.subspan(usbtmc_header);
    if (data.size() < size) {
        device_error(Fault::short_read, "{}: {} bytes of an answer that announces {}", where,
                     data.size(), size);
    }
    if (data.size() - size > 3) {
        device_error(Fault::bad_frame,
                     "{}: {} bytes after an answer of {}; expected at most 3 to a multiple of four",
                     where, data.size() - size, size);
    }
    UsbtmcPart part;
    part.data.assign(data.begin(), data.begin() + size);
    part.end = (transfer[8] & 1) != 0;
    part.terminated = (transfer[8] & 2) != 0;
    return part;
}

UsbtmcCapabilities parse_usbtmc_capabilities(std::span<const uint8_t> bytes,
                                             const std::string& where) {
    if (!bytes.empty() && bytes[0] != usbtmc::success) {
        device_error(Fault::refused, "{}: does not tell its capabilities: {}", where,
                     usbtmc_status_words(bytes[0]));
    }
    if (bytes.size() < 24) {
        device_error(Fault::short_read, "{}: {} bytes of capabilities; expected 24", where,
                     bytes.size());
    }
    const auto version = [&](size_t at) {
        return static_cast<uint16_t>(bytes[at] | (bytes[at + 1] << 8));
    };
    UsbtmcCapabilities capabilities;
    capabilities.version = version(2);
    capabilities.listen_only = (bytes[4] & 1) != 0;
    capabilities.talk_only = (bytes[4] & 2) != 0;
    capabilities.indicator_pulse = (bytes[4] & 4) != 0;
    capabilities.terminator = (bytes[5] & 1) != 0;
    capabilities.version_488 = version(12);
    capabilities.trigger = (bytes[14] & 1) != 0;
    capabilities.remote_local = (bytes[14] & 2) != 0;
    capabilities.is_488 = (bytes[14] & 4) != 0;
    capabilities.service_request = (bytes[15] & 4) != 0;
    capabilities.scpi = (bytes[15] & 8) != 0;
    return capabilities;
}

std::string usbtmc_status_words(uint8_t status) {
    switch (status) {
        case usbtmc::success:
            return "success";
        case usbtmc::pending:
            return "pending";
        case usbtmc::failed:
            return "failed";
        case usbtmc::not_in_progress:
            return "transfer not in progress";
        case usbtmc::split_not_in_progress:
            return "split not in progress";
        case usbtmc::split_in_progress:
            return "split in progress";
        case usbtmc::interrupt_busy:
            return "status byte still under way";
        default:
            return fmt::format("status {:02X}", status);
    }
}

}  // namespace drude
