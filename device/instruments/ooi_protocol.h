// The OOI protocol of Ocean Optics spectrometers as bytes: requests built, replies taken apart.
//
// Layouts as in Ocean Optics' data sheets (USB4000: opcodes 01 to 0A, 6B, FE) and python-seabreeze;
// numbers are little endian. A reply that is not what its request asked for is a DeviceError whose
// message begins with `device`: short_read, overflow or bad_frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "device/instruments/ooi_models.h"

namespace drude {

using OoiBytes = std::vector<uint8_t>;

OoiBytes ooi_initialize();
OoiBytes ooi_set_integration_time(uint32_t units);  // of OoiModel::unit_us
OoiBytes ooi_set_lamp(bool on);
OoiBytes ooi_query_slot(uint8_t slot);
OoiBytes ooi_request_spectrum();
OoiBytes ooi_set_trigger_mode(uint16_t mode);  // 0: free run
OoiBytes ooi_query_status();

// What FE answers, as far as it is used.
struct OoiStatus {
    int pixels = 0;
    uint32_t integration_units = 0;
    bool lamp = false;
    bool high_speed = false;
};

constexpr size_t ooi_slot_bytes = 17;
constexpr size_t ooi_status_bytes = 16;

// True where a reply of any length belongs to a query of this slot: 05 and its number.
bool is_ooi_slot_reply(std::span<const uint8_t> reply, uint8_t slot);

// The 15 bytes of a slot.
std::array<uint8_t, 15> parse_ooi_slot(std::span<const uint8_t> reply, uint8_t slot,
                                       const std::string& device);
// The number that a slot spells as text; NaN where it spells none.
double ooi_slot_number(const std::array<uint8_t, 15>& slot);

OoiStatus parse_ooi_status(std::span<const uint8_t> reply, const std::string& device);

// Counts at which pixels saturate from slot 17, or max_counts where the slot was never written.
uint32_t parse_ooi_saturation(const std::array<uint8_t, 15>& slot, const OoiModel& model);

// Counts of every pixel. The frame's length and, where the model sends it, its last byte 69 are
// checked.
std::vector<uint32_t> parse_ooi_frame(std::span<const uint8_t> frame, const OoiModel& model,
                                      const std::string& device);

}  // namespace drude
