#include "device/instruments/ooi_protocol.h"

#include <cmath>
#include <limits>

#include "base/numbers.h"
#include "device/device_error.h"
#include "device/instruments/stored_calibration.h"

namespace drude {

namespace {

uint32_t little_endian(std::span<const uint8_t> bytes) {
    uint32_t value = 0;
    for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
    return value;
}

void check_length(size_t found, size_t expected, const char* what, const std::string& device) {
    if (found < expected) {
        device_error(Fault::short_read, "{}: {} of {} bytes came of {}", device, found, expected,
                     what);
    }
    if (found > expected) {
        device_error(Fault::overflow, "{}: {} bytes came for {}, which has {}", device, found, what,
                     expected);
    }
}

}  // namespace

OoiBytes ooi_initialize() {
    return {0x01};
}

OoiBytes ooi_set_integration_time(uint32_t units) {
    OoiBytes bytes = {0x02};
    for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<uint8_t>(units >> shift));
    }
    return bytes;
}

OoiBytes ooi_set_lamp(bool on) {
    return {0x03, static_cast<uint8_t>(on ? 1 : 0), 0};
}

OoiBytes ooi_query_slot(uint8_t slot) {
    return {0x05, slot};
}

OoiBytes ooi_request_spectrum() {
    return {0x09};
}

OoiBytes ooi_set_trigger_mode(uint16_t mode) {
    return {0x0A, static_cast<uint8_t>(mode), static_cast<uint8_t>(mode >> 8)};
}

OoiBytes ooi_query_status() {
    return {0xFE};
}

bool is_ooi_slot_reply(std::span<const uint8_t> reply, uint8_t slot) {
    return reply.size() >= 2 && reply[0] == 0x05 && reply[1] == slot;
}

std::array<uint8_t, 15> parse_ooi_slot(std::span<const uint8_t> reply, uint8_t slot,
                                       const std::string& device) {
    check_length(reply.size(), ooi_slot_bytes, "a memory slot", device);
    if (!is_ooi_slot_reply(reply, slot)) {
        device_error(
            Fault::bad_frame,
            "{}: the answer to a query of memory slot {} begins with {:02x} {:02x} instead "
            "of 05 {:02x}",
            device, int{slot}, reply[0], reply[1], slot);
    }
    std::array<uint8_t, 15> data{};
    for (size_t i = 0; i < data.size(); ++i) data[i] = reply[i + 2];
    return data;
}

double ooi_slot_number(const std::array<uint8_t, 15>& slot) {
    return parse_double(stored_text(slot)).value_or(std::numeric_limits<double>::quiet_NaN());
}

OoiStatus parse_ooi_status(std::span<const uint8_t> reply, const std::string& device) {
    check_length(reply.size(), ooi_status_bytes, "the status", device);
    OoiStatus status;
    status.pixels = static_cast<int>(little_endian(reply.subspan(0, 2)));
    status.integration_units = little_endian(reply.subspan(2, 4));
    status.lamp = reply[6] != 0;
    const uint8_t speed = reply[14];
    if (speed != 0x00 && speed != 0x80) {
        device_error(Fault::bad_frame,
                     "{}: its status gives the speed of the link as {:02x}; 00 (full) or 80 (high) "
                     "was expected",
                     device, speed);
    }
    status.high_speed = speed == 0x80;
    return status;
}

uint32_t parse_ooi_saturation(const std::array<uint8_t, 15>& slot, const OoiModel& model) {
    // The slot's bytes begin at byte 2 of the reply.
    const std::span<const uint8_t> bytes(slot);
    uint32_t counts = 0;
    switch (model.saturation) {
        case SaturationSlot::none:
            return model.max_counts;
        case SaturationSlot::at_6:
            counts = little_endian(bytes.subspan(4, 2));
            break;
        case SaturationSlot::at_6_long:
            counts = little_endian(bytes.subspan(4, 4));
            break;
        case SaturationSlot::at_2:
            counts = little_endian(bytes.subspan(0, 2));
            if (counts <= 32768) return model.max_counts;
            break;
    }
    return counts == 0 || counts > model.max_counts ? model.max_counts : counts;
}

std::vector<uint32_t> parse_ooi_frame(std::span<const uint8_t> frame, const OoiModel& model,
                                      const std::string& device) {
    check_length(frame.size(), model.frame_bytes(), "a spectrum", device);
    if (model.has_sync && frame.back() != 0x69) {
        device_error(Fault::bad_frame,
                     "{}: the last byte of a spectrum is {:02x} instead of 69; bytes were lost or "
                     "belong to another answer",
                     device, frame.back());
    }
    const size_t pixels = static_cast<size_t>(model.pixels);
    std::vector<uint32_t> counts(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        if (model.split_bytes) {
            // 64 pixels make two packets: their low bytes, then their high ones, of which the upper
            // four bits are not driven.
            const size_t low = i / 64 * 128 + i % 64;
            counts[i] = frame[low] | (frame[low + 64] & 0x0Fu) << 8;
        } else {
            counts[i] = (frame[2 * i] | uint32_t{frame[2 * i + 1]} << 8) ^ model.flip;
        }
    }
    return counts;
}

}  // namespace drude
