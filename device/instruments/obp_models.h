// The spectrometers that speak the Ocean Binary Protocol (OBP) and its second version, as data.
//
// Numbers as in the tables of python-seabreeze (pyseabreeze/devices.py, features/spectrometer.py).
#pragma once

#include <cstddef>
#include <cstdint>

namespace drude {

struct ObpModel {
    uint16_t vendor = 0, product = 0;
    const char* name = nullptr;
    bool second = false;  // OBP2
    uint8_t out = 0x01, in = 0x81;
    uint32_t spectrum_message = 0;  // that asks for a spectrum
    // That forgets the spectra which the device has gathered, where it hands out the oldest first;
    // 0: it keeps none.
    uint32_t clear_message = 0;
    int pixels = 0;
    size_t metadata_bytes = 0;  // before the counts
    int bytes_per_count = 2;
    uint32_t max_counts = 65535;
    uint32_t shortest_us = 0, longest_us = 0, unit_us = 1;  // of the integration time
    double readout_s = 0;
    int dark_first = 0, dark_count = 0;

    size_t spectrum_bytes() const {
        return metadata_bytes + static_cast<size_t>(pixels) * static_cast<size_t>(bytes_per_count);
    }
};

// Null for a product that is none of them.
const ObpModel* find_obp_model(uint16_t vendor, uint16_t product);

}  // namespace drude
