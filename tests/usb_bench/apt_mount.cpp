#include "usb_bench/apt_mount.h"

#include <cstdlib>

#include <fmt/format.h>

namespace drude::usb_bench {

namespace {

constexpr uint16_t request_info = 0x0005, get_info = 0x0006, move_home = 0x0443,
                   move_homed = 0x0444, move_absolute = 0x0453, move_completed = 0x0464,
                   move_stop = 0x0465, move_stopped = 0x0466, request_status = 0x0480,
                   get_status = 0x0481;
constexpr double answer_s = 0.0005;

Identity identity_of(const std::string& serial) {
    Identity id;
    id.name = "apt:" + serial;
    id.vendor = 0x0403;
    id.product = 0xFAF0;
    id.release = 0x1000;
    id.interface_class = id.subclass = id.protocol = 0xFF;
    id.endpoints = {{0x81, 64}, {0x02, 64}};
    id.manufacturer = "Thorlabs";
    id.product_name = "Kinesis K10CR1 Rotary Stage";
    id.serial = serial;
    id.high_speed = false;
    id.kernel_driver = "ftdi_sio";
    return id;
}

}  // namespace

AptMount::AptMount(const std::string& serial, Role role, double move_s, OpticalBench& bench,
                   FaultPlan& faults)
    // 115200 baud: divisor 26, wValue 0x001A.
    : FtdiDevice(identity_of(serial), 0x001A, faults),
      bench_(bench),
      role_(role),
      move_s_(move_s) {}

void AptMount::power_on() {
    FtdiDevice::power_on();
    line_.clear();
}

std::string AptMount::describe_line(const Bytes& bytes) const {
    if (bytes.size() < 2) return "part of a message";
    return fmt::format("message {:04X}", read_little_endian(bytes, 0, 2));
}

void AptMount::line_received(const Bytes& bytes) {
    line_ += bytes;
    while (line_.size() >= 6) {
        const bool has_data = (byte_at(line_, 4) & 0x80) != 0;
        const size_t size = has_data ? read_little_endian(line_, 2, 2) : 0;
        if (line_.size() < 6 + size) return;
        const auto id = static_cast<uint16_t>(read_little_endian(line_, 0, 2));
        const Bytes data = line_.substr(6, size);
        line_.erase(0, 6 + size);
        execute(id, data);
    }
}

void AptMount::answer(uint16_t id, const Bytes& data, const std::string& what, bool moves,
                      double delay_s) {
    AnswerShape shape;
    shape.what = fmt::format("message {:04X}, {}", id, what);
    shape.sync_at = 0;
    shape.serial_line = true;
    shape.moves = moves;
    // To the host (01), with data (bit 7), from the unit (50).
    const Bytes header =
        little_endian(id, 2) + little_endian(data.size(), 2) + Bytes{'\x81', '\x50'};
    line_send(header + data, shape, Clock::now() + seconds_of(delay_s));
}

void AptMount::answer_short(uint16_t id, int parameter, const std::string& what, bool moves,
                            double delay_s) {
    AnswerShape shape;
    shape.what = fmt::format("message {:04X}, {}", id, what);
    shape.sync_at = 0;
    shape.serial_line = true;
    shape.moves = moves;
    const Bytes message = little_endian(id, 2) +
                          little_endian(static_cast<uint64_t>(parameter), 1) +
                          Bytes{'\0', '\x01', '\x50'};
    line_send(message, shape, Clock::now() + seconds_of(delay_s));
}

Bytes AptMount::status() const {
    // Channel, position, velocity and current, status bits: 0x400 homed, 0x80000000 enabled.
    return little_endian(1, 2) + little_endian(static_cast<uint32_t>(microsteps_), 4) +
           little_endian(0, 4) + little_endian(0x80000000U | (homed_ ? 0x400U : 0U), 4);
}

bool AptMount::go(int32_t microsteps) {
    if (faults_.upcoming(FaultKind::jam)) jammed_ = true;
    if (jammed_ || faults_.upcoming(FaultKind::stuck) || faults_.upcoming(FaultKind::busy)) {
        return false;
    }
    microsteps_ = microsteps;
    bench_.set(role_, microsteps * 3 / 409600.0);
    return true;
}

void AptMount::execute(uint16_t id, const Bytes& data) {
    switch (id) {
        case request_info: {
            const auto serial = std::strtoul(identity().serial.c_str(), nullptr, 10);
            Bytes info = little_endian(serial, 4) + "K10CR1";
            info.resize(12);
            info += little_endian(16, 2) + Bytes{'\x03', '\0', '\x01', '\0'};
            info.resize(78);
            info += little_endian(1, 2) + little_endian(0, 2) + little_endian(1, 2);
            answer(get_info, info, "info", false, answer_s);
            return;
        }
        case move_home:
            // The mark is found where the mount can turn; otherwise nothing is ever said.
            if (go(0)) homed_ = true;
            if (homed_ && microsteps_ == 0) {
                answer_short(move_homed, 1, "homed", true, answer_s + move_s_);
            } else {
                answer(get_status, status(), "not homed", true, answer_s + move_s_);
            }
            return;
        case move_absolute:
            if (data.size() < 6) return;
            go(static_cast<int32_t>(read_little_endian(data, 2, 4)));
            // A mount that did not turn says that its move is over, and where it is.
            answer(move_completed, status(), "move completed", true, answer_s + move_s_);
            return;
        case move_stop:
            answer(move_stopped, status(), "stopped", false, answer_s);
            return;
        case request_status:
            answer(get_status, status(), "status", false, answer_s);
            return;
        default:
            return;  // settings that a virtual mount does not need
    }
}

}  // namespace drude::usb_bench
