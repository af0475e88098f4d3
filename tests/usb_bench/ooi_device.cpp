#include "usb_bench/ooi_device.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/numbers.h"

namespace drude::usb_bench {

namespace {

constexpr uint8_t commands = 0x01, answers = 0x81, frame_first = 0x86, frame_rest = 0x82;
constexpr uint32_t shortest_us = 10, longest_us = 65535000;
constexpr double power_on_s = 0.01;

Identity identity_of(const std::string& serial) {
    Identity id;
    id.name = "ooi:" + serial;
    id.vendor = 0x2457;
    id.product = 0x1022;
    id.endpoints = {{commands, 512}, {frame_rest, 512}, {frame_first, 512}, {answers, 512}};
    id.manufacturer = "Ocean Optics Inc.";
    id.product_name = "Ocean Optics USB4000";
    id.serial = serial;
    return id;
}

AnswerShape shape(const std::string& what, int sync_at) {
    AnswerShape shape;
    shape.what = what;
    shape.sync_at = sync_at;
    return shape;
}

}  // namespace

OoiDevice::OoiDevice(const std::string& serial, OpticalBench& bench, FaultPlan& faults)
    : VirtualDevice(identity_of(serial), faults), bench_(bench), detector_(bench, power_on_s) {
    const VirtualBenchSettings& settings = bench.optics().settings();
    for (int slot = 0; slot < 16; ++slot) slots_[slot] = "0";
    slots_[0] = serial;
    slots_[1] = format_double(settings.first_nm).substr(0, 15);
    // Rounded to what a slot holds; settings are chosen so that nothing is lost.
    slots_[2] = fmt::format("{:.12g}", (settings.last_nm - settings.first_nm) / (pixels - 1));
    slots_[6] = "1";
    const std::vector<double>& nonlinearity = settings.reported_nonlinearity;
    for (size_t i = 0; i < std::min<size_t>(nonlinearity.size(), 8); ++i) {
        slots_[6 + static_cast<int>(i)] = format_double(nonlinearity[i]).substr(0, 15);
    }
    slots_[14] = std::to_string(nonlinearity.empty() ? 0 : nonlinearity.size() - 1);
}

void OoiDevice::power_on() {
    detector_.restart(power_on_s);
    bench_.set_lamp(true);
}

std::string OoiDevice::describe(const Transfer& transfer) const {
    if (transfer.type == TransferType::control) return "control request";
    static const std::map<uint8_t, std::string> names{
        {0x01, "initialise"},       {0x02, "set integration time"}, {0x03, "set lamp"},
        {0x05, "ask for slot"},     {0x09, "ask for frame"},        {0x0A, "set trigger"},
        {0x6B, "ask for register"}, {0xFE, "ask for status"}};
    const auto name = transfer.data.empty() ? names.end() : names.find(byte_at(transfer.data, 0));
    if (name == names.end()) return "unknown command";
    if (name->first == 0x05 && transfer.data.size() > 1) {
        return name->second + " " + std::to_string(byte_at(transfer.data, 1));
    }
    return name->second;
}

void OoiDevice::receive(uint8_t endpoint, const Bytes& data) {
    if (endpoint != commands || data.empty()) {
        halt(endpoint);
        return;
    }
    const Instant now = Clock::now();
    switch (byte_at(data, 0)) {
        case 0x02:
            if (data.size() >= 5) {
                const auto asked = static_cast<uint32_t>(read_little_endian(data, 1, 4));
                detector_.set_integration_time(1e-6 * std::clamp(asked, shortest_us, longest_us));
            }
            return;
        case 0x03:
            if (data.size() >= 3) bench_.set_lamp(read_little_endian(data, 1, 2) != 0);
            return;
        case 0x05: {
            const int slot = data.size() > 1 ? byte_at(data, 1) : 0;
            Bytes answer = data.substr(0, 2);
            if (slot == 17) {
                answer += Bytes(4, '\0');
                answer += little_endian(bench_.optics().settings().max_counts, 2);
            } else if (slots_.count(slot) != 0) {
                answer += slots_[slot];
            }
            answer.resize(17);
            send(answers, answer, shape("slot " + std::to_string(slot), 0), now);
            return;
        }
        case 0x09:
            send_frame();
            return;
        case 0x6B:
            send(answers, Bytes{data.size() > 1 ? data[1] : '\0', '\0', '\x10'},
                 shape("register", 0), now);
            return;
        case 0xFE: {
            Bytes answer = little_endian(pixels, 2);
            answer +=
                little_endian(static_cast<uint64_t>(detector_.integration_time() * 1e6 + 0.5), 4);
            answer.resize(16);
            answer[9] = 15;
            answer[14] = identity().high_speed ? '\x80' : '\0';
            send(answers, answer, shape("status", -1), now);
            return;
        }
        default:
            return;
    }
}

void OoiDevice::send_frame() {
    const FreeRunningDetector::Reading reading = detector_.fetch();
    Bytes bytes;
    for (const uint32_t counts : reading.counts) bytes += little_endian(counts, 2);
    bytes += '\x69';
    const uint32_t full = bench_.optics().settings().max_counts;
    const auto saturated = [full](AnswerShape made, size_t pixel_bytes) {
        made.saturate = [full, pixel_bytes](std::string& part) {
            for (size_t i = 0; i + 1 < pixel_bytes; i += 2)
                part.replace(i, 2, little_endian(full, 2));
        };
        return made;
    };
    const size_t first = 2048, rest = bytes.size() - first;
    send(frame_first, bytes.substr(0, first), saturated(shape("frame, first part", -1), first),
         reading.due);
    send(frame_rest, bytes.substr(first),
         saturated(shape("frame, other part", static_cast<int>(rest) - 1), rest - 1), reading.due);
}

}  // namespace drude::usb_bench
