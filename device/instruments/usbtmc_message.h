// Messages of the USB Test and Measurement Class, bytes in and values out (USBTMC 1.0, tables 1 to
// 9; USB488 1.0, table 8).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drude {

constexpr size_t usbtmc_header = 12;

namespace usbtmc {
constexpr uint8_t message_out = 1, request_in = 2;
constexpr uint8_t initiate_abort_out = 1, check_abort_out = 2, initiate_abort_in = 3,
                  check_abort_in = 4, initiate_clear = 5, check_clear = 6, get_capabilities = 7,
                  read_status_byte = 128;
constexpr uint8_t success = 0x01, pending = 0x02, failed = 0x80, not_in_progress = 0x81,
                  split_not_in_progress = 0x82, split_in_progress = 0x83, interrupt_busy = 0x20;
}  // namespace usbtmc

// 1 to 255 and again 1: the tag after `tag`.
uint8_t next_usbtmc_tag(uint8_t tag);

// One Bulk-OUT transfer: header, data, zeros up to a multiple of four, which the header does not
// count. `end`: the last transfer of a message.
std::vector<uint8_t> encode_usbtmc_out(uint8_t tag, std::string_view data, bool end);

// Asks for at most `size` bytes; with `terminator` the instrument stops after that character, which
// only those can that say so in their capabilities.
std::vector<uint8_t> encode_usbtmc_request(uint8_t tag, uint32_t size,
                                           std::optional<char> terminator);

struct UsbtmcPart {
    std::string data;
    bool end = false;         // of the message
    bool terminated = false;  // ends with the character asked for
};

// One Bulk-IN transfer, which must answer the request `tag` with at most `requested` bytes. Throws
// DeviceError, its message beginning with `where`: bad_frame for another message, another tag or
// one whose complement is wrong, more bytes than were asked for or than the header says; short_read
// where there are fewer.
UsbtmcPart parse_usbtmc_in(std::span<const uint8_t> transfer, uint8_t tag, uint32_t requested,
                           const std::string& where);

struct UsbtmcCapabilities {
    uint16_t version = 0;  // bcdUSBTMC
    bool listen_only = false, talk_only = false, indicator_pulse = false;
    bool terminator = false;   // stops at a character
    uint16_t version_488 = 0;  // bcdUSB488; 0 where it is no USB488 interface
    bool is_488 = false;       // takes IEEE 488.2 messages
    bool trigger = false, remote_local = false, scpi = false, service_request = false;
};
// The 24 bytes of GET_CAPABILITIES. Throws DeviceError: refused for another status than success,
// short_read for fewer bytes.
UsbtmcCapabilities parse_usbtmc_capabilities(std::span<const uint8_t> bytes,
                                             const std::string& where);

// "success", "transfer not in progress", ...
std::string usbtmc_status_words(uint8_t status);

}  // namespace drude
