#include "usb_bench/obp_device.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <bit>

namespace drude::usb_bench {

namespace {

constexpr uint8_t commands = 0x01, answers = 0x81;
constexpr size_t header_bytes = 44, trailer_bytes = 20;
constexpr int response = 1, acknowledged = 2, acknowledge = 4, refused = 8;
constexpr int no_error = 0, unknown_type = 2, wrong_data = 6;
constexpr double power_on_s = 0.01;

Identity identity_of(const std::string& serial) {
    Identity id;
    id.name = "obp:" + serial;
    id.vendor = 0x2457;
    id.product = 0x4000;
    id.endpoints = {{commands, 512}, {answers, 512}};
    id.manufacturer = "Ocean Optics Inc.";
    id.product_name = "Ocean Optics STS";
    id.serial = serial;
    return id;
}

// GLib's, so that the client's own is judged by another.
Bytes md5(const Bytes& bytes) {
    GChecksum* sum = g_checksum_new(G_CHECKSUM_MD5);
    g_checksum_update(sum, static_cast<const guchar*>(static_cast<const void*>(bytes.data())),
                      static_cast<gssize>(bytes.size()));
    Bytes digest(16, '\0');
    gsize size = digest.size();
    g_checksum_get_digest(sum, static_cast<guint8*>(static_cast<void*>(digest.data())), &size);
    g_checksum_free(sum);
    return digest;
}

Bytes float_bytes(double value) {
    return little_endian(std::bit_cast<uint32_t>(static_cast<float>(value)), 4);
}

}  // namespace

ObpDevice::ObpDevice(const std::string& serial, OpticalBench& bench, FaultPlan& faults)
    : VirtualDevice(identity_of(serial), faults), bench_(bench), detector_(bench, power_on_s) {}

void ObpDevice::power_on() {
    detector_.restart(power_on_s);
    bench_.set_lamp(true);
    received_.clear();
}

std::string ObpDevice::describe(const Transfer& transfer) const {
    if (transfer.type == TransferType::control) return "control request";
    if (transfer.data.size() < header_bytes) return "part of a message";
    return fmt::format("message {:06x}", read_little_endian(transfer.data, 8, 4));
}

void ObpDevice::receive(uint8_t, const Bytes& data) {
    received_ += data;
    while (received_.size() >= header_bytes) {
        const size_t size = header_bytes + read_little_endian(received_, 40, 4);
        if (read_little_endian(received_, 0, 2) != 0xC0C1 || size > 4096) {
            received_.clear();
            return;
        }
        if (received_.size() < size) return;
        const Bytes message = received_.substr(0, size);
        received_.erase(0, size);
        execute(message);
    }
}

void ObpDevice::reply(const Bytes& request, int flags, int error, const Bytes& data,
                      const std::string& what, Instant due, bool frame) {
    Bytes message = little_endian(0xC0C1, 2) + little_endian(0x1100, 2);
    message += little_endian(static_cast<uint64_t>(flags), 2);
    message += little_endian(static_cast<uint64_t>(error), 2);
    message += request.substr(8, 8);  // type, and the host's number
    message += Bytes(6, '\0') + '\x01';
    const bool immediate = data.size() <= 16;
    Bytes in_header = immediate ? data : Bytes();
    message += little_endian(in_header.size(), 1);
    in_header.resize(16);
    const Bytes payload = immediate ? Bytes() : data;
    message += in_header + little_endian(payload.size() + trailer_bytes, 4) + payload;
    message += md5(message) + little_endian(0xC2C3C4C5, 4);
    AnswerShape shape;
    shape.what = what;
    shape.sync_at = 0;
    // Of the data where there are any, of the host's number otherwise.
    shape.checksum_at = static_cast<int>(immediate ? (data.empty() ? 12 : 24) : header_bytes);
    if (frame) {
        shape.saturate = [size = message.size()](std::string& bytes) {
            for (size_t i = header_bytes; i + trailer_bytes < size; i += 2) {
                bytes.replace(i, 2, little_endian(max_counts, 2));
            }
            const size_t summed = size - trailer_bytes;
            bytes.replace(summed, 16, md5(bytes.substr(0, summed)));
        };
    }
    send(answers, message, shape, due);
}

void ObpDevice::execute(const Bytes& message) {
    const auto type = static_cast<uint32_t>(read_little_endian(message, 8, 4));
    const bool wants_acknowledgement = (read_little_endian(message, 4, 2) & acknowledge) != 0;
    const size_t immediate = std::min<size_t>(byte_at(message, 23), 16);
    const Bytes data =
        immediate > 0 ? message.substr(24, immediate)
                      : message.substr(header_bytes, message.size() - header_bytes - trailer_bytes);
    const Instant now = Clock::now();
    const auto give = [&](const Bytes& bytes, const std::string& what) {
        reply(message, response, no_error, bytes, what, now);
    };
    const auto done = [&](const std::string& what) {
        if (!wants_acknowledgement) return;
        reply(message, response | acknowledged, no_error, {}, what, now);
    };
    const auto refuse = [&](int error) {
        reply(message, response | refused, error, {}, "refusal", now);
    };
    const VirtualBenchSettings& settings = bench_.optics().settings();
    const double slope = (settings.last_nm - settings.first_nm) / (settings.pixels - 1);
    switch (type) {
        case 0x00000100:
            return give(identity().serial, "serial");
        case 0x00110010: {
            if (data.size() != 4) return refuse(wrong_data);
            detector_.set_integration_time(1e-6 *
                                           static_cast<double>(read_little_endian(data, 0, 4)));
            return done("integration time set");
        }
        case 0x00110110:
            return done("trigger set");
        case 0x00110400:
            return give(little_endian(1, 1), "lamp");
        case 0x00110410:
            bench_.set_lamp(data.size() == 1 && data[0] != 0);
            return done("lamp set");
        case 0x00180100:
            return give(little_endian(2, 1), "number of wavelength coefficients");
        case 0x00180101:
            if (data.size() != 1 || byte_at(data, 0) > 1) return refuse(wrong_data);
            return give(float_bytes(data[0] == 0 ? settings.first_nm : slope),
                        "wavelength coefficient");
        case 0x00101100: {
            const FreeRunningDetector::Reading reading = detector_.fetch();
            Bytes counts;
            for (const uint32_t value : reading.counts) counts += little_endian(value, 2);
            return reply(message, response, no_error, counts, "frame", reading.due, true);
        }
        default:
            return refuse(unknown_type);
    }
}

}  // namespace drude::usb_bench
