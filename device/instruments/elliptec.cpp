#include "device/instruments/elliptec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/instruments/mount_arrival.h"

namespace drude {

namespace {

// Homing ends within 0.1 degrees of the mark by its specification.
constexpr double home_tolerance_deg = 1;
constexpr double start_stop_s = 0.5;
constexpr double late_answers_s = 0.1;

SerialSettings elliptec_line() {
    SerialSettings settings;
    settings.baud = 9600;
    return settings;
}

char checked_address(char address) {
    if (address >= 'a' && address <= 'f') return static_cast<char>(address - 'a' + 'A');
    if ((address >= '0' && address <= '9') || (address >= 'A' && address <= 'F')) return address;
    user_error("'{}' is no address of an Elliptec mount; expected 0 to 9 or A to F", address);
}

}  // namespace

ElliptecBus::ElliptecBus(std::shared_ptr<UsbPort> port)
    : port_(std::move(port)), line_(port_, elliptec_line()) {}

std::shared_ptr<ElliptecBus> ElliptecBus::of(const std::shared_ptr<UsbPort>& port) {
    // A bus keeps its port alive, so an entry that has not expired cannot stand for another port.
    static std::mutex mutex;
    static std::map<const UsbPort*, std::weak_ptr<ElliptecBus>> buses;
    const std::lock_guard<std::mutex> lock(mutex);
    for (auto entry = buses.begin(); entry != buses.end();) {
        entry = entry->second.expired() ? buses.erase(entry) : std::next(entry);
    }
    std::weak_ptr<ElliptecBus>& known = buses[port.get()];
    std::shared_ptr<ElliptecBus> bus = known.lock();
    if (!bus) {
        bus = std::make_shared<ElliptecBus>(port);
        known = bus;
    }
    return bus;
}

void ElliptecBus::send(char address, std::string_view command) {
    // What is there before it is asked for belongs to an earlier question. The chip hands over
    // within its latency time of 2 ms what it holds.
    if (line_.drain(0.004, deadline_in(0.1)) > 0) ++dropped_;
    asked_ = address + std::string(command);
    line_.write(asked_, deadline_in(1));
}

std::string ElliptecBus::next_line(Deadline deadline) {
    try {
        return line_.read_line(deadline);
    } catch (const DeviceError& error) {
        if (error.fault() != Fault::timeout) throw;
        device_error(Fault::timeout,
                     "{}: no answer to '{}' in time; check the mount's supply and the bus cable",
                     line_.name(), asked_);
    }
}

ElliptecAnswer ElliptecBus::receive(char address, std::string_view codes, Deadline deadline) {
    for (;;) {
        const std::optional<ElliptecAnswer> answer = parse_elliptec_answer(next_line(deadline));
        if (answer && answer->address == address &&
            codes.find(answer->code) != std::string_view::npos) {
            return *answer;
        }
        ++dropped_;
    }
}

Elliptec::Elliptec(std::shared_ptr<ElliptecBus> bus, char address, const ElliptecOptions& options)
    : bus_(std::move(bus)), address_(checked_address(address)), options_(options) {
    connection_ = bus_->line().connections();
    identity_ = identify();
    info_.uri = fmt::format("ell:{}/{}", bus_->line().port().serial(), address_);
    info_.model = "Thorlabs " + identity_.model;
    info_.serial = identity_.serial;
    info_.units_per_degree = static_cast<double>(identity_.pulses_per_turn) / 360;
    info_.repeatability_deg = 0.05;
    info_.tolerance_deg = options_.tolerance_deg;
}

std::string Elliptec::where() const {
    return fmt::format("{}, mount {}", bus_->line().name(), address_);
}

ElliptecIdentity Elliptec::identify() {
    // A program that stopped within a command leaves its beginning in the mounts, which then do not
    // understand the next one: they complain or say nothing, and have forgotten it.
    for (int attempt = 0;; ++attempt) {
        try {
            bus_->send(address_, "in");
            const ElliptecAnswer answer =
                bus_->receive(address_, "IN GS", deadline_in(options_.silence_s));
            if (answer.code == "IN") return parse_elliptec_identity(answer, where());
            const int status = parse_elliptec_status(answer, where());
            if (status == elliptec_busy) {
                wait_until_idle(deadline_in(options_.silence_s + options_.home_s));
            } else if (attempt > 0) {
                device_error(elliptec_status_fault(status),
                             "{}: does not tell who it is: {} (GS{:02X})", where(),
                             elliptec_status_words(status), status);
            }
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::timeout) throw;
            if (attempt == 0) continue;
            device_error(Fault::timeout,
                         "{}: no mount answers at this address within {} s; check its address, its "
                         "supply and the bus cable",
                         where(), options_.silence_s);
        }
        if (attempt > 1) {
            device_error(Fault::mechanical, "{}: stays busy (GS09) when asked who it is", where());
        }
    }
}

double Elliptec::degrees_of(int64_t pulses) const {
    const int64_t turn = identity_.pulses_per_turn;
    const int64_t within = ((pulses % turn) + turn) % turn;
    return static_cast<double>(within) * 360 / static_cast<double>(turn);
}

double Elliptec::seen_at(int64_t pulses) {
    seen_ = true;
    last_deg_ = degrees_of(pulses);
    return last_deg_;
}

// It may go either way round: the longer one is waited for.
double Elliptec::seconds_to(double degrees) const {
    const double away = std::abs(std::remainder(degrees - last_deg_, 360));
    return (seen_ ? 360 - away : 360) / options_.degrees_per_s + start_stop_s;
}

