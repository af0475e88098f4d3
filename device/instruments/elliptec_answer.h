// What an Elliptec mount answers, as text in and values out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "device/device_error.h"

namespace drude {

// "0PO00008C00": address 0, letters PO, digits 00008C00.
struct ElliptecAnswer {
    char address = '0';
    std::string code, digits;
};

// Nothing where the line is no answer: address 0-9 A-F, two upper-case letters, hexadecimal digits
// in upper case.
std::optional<ElliptecAnswer> parse_elliptec_answer(std::string_view line);

// Of the answer IN to `in`: type (2 digits), serial number (8 characters), year (4), firmware (2),
// hardware (2), travel (4, hexadecimal), pulses (8, hexadecimal).
struct ElliptecIdentity {
    int type = 0;        // 0x0E: ELL14
    std::string model;   // "ELL14"
    std::string serial;  // "11400587"
    int year = 0;        // of make
    std::string firmware;
    int travel_deg = 0;
    int64_t pulses_per_turn = 0;
};

// All of these throw DeviceError, their message beginning with `where`: bad_frame for digits that
// are too few, too many or out of range, refused for a mount that does not turn full circles.
ElliptecIdentity parse_elliptec_identity(const ElliptecAnswer& answer, const std::string& where);
// Pulses from the reference mark, of PO: 32 bits, negative ones as two's complement.
int64_t parse_elliptec_position(const ElliptecAnswer& answer, const std::string& where);
// The status code of GS.
int parse_elliptec_status(const ElliptecAnswer& answer, const std::string& where);

constexpr int elliptec_ok = 0, elliptec_mechanical_timeout = 2, elliptec_busy = 9;
// "mechanical time-out", ...; for codes that mean nothing, "reserved code".
std::string elliptec_status_words(int status);
// Whether a status is the mount's mechanics or a command that it will not take.
Fault elliptec_status_fault(int status);

}  // namespace drude
