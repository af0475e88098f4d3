// The spectrometers that speak the OOI protocol, as data.
//
// Numbers as in the tables of python-seabreeze (pyseabreeze/devices.py, features/spectrometer.py);
// steps of the integration time as the increments of Ocean Optics' SeaBreeze
// (XSpectrometerFeature).
#pragma once

#include <cstddef>
#include <cstdint>

namespace drude {

// Where slot 17 of the memory holds the counts at which the detector saturates.
enum class SaturationSlot {
    none,       // the model does not keep it
    at_6,       // 16 bits at byte 6 of the reply; 0: not set
    at_6_long,  // 32 bits at byte 6; 0: not set
    at_2,       // 16 bits at byte 2; not set unless within 32769 to max_counts
};

struct OoiModel {
    uint16_t product = 0;  // vendor 2457
    const char* name = nullptr;
    uint8_t out = 0x01, reply = 0x81, spectrum = 0x82;
    // The endpoint of the first 2048 bytes of a frame on a high-speed link; 0: all on `spectrum`.
    uint8_t first = 0;
    int pixels = 0;
    bool has_sync = true;      // a frame ends with 69
    bool split_bytes = false;  // packets of 64 low bytes and 64 high nibbles take turns
    uint16_t flip = 0;         // bits of a count that are sent inverted
    uint32_t max_counts = 65535;
    uint32_t shortest_us = 0, longest_us = 0, unit_us = 1;  // of the integration time
    uint32_t step_us = 1;  // its resolution: the device drops what lies below
    double readout_s = 0;  // from the end of an integration to its last byte, high speed
    int pixel_origin = 0;  // the wavelength polynomial's argument for pixel 0
    int dark_first = 0, dark_count = 0;
    bool has_status = true;  // answers FE
    SaturationSlot saturation = SaturationSlot::none;

    size_t frame_bytes() const { return 2 * static_cast<size_t>(pixels) + (has_sync ? 1 : 0); }
};

// Null for a product that is none of them.
const OoiModel* find_ooi_model(uint16_t product);

}  // namespace drude