int64_t Elliptec::ask_position() {
    bus_->send(address_, "gp");
    const Deadline deadline = deadline_in(options_.silence_s);
    const ElliptecAnswer answer = bus_->receive(address_, "PO GS", deadline);
    if (answer.code == "PO") return parse_elliptec_position(answer, where());
    const int status = parse_elliptec_status(answer, where());
    if (status == elliptec_busy) {
        wait_until_idle(deadline_in(options_.silence_s + options_.home_s));
        bus_->send(address_, "gp");
        return parse_elliptec_position(
            bus_->receive(address_, "PO", deadline_in(options_.silence_s)), where());
    }
    device_error(elliptec_status_fault(status), "{}: does not tell its position: {} (GS{:02X})",
                 where(), elliptec_status_words(status), status);
}

void Elliptec::wait_until_idle(Deadline deadline) {
    for (;;) {
        real_clock().sleep(options_.poll_s);
        bus_->send(address_, "gs");
        const int status = parse_elliptec_status(
            bus_->receive(address_, "GS", deadline_in(options_.silence_s)), where());
        if (status == elliptec_ok) return;
        if (status != elliptec_busy) {
            device_error(elliptec_status_fault(status), "{}: {} (GS{:02X})", where(),
                         elliptec_status_words(status), status);
        }
        if (std::chrono::steady_clock::now() >= deadline) {
            device_error(Fault::mechanical,
                         "{}: still busy (GS09) after the time that its motion takes; check that "
                         "nothing holds it",
                         where());
        }
    }
}

// Where the mount says that it is after `command`, which moves it within `seconds`.
int64_t Elliptec::move(const std::string& command, double seconds) {
    for (int attempt = 0;; ++attempt) {
        const Deadline deadline = deadline_in(options_.silence_s + seconds);
        bus_->send(address_, command);
        const ElliptecAnswer answer = bus_->receive(address_, "PO GS", deadline);
        if (answer.code == "PO") return parse_elliptec_position(answer, where());
        const int status = parse_elliptec_status(answer, where());
        if (status == elliptec_busy) wait_until_idle(deadline);
        if (status == elliptec_busy || status == elliptec_ok) return ask_position();
        if (status == elliptec_mechanical_timeout && attempt == 0) continue;
        device_error(elliptec_status_fault(status), "{}: did not move: {} (GS{:02X}){}", where(),
                     elliptec_status_words(status), status,
                     attempt > 0 ? ", also when asked again" : "");
    }
}

void Elliptec::home() {
    // The digit is a direction: 0 is clockwise.
    const double at = seen_at(move("ho0", options_.home_s));
    const double off = std::remainder(at, 360);
    if (std::abs(off) > home_tolerance_deg) {
        device_error(Fault::mechanical,
                     "{}: reports {:.3f} degrees after homing; expected 0 within {} degree",
                     where(), off, home_tolerance_deg);
    }
    connection_ = bus_->line().connections();
}

void Elliptec::home_after_reconnection() {
    if (connection_ != bus_->line().connections()) home();
}

double Elliptec::move_to(double degrees) {
    if (!std::isfinite(degrees)) user_error("{}: cannot be sent to {} degrees", where(), degrees);
    home_after_reconnection();
    const auto turn = static_cast<double>(identity_.pulses_per_turn);
    const double fraction = degrees / 360 - std::floor(degrees / 360);
    const int64_t target = std::llround(fraction * turn) % identity_.pulses_per_turn;
    const std::string command = fmt::format("ma{:08X}", target);
    return arrive(
        degrees, fraction * 360, options_.tolerance_deg, where(),
        [&] { return seen_at(move(command, seconds_to(degrees))); },
        [&] { bus_->line().drain(late_answers_s, deadline_in(1)); });
}

double Elliptec::position() {
    home_after_reconnection();
    return seen_at(ask_position());
}

void Elliptec::recover() {
    bus_->line().recover();
    // Asking for the status also clears it; an error that persists comes back.
    for (int attempt = 0;; ++attempt) {
        bus_->send(address_, "gs");
        const int status = parse_elliptec_status(
            bus_->receive(address_, "GS", deadline_in(options_.silence_s)), where());
        if (status == elliptec_ok) return;
        if (status == elliptec_busy) {
            return wait_until_idle(deadline_in(options_.silence_s + options_.home_s));
        }
        if (attempt > 0) {
            device_error(elliptec_status_fault(status),
                         "{}: reports {} (GS{:02X}) also when asked "
                         "again; switch it off and on",
                         where(), elliptec_status_words(status), status);
        }
    }
}

bool Elliptec::reconnect(double seconds) {
    if (!bus_->line().reopen(seconds)) return false;
    bus_->line().drain(late_answers_s, deadline_in(1));
    const ElliptecIdentity now = identify();
    if (now.serial != identity_.serial || now.pulses_per_turn != identity_.pulses_per_turn) {
        device_error(Fault::refused, "{}: the mount that came back is {} {}; expected {} {}",
                     where(), now.model, now.serial, identity_.model, identity_.serial);
    }
    home();
    return true;
}

std::shared_ptr<Rotator> open_elliptec(std::shared_ptr<UsbPort> port, char address) {
    return std::make_shared<Elliptec>(ElliptecBus::of(port), address, ElliptecOptions());
}

}  // namespace drude
