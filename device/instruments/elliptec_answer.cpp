#include "device/instruments/elliptec_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace drude {

namespace {

bool is_digit(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F');
}

// Of digits that parse_elliptec_answer() has let through, at most eight.
uint32_t hexadecimal(std::string_view digits) {
    uint32_t value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
}

void require(const ElliptecAnswer& answer, const char* code, size_t digits,
             const std::string& where) {
    if (answer.code != code || answer.digits.size() != digits) {
        device_error(Fault::bad_frame,
                     "{}: answered '{}{}{}'; expected {}{} and {} hexadecimal digits", where,
                     answer.address, answer.code, answer.digits, answer.address, code, digits);
    }
}

// Types of mounts that turn full circles, with their names.
struct Model {
    int type;
    const char* name;
};
constexpr std::array<Model, 3> models = {{{0x08, "ELL8"}, {0x0E, "ELL14"}, {0x12, "ELL18"}}};

constexpr std::array<const char*, 14> statuses = {
    "no error",
    "communication time-out",
    "mechanical time-out",
    "command unknown or not supported",
    "value out of range",
    "module isolated",
    "module out of isolation",
    "initialisation error",
    "thermal error",
    "busy",
    "sensor error",
    "motor error",
    "out of its travel",
    "over-current",
};

}  // namespace

std::optional<ElliptecAnswer> parse_elliptec_answer(std::string_view line) {
    const auto upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (line.size() < 3 || !is_digit(line[0]) || !upper(line[1]) || !upper(line[2])) return {};
    const std::string_view digits = line.substr(3);
    if (!std::all_of(digits.begin(), digits.end(), is_digit)) return {};
    return ElliptecAnswer{line[0], std::string(line.substr(1, 2)), std::string(digits)};
}

ElliptecIdentity parse_elliptec_identity(const ElliptecAnswer& answer, const std::string& where) {
    require(answer, "IN", 30, where);
    const std::string& digits = answer.digits;
    ElliptecIdentity identity;
    identity.type = static_cast<int>(hexadecimal(digits.substr(0, 2)));
    identity.serial = digits.substr(2, 8);
    // The year is written in decimal digits.
    const std::string year = digits.substr(10, 4);
    const auto [end, error] =
        std::from_chars(year.data(), year.data() + year.size(), identity.year);
    if (error != std::errc() || end != year.data() + year.size()) {
        device_error(Fault::bad_frame, "{}: says that it was made in the year '{}'", where, year);
    }
    identity.firmware = digits.substr(14, 2);
    identity.travel_deg = static_cast<int>(hexadecimal(digits.substr(18, 4)));
    identity.pulses_per_turn = hexadecimal(digits.substr(22, 8));
    const auto known = std::find_if(models.begin(), models.end(), [&](const Model& model) {
        return model.type == identity.type;
    });
    if (known == models.end() || identity.travel_deg != 360) {
        device_error(Fault::refused,
                     "{}: is an Elliptec module of type {:02X} with a travel of {}; expected a "
                     "rotation mount (ELL8, ELL14, ELL18) with a travel of 360 degrees",
                     where, identity.type, identity.travel_deg);
    }
    identity.model = known->name;
    // Fewer would be coarser than the mounts' accuracy; more do not fit the 32 bits of a position.
    if (identity.pulses_per_turn < 3600 || identity.pulses_per_turn > (int64_t{1} << 30)) {
        device_error(Fault::bad_frame,
                     "{}: says that a turn has {} pulses; expected 3600 to 2^30 (an ELL14 has "
                     "143360)",
                     where, identity.pulses_per_turn);
    }
    return identity;
}

int64_t parse_elliptec_position(const ElliptecAnswer& answer, const std::string& where) {
    require(answer, "PO", 8, where);
    return static_cast<int32_t>(hexadecimal(answer.digits));
}

int parse_elliptec_status(const ElliptecAnswer& answer, const std::string& where) {
    require(answer, "GS", 2, where);
    return static_cast<int>(hexadecimal(answer.digits));
}

std::string elliptec_status_words(int status) {
    if (status < 0 || status >= static_cast<int>(statuses.size())) return "reserved code";
    return statuses[static_cast<size_t>(status)];
}

Fault elliptec_status_fault(int status) {
    switch (status) {
        case 2:   // mechanical time-out
        case 7:   // initialisation
        case 8:   // thermal
        case 9:   // busy, where that does not end
        case 10:  // sensor
        case 11:  // motor
        case 13:  // over-current
            return Fault::mechanical;
        default:
            return Fault::refused;
    }
}

}  // namespace drude
