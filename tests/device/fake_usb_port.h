// A USB device for tests of protocols: its answers are queued by the test, packet by packet, as a
// real bus would hand them out, and everything that was asked of it is recorded.
//
//     auto port = std::make_shared<FakeUsbPort>();
//     port->on_write = [&](uint8_t, const Bytes& bytes) { port->answer(0x81, {0x06, 0x0D}); };
//
// Nothing waits: an endpoint that holds nothing times out at once.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "device/device_error.h"
#include "device/usb/usb_port.h"

namespace drude {

using Bytes = std::vector<uint8_t>;

class FakeUsbPort : public UsbPort {
  public:
    struct Write {
        uint8_t endpoint = 0;
        Bytes bytes;
        bool operator==(const Write&) const = default;
    };
    struct Control {
        ControlRequest request;
        Bytes data;  // of a control_out
    };

    // ---- what the device is
    std::string name_ = "fake device", serial_ = "FAKE1";
    uint16_t vendor_ = 0x2457, product_ = 0x1022;
    bool high_speed_ = true;
    std::map<uint8_t, size_t> packet_sizes_ = {{0x01, 512}, {0x81, 512}, {0x82, 512}, {0x86, 512}};

    // ---- what it does; called after the transfer was recorded
    std::function<void(uint8_t endpoint, const Bytes&)> on_write;
    std::function<void(const ControlRequest&, const Bytes&)> on_control_out;
    std::function<Bytes(const ControlRequest&, uint16_t length)> on_control_in;
    std::function<void(uint8_t endpoint)> on_clear_halt;
    std::function<bool(double seconds)> on_reopen;  // none: it does not come back

    // Queues a message as packets. A message of whole packets is not ended by an empty packet
    // unless `terminate` says so, as devices of fixed lengths do it.
    void answer(uint8_t endpoint, const Bytes& message, bool terminate = false) {
        const size_t size = packet_sizes_.at(endpoint);
        for (size_t at = 0; at < message.size(); at += size) {
            const size_t end = std::min(message.size(), at + size);
            queue_[endpoint].push_back(Bytes(message.begin() + static_cast<std::ptrdiff_t>(at),
                                             message.begin() + static_cast<std::ptrdiff_t>(end)));
        }
        if (message.empty() || (terminate && message.size() % size == 0)) {
            queue_[endpoint].push_back(Bytes());
        }
    }
    // The transfer that comes to this point of the queue fails; a stall stays until clear_halt().
    void fail(uint8_t endpoint, Fault fault) { queue_[endpoint].push_back(fault); }
    // The next write to `endpoint` fails.
    void fail_write(uint8_t endpoint, Fault fault) { write_faults_[endpoint].push_back(fault); }
    void unplug() { unplugged_ = true; }

    // ---- what was asked of it
    std::vector<Write> writes;
    std::vector<Control> controls;
    std::vector<uint8_t> cleared;
    int reopened = 0;
    bool holds_nothing() const {
        return std::all_of(queue_.begin(), queue_.end(),
                           [](const auto& entry) { return entry.second.empty(); });
    }

