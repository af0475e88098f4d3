#include "device/instruments/apt_rotator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/interrupt.h"
#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/instruments/mount_arrival.h"

namespace drude {

namespace {

// The controller's units of a velocity of 1 degree a second and of 1 degree a second squared.
constexpr double velocity_unit = 7329109, acceleration_unit = 1502;
constexpr double home_tolerance_deg = 1;
// Homing turns at most once at the slow velocity of the search, which the controller holds.
constexpr double home_s = 120;
constexpr uint8_t channel = 1;

SerialSettings apt_line(double settle_s) {
    SerialSettings settings;
    settings.baud = 115200;
    settings.flow = FlowControl::rts_cts;
    settings.settle_s = settle_s;
    return settings;
}

void append(std::vector<uint8_t>* bytes, int64_t value) {
    for (int byte = 0; byte < 4; ++byte) {
        bytes->push_back(static_cast<uint8_t>((static_cast<uint64_t>(value) >> (8 * byte)) & 0xFF));
    }
}

AptMessage short_message(uint16_t id, uint8_t parameter) {
    AptMessage message;
    message.id = id;
    message.parameter_1 = parameter;
    return message;
}

}  // namespace

int64_t k10cr1_microsteps(double degrees) {
    const double fraction = degrees / 360 - std::floor(degrees / 360);
    return std::llround(fraction * static_cast<double>(k10cr1_microsteps_per_turn)) %
           k10cr1_microsteps_per_turn;
}

double k10cr1_degrees(int64_t microsteps) {
    const int64_t turn = k10cr1_microsteps_per_turn;
    const int64_t within = ((microsteps % turn) + turn) % turn;
    return static_cast<double>(within) * 360 / static_cast<double>(turn);
}

AptRotator::AptRotator(std::shared_ptr<UsbPort> port, const AptOptions& options)
    : line_(std::move(port), apt_line(options.settle_s)), options_(options) {
    identity_ = start();
    info_.uri = "apt:" + line_.port().serial();
    info_.model = "Thorlabs " + identity_.model;
    info_.serial = std::to_string(identity_.serial);
    info_.units_per_degree = static_cast<double>(k10cr1_microsteps_per_turn) / 360;
    info_.repeatability_deg = 0.01;
    info_.tolerance_deg = options_.tolerance_deg;
}

void AptRotator::send(const AptMessage& message) {
    line_.write(encode_apt(message), deadline_in(1));
}

// What is there before anything was asked belongs to an earlier command. The chip hands over within
// its latency time of 2 ms what it holds.
void AptRotator::drop_late() {
    if (line_.drain(0.004, deadline_in(0.1)) > 0) ++dropped_;
}

AptMessage AptRotator::receive(Deadline deadline) {
    std::vector<uint8_t> bytes = line_.read_exact(6, deadline);
    // A message that has begun is read to its end whatever the deadline: half of one that stays
    // behind would be taken for the beginning of the next.
    const std::vector<uint8_t> data =
        line_.read_exact(apt_data_size(bytes, where()), deadline_in(options_.silence_s));
    bytes.insert(bytes.end(), data.begin(), data.end());
    AptMessage message = parse_apt(bytes, where());
    if (message.id == apt::response || message.id == apt::rich_response) {
        device_error(Fault::refused, "{}: the controller reports {}", where(),
                     apt_response_words(message));
    }
    return message;
}

AptMessage AptRotator::receive(uint16_t id, Deadline deadline) {
    for (;;) {
        AptMessage message = receive(deadline);
        if (message.id == id) return message;
        ++dropped_;
    }
}

AptInfo AptRotator::start() {
    // Some controllers otherwise write their flash memory at every power-up message and block.
    send(short_message(apt::no_flash_programming, 0));
    send(short_message(apt::stop_updates, 0));
    line_.drain(0.1, deadline_in(1));
    send(short_message(apt::request_info, 0));
    const AptInfo info =
        parse_apt_info(receive(apt::get_info, deadline_in(options_.silence_s)), where());
    if (info.model.rfind("K10CR1", 0) != 0) {
        device_error(Fault::refused,
                     "{}: is an APT controller '{}'; expected a K10CR1, whose microsteps a degree "
                     "are known",
                     where(), info.model);
    }
    AptMessage velocity;
    velocity.id = apt::set_velocity;
    velocity.data = {channel, 0};
    append(&velocity.data, 0);
    append(&velocity.data, std::llround(options_.degrees_per_s2 * acceleration_unit));
    append(&velocity.data, std::llround(options_.degrees_per_s * velocity_unit));
    send(velocity);
    return info;
}

AptStatus AptRotator::ask_status() {
    send(short_message(apt::request_status, channel));
    const AptStatus status =
        parse_apt_status(receive(apt::get_status, deadline_in(options_.silence_s)), where());
    // A controller that is not acknowledged stops sending.
    send(short_message(apt::acknowledge_status, 0));
    return status;
}

void AptRotator::check(const AptStatus& status) const {
    const std::string errors = apt_status_errors(status.bits);
    if (!errors.empty()) {
        device_error(Fault::mechanical, "{}: the controller reports {} (status {:08X})", where(),
                     errors, status.bits);
    }
}

// Sends a command and waits until its completion is announced, or until the mount stands still
// though it was not (the announcement was lost).
AptStatus AptRotator::finish(const AptMessage& command, uint16_t completed, double seconds) {
    drop_late();
    send(command);
    const Deadline end = deadline_in(seconds + options_.silence_s);
    int standing = 0;
    for (;;) {
        const Deadline poll = std::min(end, deadline_in(options_.poll_s));
        try {
            const AptMessage message = receive(completed, poll);
            return message.data.empty() ? ask_status() : parse_apt_status(message, where());
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::timeout) throw;
        }
        const AptStatus status = ask_status();
        check(status);
        standing = status.moving() ? 0 : standing + 1;
        if (standing >= 2) return status;
        if (std::chrono::steady_clock::now() >= end) {
            device_error(Fault::mechanical,
                         "{}: still moving, at {:.3f} degrees, after the {:.0f} s that its motion "
                         "takes at most; check that nothing holds it",
                         where(), k10cr1_degrees(status.position), seconds + options_.silence_s);
        }
    }
}

