// What an FTDI chip makes of bytes on its serial line: packets with two bytes of status each.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>

#include "device/fake_usb_port.h"
#include "faults.h"

namespace drude {

inline Bytes ftdi_packets(const Bytes& data, size_t packet_size = 64, uint8_t line = 0x60) {
    Bytes result;
    for (size_t at = 0; at == 0 || at < data.size(); at += packet_size - 2) {
        const size_t end = std::min(data.size(), at + packet_size - 2);
        result.push_back(0x01);
        result.push_back(line);
        result.insert(result.end(), data.begin() + static_cast<std::ptrdiff_t>(at),
                      data.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return result;
}

inline Bytes ftdi_packets(std::string_view text, size_t packet_size = 64, uint8_t line = 0x60) {
    return ftdi_packets(Bytes(text.begin(), text.end()), packet_size, line);
}

// A chip of a full-speed device, as in the mounts.
inline std::shared_ptr<FakeUsbPort> ftdi_port() {
    auto port = std::make_shared<FakeUsbPort>();
    port->name_ = "FTDI FT230X (DK0AELL1)";
    port->serial_ = "DK0AELL1";
    port->high_speed_ = false;
    port->packet_sizes_ = {{0x02, 64}, {0x81, 64}};
    return port;
}

}  // namespace drude