    // ---- UsbPort
    std::string name() const override { return name_; }
    std::string serial() const override { return serial_; }
    uint16_t vendor() const override { return vendor_; }
    uint16_t product() const override { return product_; }
    bool high_speed() const override { return high_speed_; }
    size_t packet_size(uint8_t endpoint) const override {
        const auto found = packet_sizes_.find(endpoint);
        return found == packet_sizes_.end() ? 0 : found->second;
    }
    std::vector<std::pair<uint8_t, uint8_t>> endpoints() const override {
        std::vector<std::pair<uint8_t, uint8_t>> result;
        for (const auto& [endpoint, size] : packet_sizes_) result.emplace_back(endpoint, 2);
        return result;
    }
    void write(uint8_t endpoint, std::span<const uint8_t> bytes, Deadline) override {
        check_there();
        require(endpoint);
        std::deque<Fault>& faults = write_faults_[endpoint];
        if (!faults.empty()) {
            const Fault fault = faults.front();
            faults.pop_front();
            if (fault == Fault::stall) halted_.insert(endpoint);
            if (fault == Fault::unplugged) unplugged_ = true;
            raise(fault);
        }
        if (halted_.count(endpoint) > 0) raise(Fault::stall);
        writes.push_back({endpoint, Bytes(bytes.begin(), bytes.end())});
        const Bytes copy = writes.back().bytes;
        if (on_write) on_write(endpoint, copy);
    }
    size_t read(uint8_t endpoint, std::span<uint8_t> buffer, Deadline) override {
        check_there();
        require(endpoint);
        if (halted_.count(endpoint) > 0) raise(Fault::stall);
        std::deque<std::variant<Bytes, Fault>>& queue = queue_[endpoint];
        size_t filled = 0;
        while (!queue.empty()) {
            if (const Fault* fault = std::get_if<Fault>(&queue.front())) {
                const Fault kind = *fault;
                queue.pop_front();
                if (kind == Fault::stall) halted_.insert(endpoint);
                if (kind == Fault::unplugged) unplugged_ = true;
                raise(kind);
            }
            const Bytes packet = std::get<Bytes>(queue.front());
            queue.pop_front();
            // A packet that finds too little room is lost with its transfer, as on a bus.
            if (packet.size() > buffer.size() - filled) raise(Fault::overflow);
            std::copy(packet.begin(), packet.end(),
                      buffer.begin() + static_cast<std::ptrdiff_t>(filled));
            filled += packet.size();
            if (packet.size() < packet_sizes_.at(endpoint) || filled == buffer.size()) {
                return filled;
            }
        }
        raise(Fault::timeout);
    }
    void control_out(const ControlRequest& request, std::span<const uint8_t> data,
                     Deadline) override {
        check_there();
        controls.push_back({request, Bytes(data.begin(), data.end())});
        const Bytes copy = controls.back().data;
        if (on_control_out) on_control_out(request, copy);
    }
    std::vector<uint8_t> control_in(const ControlRequest& request, uint16_t length,
                                    Deadline) override {
        check_there();
        controls.push_back({request, {}});
        if (!on_control_in) raise(Fault::stall);
        Bytes answer = on_control_in(request, length);
        answer.resize(std::min<size_t>(answer.size(), length));
        return answer;
    }
    void clear_halt(uint8_t endpoint) override {
        check_there();
        require(endpoint);
        halted_.erase(endpoint);
        cleared.push_back(endpoint);
        if (on_clear_halt) on_clear_halt(endpoint);
    }
    size_t drain(uint8_t endpoint, double, Deadline deadline) override {
        size_t dropped = 0;
        Bytes buffer(64 * packet_sizes_.at(endpoint));
        for (;;) {
            try {
                dropped += read(endpoint, buffer, deadline);
            } catch (const DeviceError& error) {
                if (error.fault() == Fault::timeout) return dropped;
                if (error.fault() != Fault::overflow) throw;
            }
        }
    }
    bool reopen(double seconds) override {
        ++reopened;
        if (!on_reopen || !on_reopen(seconds)) return false;
        unplugged_ = false;
        halted_.clear();
        queue_.clear();
        return true;
    }

  private:
    [[noreturn]] void raise(Fault fault) const {
        device_error(fault, "{}: {}", name_, fault_name(fault));
    }
    void check_there() const {
        if (unplugged_) raise(Fault::unplugged);
    }
    void require(uint8_t endpoint) const {
        if (packet_sizes_.count(endpoint) == 0) {
            device_error(Fault::io, "{}: no endpoint {:02x}", name_, endpoint);
        }
    }

    std::map<uint8_t, std::deque<std::variant<Bytes, Fault>>> queue_;
    std::map<uint8_t, std::deque<Fault>> write_faults_;
    std::set<uint8_t> halted_;
    bool unplugged_ = false;
};

}  // namespace drude