AptStatus AptRotator::run(const AptMessage& command, uint16_t completed, double seconds) {
    try {
        const AptStatus status = finish(command, completed, seconds);
        check(status);
        return status;
    } catch (const DeviceError& error) {
        // Nothing should turn on where nobody waits for it.
        if (error.fault() == Fault::mechanical || interrupted() != 0) {
            try {
                AptMessage stop = short_message(apt::move_stop, channel);
                stop.parameter_2 = 2;  // profiled, not abrupt
                send(stop);
            } catch (const DeviceError&) {
                // What went wrong first is what is reported.
            }
        }
        throw;
    }
}

void AptRotator::home() {
    const AptStatus status = run(short_message(apt::move_home, channel), apt::move_homed, home_s);
    const double off = std::remainder(k10cr1_degrees(status.position), 360);
    if (!status.homed() || std::abs(off) > home_tolerance_deg) {
        device_error(Fault::mechanical,
                     "{}: reports {:.3f} degrees and {} after homing; expected 0 within {} degree",
                     where(), off, status.homed() ? "homed" : "not homed", home_tolerance_deg);
    }
}

double AptRotator::move_to(double degrees) {
    if (!std::isfinite(degrees)) user_error("{}: cannot be sent to {} degrees", where(), degrees);
    AptMessage command;
    command.id = apt::move_absolute;
    command.data = {channel, 0};
    append(&command.data, k10cr1_microsteps(degrees));
    const auto move = [&] {
        // It goes straight to a count of microsteps, over as many turns as that takes, with ramps
        // at both ends.
        drop_late();
        const double microsteps =
            std::abs(static_cast<double>(k10cr1_microsteps(degrees) - ask_status().position));
        const double seconds = microsteps / info_.units_per_degree / options_.degrees_per_s +
                               2 * options_.degrees_per_s / options_.degrees_per_s2;
        return k10cr1_degrees(run(command, apt::move_completed, seconds).position);
    };
    return arrive(degrees, k10cr1_degrees(k10cr1_microsteps(degrees)), options_.tolerance_deg,
                  where(), move, [&] { line_.drain(0.1, deadline_in(1)); });
}

double AptRotator::position() {
    drop_late();
    return k10cr1_degrees(ask_status().position);
}

void AptRotator::recover() {
    line_.recover();
    const AptInfo now = start();
    if (now.serial != identity_.serial) {
        device_error(Fault::refused, "{}: another mount answers, serial number {}; expected {}",
                     where(), now.serial, identity_.serial);
    }
    // Commands given while it turns would be answered out of order.
    const Deadline end = deadline_in(360 / options_.degrees_per_s + options_.silence_s);
    for (AptStatus status = ask_status(); status.moving(); status = ask_status()) {
        if (std::chrono::steady_clock::now() >= end || interrupted() != 0) {
            device_error(Fault::mechanical, "{}: does not stop moving (status {:08X})", where(),
                         status.bits);
        }
        real_clock().sleep(options_.poll_s);
    }
}

bool AptRotator::reconnect(double seconds) {
    if (!line_.reopen(seconds)) return false;
    recover();
    home();
    return true;
}

std::shared_ptr<Rotator> open_apt(std::shared_ptr<UsbPort> port) {
    return std::make_shared<AptRotator>(std::move(port), AptOptions());
}

}  // namespace drude
