#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"
#include "device/instruments/registry.h"

namespace drude {

namespace {

std::vector<std::string> schemes() {
    std::vector<std::string> names;
    for (const InstrumentDriver& driver : instrument_drivers()) names.push_back(driver.scheme);
    return names;
}

// "ell:SERIAL/ADDRESS", "ell:/ADDRESS".
void parse_elliptec(const std::string& uri, const std::string& rest, InstrumentUri* result) {
    const size_t slash = rest.rfind('/');
    if (slash == std::string::npos || rest.size() != slash + 2 ||
        !std::isxdigit(static_cast<unsigned char>(rest[slash + 1]))) {
        user_error(
            "'{}': which mount of the bus is meant? Expected ell:SERIAL/ADDRESS with an address "
            "from 0 to F, e.g. ell:{}/0 (0 is what mounts leave the factory with)",
            uri, slash == std::string::npos ? rest : rest.substr(0, slash));
    }
    result->serial = rest.substr(0, slash);
    result->address =
        std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(rest.back()))));
}

uint16_t parse_hexadecimal(const std::string& uri, const std::string& word) {
    uint16_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value, 16);
    if (word.empty() || word.size() > 4 || error != std::errc() || stop != end) {
        user_error(
            "'{}': '{}' is no vendor or product number; expected usbtmc:VID:PID:SERIAL with four "
            "hexadecimal digits each, e.g. usbtmc:1209:5e11:TMC0001",
            uri, word);
    }
    return value;
}

// "usbtmc:VID:PID", "usbtmc:VID:PID:SERIAL".
void parse_usbtmc(const std::string& uri, const std::string& rest, InstrumentUri* result) {
    const size_t first = rest.find(':');
    const std::string vendor = rest.substr(0, first);
    const std::string after = first == std::string::npos ? "" : rest.substr(first + 1);
    const size_t second = after.find(':');
    result->vendor = parse_hexadecimal(uri, vendor);
    result->product = parse_hexadecimal(uri, after.substr(0, second));
    if (second != std::string::npos) result->serial = after.substr(second + 1);
}

}  // namespace

InstrumentUri parse_instrument_uri(const std::string& uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string::npos) {
        user_error("'{}' names no instrument{}; expected SCHEME:SERIAL, e.g. ooi:USB4C00001 ({})",
                   uri, did_you_mean(uri, schemes()), fmt::join(schemes(), ", "));
    }
    InstrumentUri result;
    result.scheme = uri.substr(0, colon);
    const std::string rest = uri.substr(colon + 1);
    const std::vector<std::string> known = schemes();
    if (std::find(known.begin(), known.end(), result.scheme) == known.end()) {
        if (result.scheme == "virtual") {
            user_error("'{}' is a whole bench, not one of its instruments; expected one of {}", uri,
                       fmt::join(known, ", "));
        }
        user_error("'{}': there is no instrument '{}:'{}; there are {}", uri, result.scheme,
                   did_you_mean(result.scheme, known), fmt::join(known, ", "));
    }
    if (result.scheme == "ell") {
        parse_elliptec(uri, rest, &result);
    } else if (result.scheme == "usbtmc") {
        parse_usbtmc(uri, rest, &result);
    } else {
        result.serial = rest;
    }
    return result;
}

}  // namespace drude
