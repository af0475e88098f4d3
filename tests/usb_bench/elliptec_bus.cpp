#include "usb_bench/elliptec_bus.h"

#include <cstdlib>

#include <fmt/format.h>

namespace drude::usb_bench {

namespace {

constexpr double answer_s = 0.0005;
// Of the status table of the manual.
constexpr int status_ok = 0, status_mechanical = 2, status_unknown = 3, status_busy = 9;

Identity identity_of(const std::string& serial) {
    Identity id;
    id.name = "ell:" + serial;
    id.vendor = 0x0403;
    id.product = 0x6015;
    id.release = 0x1000;
    id.interface_class = id.subclass = id.protocol = 0xFF;
    id.endpoints = {{0x81, 64}, {0x02, 64}};
    id.manufacturer = "FTDI";
    id.product_name = "FT230X Basic UART";
    id.serial = serial;
    id.high_speed = false;
    id.kernel_driver = "ftdi_sio";
    return id;
}

// How long a command is, its address included; the manual gives each a fixed length.
size_t command_length(const std::string& letters) {
    if (letters == "ma" || letters == "mr" || letters == "sj" || letters == "so") return 11;
    return letters == "ho" || letters == "ca" ? 4 : 3;
}

}  // namespace

ElliptecBus::ElliptecBus(const std::string& serial, const std::vector<Role>& roles, double move_s,
                         OpticalBench& bench, FaultPlan& faults)
    : FtdiDevice(identity_of(serial), 0x4138, faults), bench_(bench), move_s_(move_s) {
    for (size_t i = 0; i < roles.size(); ++i) mounts_[static_cast<char>('0' + i)].role = roles[i];
}

void ElliptecBus::power_on() {
    // The mounts have a supply of their own and stay where they are.
    FtdiDevice::power_on();
    line_.clear();
}

std::string ElliptecBus::describe_line(const Bytes& bytes) const {
    return fmt::format("command '{}'", bytes);
}

void ElliptecBus::line_received(const Bytes& bytes) {
    line_ += bytes;
    while (line_.size() >= 3) {
        // What cannot begin a command is skipped, as a mount does after a while.
        if (mounts_.count(line_[0]) == 0 && std::isxdigit(byte_at(line_, 0)) == 0) {
            line_.erase(0, 1);
            continue;
        }
        const std::string letters = line_.substr(1, 2);
        size_t length = command_length(letters);
        // The direction of homing may be left out by a host that says so by ending its command.
        if (letters == "ho" && line_.size() == 3) length = 3;
        if (line_.size() < length) return;
        const char address = line_[0];
        const std::string argument = line_.substr(3, length - 3);
        line_.erase(0, length);
        execute(address, letters, argument);
        while (!line_.empty() && (line_[0] == '\r' || line_[0] == '\n')) line_.erase(0, 1);
    }
}

void ElliptecBus::answer(const std::string& text, bool moves, double delay_s) {
    AnswerShape shape;
    shape.what = fmt::format("answer '{}'", text);
    shape.sync_at = 0;
    shape.serial_line = true;
    shape.moves = moves;
    line_send(text + "\r\n", shape, Clock::now() + seconds_of(delay_s));
}

void ElliptecBus::execute(char address, const std::string& command, const std::string& argument) {
    const auto found = mounts_.find(address);
    if (found == mounts_.end()) return;  // nobody there
    Mount& mount = found->second;
    const auto number = static_cast<int32_t>(std::strtoul(argument.c_str(), nullptr, 16));
    if (command == "in") {
        // Type 0E, serial, year, firmware, thread, travel in degrees, pulses a turn.
        answer(fmt::format("{}IN0E{}20241701{:04X}{:08X}", address,
                           fmt::format("1140058{}", address), 360, pulses_per_turn),
               false, answer_s);
    } else if (command == "gs") {
        int status = mount.status;
        if (mount.busy_answers > 0) {
            --mount.busy_answers;
            status = status_busy;
        } else {
            mount.status = status_ok;
        }
        answer(fmt::format("{}GS{:02X}", address, status), false, answer_s);
    } else if (command == "gp") {
        answer(fmt::format("{}PO{:08X}", address, static_cast<uint32_t>(mount.pulses)), false,
               answer_s);
    } else if (command == "ho") {
        move(address, mount, 0);
    } else if (command == "ma") {
        move(address, mount, number);
    } else if (command == "mr") {
        move(address, mount, mount.pulses + number);
    } else {
        answer(fmt::format("{}GS{:02X}", address, status_unknown), false, answer_s);
    }
}

void ElliptecBus::move(char address, Mount& mount, int32_t pulses) {
    if (faults_.upcoming(FaultKind::jam)) mount.jammed = true;
    if (faults_.upcoming(FaultKind::busy)) {
        // Busy with what it did before: the command is refused, and so is the next question.
        mount.busy_answers = 1;
        answer(fmt::format("{}GS{:02X}", address, status_busy), true, answer_s);
        return;
    }
    if (mount.jammed || faults_.upcoming(FaultKind::stuck)) {
        mount.status = status_mechanical;
        answer(fmt::format("{}GS{:02X}", address, status_mechanical), true, answer_s + move_s_);
        return;
    }
    mount.pulses = pulses;
    bench_.set(mount.role, pulses * 360.0 / pulses_per_turn);
    answer(fmt::format("{}PO{:08X}", address, static_cast<uint32_t>(pulses)), true,
           answer_s + move_s_);
}

}  // namespace drude::usb_bench
