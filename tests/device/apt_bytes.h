// What a Thorlabs APT controller sends, written out byte by byte.
#pragma once

#include <string>

#include "device/ftdi_packets.h"

namespace drude {

inline void put(Bytes* bytes, uint32_t value) {
    for (int byte = 0; byte < 4; ++byte) {
        bytes->push_back(static_cast<uint8_t>((value >> (8 * byte)) & 0xFF));
    }
}

// A message with data from the controller, written out by hand.
inline Bytes from_unit(uint16_t id, const Bytes& data) {
    Bytes bytes = {static_cast<uint8_t>(id & 0xFF),
                   static_cast<uint8_t>(id >> 8),
                   static_cast<uint8_t>(data.size()),
                   0,
                   0x81,
                   0x50};
    for (const uint8_t byte : data) bytes.push_back(byte);
    return bytes;
}

inline Bytes status_message(uint16_t id, int32_t position, uint32_t bits) {
    Bytes data = {1, 0};
    put(&data, static_cast<uint32_t>(position));
    put(&data, 0);
    put(&data, bits);
    return from_unit(id, data);
}

inline Bytes info_message(uint32_t serial, const std::string& model) {
    Bytes data;
    put(&data, serial);
    for (size_t i = 0; i < 8; ++i) {
        data.push_back(i < model.size() ? static_cast<uint8_t>(model[i]) : uint8_t{0});
    }
    data.insert(data.end(), {16, 0, 3, 0, 1, 0});
    data.resize(84);
    return from_unit(0x0006, data);
}

// Status bits: enabled and homed; moving besides.
constexpr uint32_t homed = 0x80000400, moving = 0x80000410;

}  // namespace drude
