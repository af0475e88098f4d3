#include "device/instruments/ftdi_serial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "device/bench_clock.h"
#include "device/device_error.h"

namespace drude {

namespace {

// Vendor requests to the chip (bmRequestType 40 hex), as the kernel's ftdi_sio makes them.
constexpr uint8_t to_chip = 0x40;
constexpr uint8_t reset = 0, modem_control = 1, flow_control = 2, set_baud = 3, set_data = 4,
                  set_latency = 9;
constexpr uint16_t reset_chip = 0, purge_receive = 1, purge_transmit = 2;
constexpr uint16_t eight_data_bits = 0x0008;
// Each line has a bit for its state and, in the upper byte, one that says to change it.
constexpr uint16_t dtr_on = 0x0101, rts_on = 0x0202;
constexpr uint16_t rts_cts = 0x0100, xon_xoff = 0x0400;
constexpr uint16_t xon_xoff_characters = 0x1311;

constexpr uint8_t overrun = 0x02, parity = 0x04, framing = 0x08, line_break = 0x10;

constexpr double control_s = 1;
constexpr size_t longest_line = 256;

uint8_t find_endpoint(const UsbPort& port, bool in) {
    for (const auto& entry : port.endpoints()) {
        if (entry.second == 2 && ((entry.first & 0x80) != 0) == in) return entry.first;
    }
    device_error(Fault::io, "{}: has no bulk {} endpoint; a serial-port chip has one each way",
                 port.name(), in ? "IN" : "OUT");
}

}  // namespace

FtdiDivisor ftdi_divisor(uint32_t baud) {
    // In eighths: 24 MHz over the rate, to the nearest.
    const uint64_t clock = 24'000'000;
    const uint64_t eighths = baud == 0 ? 0 : (clock + baud / 2) / baud;
    const uint64_t whole = eighths >> 3;
    const bool possible = whole >= 1 && whole < (1u << 14);
    // Below 2 the chip knows the quotients 1 and 1.5 only.
    const uint64_t nearest = whole == 1 ? (eighths < 10 ? 8 : eighths < 14 ? 12 : 16) : eighths;
    const double reached = possible ? static_cast<double>(clock) / static_cast<double>(nearest) : 0;
    if (!possible || std::abs(reached - baud) > 0.03 * baud) {
        user_error(
            "{} baud cannot be made by an FTDI chip; expected 184 to 3000000, near 3 MHz "
            "over a multiple of 1/8",
            baud);
    }
    if (nearest == 8) return {0, 0};
    if (nearest == 12) return {1, 0};
    constexpr std::array<uint64_t, 8> code = {0, 3, 2, 4, 1, 5, 6, 7};  // by eighths
    const uint64_t encoded = (nearest >> 3) | (code[nearest & 7] << 14);
    return {static_cast<uint16_t>(encoded & 0xFFFF), static_cast<uint16_t>(encoded >> 16)};
}

FtdiPayload strip_ftdi_status(std::span<const uint8_t> transfer, size_t packet_size,
                              const std::string& where) {
    FtdiPayload payload;
    if (packet_size < 3) {
        device_error(Fault::io, "{}: packets of {} bytes hold no data beside the two of status",
                     where, packet_size);
    }
    for (size_t at = 0; at < transfer.size(); at += packet_size) {
        const std::span<const uint8_t> packet =
            transfer.subspan(at, std::min(packet_size, transfer.size() - at));
        if (packet.size() < 2) {
            device_error(Fault::bad_frame,
                         "{}: a packet of one byte; every packet of an FTDI chip begins with two "
                         "bytes of status",
                         where);
        }
        payload.modem = packet[0];
        payload.line = static_cast<uint8_t>(payload.line | packet[1]);
        payload.data.insert(payload.data.end(), packet.begin() + 2, packet.end());
    }
    return payload;
}

std::string ftdi_line_errors(uint8_t line) {
    std::string words;
    const auto add = [&](uint8_t bit, const char* word) {
        if ((line & bit) == 0) return;
        if (!words.empty()) words += ", ";
        words += word;
    };
    add(overrun, "overrun");
    add(parity, "parity error");
    add(framing, "framing error");
    add(line_break, "break");
    return words;
}

FtdiSerial::FtdiSerial(std::shared_ptr<UsbPort> port, const SerialSettings& settings)
    : port_(std::move(port)), settings_(settings) {
    in_ = find_endpoint(*port_, true);
    out_ = find_endpoint(*port_, false);
    packet_size_ = port_->packet_size(in_);
    configure();
}

void FtdiSerial::request(uint8_t number, uint16_t value, uint16_t index) {
    port_->control_out({to_chip, number, value, index}, {}, deadline_in(control_s));
}

void FtdiSerial::configure() {
    const FtdiDivisor divisor = ftdi_divisor(settings_.baud);
    request(reset, reset_chip, 0);
    request(set_latency, settings_.latency_ms, 0);
    request(set_baud, divisor.value, divisor.index);
    request(set_data, eight_data_bits, 0);
    if (settings_.settle_s > 0) real_clock().sleep(settings_.settle_s);
    request(reset, purge_receive, 0);
    request(reset, purge_transmit, 0);
    received_.clear();
    if (settings_.settle_s > 0) real_clock().sleep(settings_.settle_s);
    const bool by_characters = settings_.flow == FlowControl::xon_xoff;
    request(flow_control, by_characters ? xon_xoff_characters : uint16_t{0},
            settings_.flow == FlowControl::rts_cts ? rts_cts
            : by_characters                        ? xon_xoff
                                                   : uint16_t{0});
    request(modem_control, dtr_on | rts_on, 0);
}

void FtdiSerial::recover() {
    port_->clear_halt(in_);
    port_->clear_halt(out_);
    configure();
    // Longer than the latency timer and two lines at 9600 baud.
    drain(0.1, deadline_in(1));
}

bool FtdiSerial::reopen(double seconds) {
    if (!port_->reopen(seconds)) return false;
    configure();
    ++connections_;
    return true;
}

void FtdiSerial::write(std::span<const uint8_t> bytes, Deadline deadline) {
    port_->write(out_, bytes, deadline);
}

void FtdiSerial::write(std::string_view text, Deadline deadline) {
    const std::vector<uint8_t> bytes(text.begin(), text.end());
    write(bytes, deadline);
}

// One packet a read: a time-out then never takes bytes with it that had arrived before.
void FtdiSerial::receive(Deadline deadline) {
    if (std::chrono::steady_clock::now() >= deadline) {
        device_error(Fault::timeout, "{}: no answer", name());
    }
    std::vector<uint8_t> packet(packet_size_);
    packet.resize(port_->read(in_, packet, deadline));
    const FtdiPayload payload = strip_ftdi_status(packet, packet_size_, name());
    const std::string errors = ftdi_line_errors(payload.line);
    if (!errors.empty()) {
        received_.clear();
        device_error(Fault::bad_frame,
                     "{}: the serial line reports {}; bytes were damaged or lost (cable, supply, "
                     "baud rate)",
                     name(), errors);
    }
    received_.insert(received_.end(), payload.data.begin(), payload.data.end());
}

std::string FtdiSerial::read_line(Deadline deadline) {
    for (;;) {
        const auto end = std::find(received_.begin(), received_.end(), uint8_t{'\n'});
        if (end != received_.end()) {
            std::string line(received_.begin(), end);
            received_.erase(received_.begin(), end + 1);
            if (!line.empty() && line.back() == '\r') line.pop_back();
            return line;
        }
        if (received_.size() > longest_line) {
            received_.clear();
            device_error(Fault::bad_frame, "{}: {} bytes without the end of a line", name(),
                         longest_line);
        }
        receive(deadline);
    }
}

std::vector<uint8_t> FtdiSerial::read_exact(size_t size, Deadline deadline) {
    while (received_.size() < size) receive(deadline);
    const auto end = received_.begin() + static_cast<std::ptrdiff_t>(size);
    std::vector<uint8_t> bytes(received_.begin(), end);
    received_.erase(received_.begin(), end);
    return bytes;
}

size_t FtdiSerial::discard_received() {
    const size_t dropped = received_.size();
    received_.clear();
    return dropped;
}

size_t FtdiSerial::drain(double quiet_s, Deadline deadline) {
    size_t dropped = discard_received();
    Deadline quiet = std::min(deadline, deadline_in(quiet_s));
    std::vector<uint8_t> packet(packet_size_);
    while (std::chrono::steady_clock::now() < quiet) {
        try {
            const size_t size = port_->read(in_, packet, quiet);
            if (size <= 2) continue;
            dropped += size - 2;
            quiet = std::min(deadline, deadline_in(quiet_s));
        } catch (const DeviceError& error) {
            if (error.fault() == Fault::timeout) break;
            if (error.fault() != Fault::overflow) throw;
        }
    }
    return dropped;
}

}  // namespace drude
