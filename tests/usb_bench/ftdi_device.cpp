#include "usb_bench/ftdi_device.h"

#include <algorithm>
#include <utility>

namespace drude::usb_bench {

namespace {

// Modem status (clear to send) and line status (transmitter and its register empty).
constexpr char modem_status = '\x11', line_status = '\x60';

}  // namespace

FtdiDevice::FtdiDevice(Identity identity, uint16_t divisor, FaultPlan& faults)
    : VirtualDevice(std::move(identity), faults),
      expected_divisor_(divisor),
      last_packet_(Clock::now()) {}

void FtdiDevice::power_on() {
    divisor_ = 0;
    latency_ms_ = 16;
    to_host_.clear();
}

bool FtdiDevice::control(Transfer& transfer) {
    const uint8_t type = transfer.setup[0], request = transfer.setup[1];
    if (type == 0x40) {
        if (request == 0 && transfer.value() <= 1) to_host_.clear();
        if (request == 3) divisor_ = transfer.value();
        if (request == 9) latency_ms_ = std::max(1, transfer.value() & 0xFF);
        return true;
    }
    if (type == 0xC0 && request == 5) {
        transfer.data = {modem_status, line_status};
        return true;
    }
    if (type == 0xC0 && request == 10) {
        transfer.data = little_endian(static_cast<uint64_t>(latency_ms_), 1);
        return true;
    }
    return false;
}

std::string FtdiDevice::describe(const Transfer& transfer) const {
    if (transfer.type != TransferType::control) return describe_line(transfer.data);
    if ((transfer.setup[0] & 0x60) == 0) return "standard request";
    static const char* const names[] = {"reset", "modem control", "flow",   "baud rate",
                                        "line",  "modem status",  "event",  "error",
                                        "8",     "set latency",   "latency"};
    const uint8_t request = transfer.setup[1];
    return std::string("chip: ") + (request <= 10 ? names[request] : "unknown request");
}

void FtdiDevice::receive(uint8_t, const Bytes& data) {
    // At another baud rate the line carries nothing that anyone understands.
    if (divisor_ == expected_divisor_) line_received(data);
}

void FtdiDevice::line_send(const Bytes& message, const AnswerShape& shape, Instant due) {
    const std::optional<Prepared> prepared =
        prepare(identity().endpoints[0].address, message, shape);
    if (prepared) to_host_.push_back({prepared->bytes, due, prepared->babble});
}

std::optional<VirtualDevice::Packet> FtdiDevice::next_packet(uint8_t endpoint, Instant now) {
    Packet packet{{modem_status, line_status}, now, false};
    const size_t size = packet_size(endpoint);
    while (!to_host_.empty() && to_host_.front().due <= now && packet.data.size() < size) {
        Message& first = to_host_.front();
        const size_t taken = std::min(size - packet.data.size(), first.bytes.size());
        packet.data += first.bytes.substr(0, taken);
        packet.babble = packet.babble || first.babble;
        first.bytes.erase(0, taken);
        if (first.bytes.empty()) to_host_.pop_front();
    }
    // Nothing but status: only when the latency timer says so.
    if (packet.data.size() == 2 && !packet.babble &&
        now - last_packet_ < std::chrono::milliseconds(latency_ms_)) {
        return std::nullopt;
    }
    last_packet_ = now;
    return packet;
}

}  // namespace drude::usb_bench
