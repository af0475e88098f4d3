#include "usb_bench/virtual_device.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <utility>

namespace drude::usb_bench {

Bytes little_endian(uint64_t value, int width) {
    Bytes bytes;
    for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
}

uint64_t read_little_endian(const Bytes& bytes, size_t first, int width) {
    uint64_t value = 0;
    for (int i = 0; i < width; ++i) value |= uint64_t{byte_at(bytes, first + i)} << (8 * i);
    return value;
}

VirtualDevice::VirtualDevice(Identity identity, FaultPlan& faults)
    : faults_(faults), identity_(std::move(identity)) {}

Bytes VirtualDevice::descriptors() const {
    // USB 2.0, tables 9-8, 9-10, 9-12 and 9-13.
    const Identity& id = identity_;
    Bytes device = little_endian(18, 1) + little_endian(1, 1) + little_endian(0x0200, 2);
    device += Bytes(3, '\0') + little_endian(64, 1) + little_endian(id.vendor, 2);
    device += little_endian(id.product, 2) + little_endian(id.release, 2);
    device += little_endian(1, 1) + little_endian(2, 1);
    device += little_endian(id.serial.empty() ? 0 : 3, 1) + little_endian(1, 1);
    const size_t total = 9 + 9 + 7 * id.endpoints.size();
    Bytes configuration = little_endian(9, 1) + little_endian(2, 1) + little_endian(total, 2);
    configuration += little_endian(1, 1) + little_endian(1, 1) + little_endian(0, 1);
    configuration += little_endian(0x80, 1) + little_endian(250, 1);
    configuration += little_endian(9, 1) + little_endian(4, 1) + Bytes(2, '\0');
    configuration += little_endian(id.endpoints.size(), 1) + little_endian(id.interface_class, 1);
    configuration += little_endian(id.subclass, 1) + little_endian(id.protocol, 1) + Bytes(1, '\0');
    for (const Endpoint& endpoint : id.endpoints) {
        configuration += little_endian(7, 1) + little_endian(5, 1);
        configuration += little_endian(endpoint.address, 1) + little_endian(2, 1);
        configuration += little_endian(endpoint.packet_size, 2) + Bytes(1, '\0');
    }
    return device + configuration;
}

size_t VirtualDevice::packet_size(uint8_t endpoint) const {
    for (const Endpoint& one : identity_.endpoints) {
        if (one.address == endpoint) return one.packet_size;
    }
    throw std::logic_error("an endpoint that the device does not have");
}

void VirtualDevice::submit(Transfer transfer) {
    if (gone_) {
        transfer.status = -ESHUTDOWN;
        done_.push_back(std::move(transfer));
        return;
    }
    if (transfer.type == TransferType::control) {
        if (suffer(transfer, describe(transfer))) return;
        transfer.status = 0;
        if ((transfer.setup[0] & 0x60) == 0) {
            standard_request(transfer);
        } else if (!control(transfer)) {
            transfer.status = -EPIPE;
        }
        if (transfer.status != 0) transfer.data.clear();
        if (transfer.incoming() && transfer.data.size() > transfer.length) {
            transfer.data.resize(transfer.length);
        }
        done_.push_back(std::move(transfer));
        return;
    }
    const bool known =
        std::any_of(identity_.endpoints.begin(), identity_.endpoints.end(),
                    [&](const Endpoint& e) { return e.address == transfer.endpoint; });
    if (!known || halted_.count(transfer.endpoint) != 0) {
        transfer.status = -EPIPE;
        done_.push_back(std::move(transfer));
        return;
    }
    if (transfer.incoming()) {
        transfer.data.clear();
        waiting_[transfer.endpoint].push_back(std::move(transfer));
        return;
    }
    if (suffer(transfer, describe(transfer))) return;
    receive(transfer.endpoint, transfer.data);
    // A device that does not accept what came halts the endpoint (USBTMC 1.0, section 3.2.2).
    transfer.status = halted_.count(transfer.endpoint) != 0 ? -EPIPE : 0;
    if (gone_) transfer.status = -ESHUTDOWN;
    done_.push_back(std::move(transfer));
}

bool VirtualDevice::suffer(Transfer& transfer, const std::string& what) {
    AnswerShape shape;
    shape.what = what;
    shape.incoming = transfer.incoming();
    const std::optional<PlannedFault> fault = faults_.next(identity_.name, shape);
    if (!fault) return false;
    switch (fault->kind) {
        case FaultKind::stall:
            // A control endpoint forgets its stall with the next setup packet.
            if (transfer.type != TransferType::control) halt(transfer.endpoint);
            transfer.status = -EPIPE;
            break;
        case FaultKind::silence:
            ignored_.push_back(std::move(transfer));
            return true;
        case FaultKind::overflow:
            transfer.status = -EOVERFLOW;
            break;
        case FaultKind::short_data: {
            transfer.status = 0;
            if ((transfer.setup[0] & 0x60) == 0) {
                standard_request(transfer);
            } else if (!control(transfer)) {
                transfer.status = -EPIPE;
            }
            transfer.data.resize(std::min(transfer.data.size(), transfer.length) / 2);
            break;
        }
        case FaultKind::unplug:
            leave_bus(std::nullopt);
            transfer.status = -ESHUTDOWN;
            break;
        case FaultKind::replug:
            leave_bus(fault->milliseconds.value_or(300));
            transfer.status = -ESHUTDOWN;
            break;
        default:
            return false;
    }
    if (transfer.status != 0) transfer.data.clear();
    done_.push_back(std::move(transfer));
    return true;
}

void VirtualDevice::standard_request(Transfer& transfer) {
    // USB 2.0, section 9.4.
    const uint8_t type = transfer.setup[0], request = transfer.setup[1];
    const Bytes all = descriptors();
    const auto& id = identity_;
    const std::array<std::string, 4> strings{"", id.manufacturer, id.product_name, id.serial};
    const int descriptor = transfer.value() >> 8, which = transfer.value() & 0xFF;
    if (request == 6 && descriptor == 1) {
        transfer.data = all.substr(0, 18);
    } else if (request == 6 && descriptor == 2) {
        transfer.data = all.substr(18);
    } else if (request == 6 && descriptor == 3 && which == 0) {
        transfer.data = {4, 3, 9, 4};  // US English
    } else if (request == 6 && descriptor == 3 && which < 4 && !strings[which].empty()) {
        transfer.data = little_endian(2 + 2 * strings[which].size(), 1) + little_endian(3, 1);
        for (const char letter : strings[which]) transfer.data += Bytes{letter, '\0'};
    } else if (request == 0) {
        const bool halted = type == 0x82 && halted_.count(transfer.setup[4]) != 0;
        transfer.data = little_endian(halted ? 1 : 0, 2);
    } else if (request == 8) {
        transfer.data = little_endian(1, 1);
    } else if (request == 1 && type == 2) {
        clear_halt(transfer.setup[4]);
    } else if (request != 9 && request != 11 && request != 3 && request != 1) {
        transfer.status = -EPIPE;
    }
}

bool VirtualDevice::cancel(uint64_t cookie) {
    const auto take = [&](std::deque<Transfer>& from) {
        for (auto it = from.begin(); it != from.end(); ++it) {
            if (it->cookie != cookie) continue;
            it->status = -ENOENT;
            if (!it->incoming()) it->data.clear();
            done_.push_back(std::move(*it));
            from.erase(it);
            return true;
        }
        return false;
    };
    if (take(ignored_)) return true;
    for (auto& endpoint : waiting_) {
        if (take(endpoint.second)) return true;
    }
    return false;
}

std::optional<Transfer> VirtualDevice::reap() {
    pump();
    if (done_.empty()) return std::nullopt;
    Transfer first = std::move(done_.front());
    done_.pop_front();
    return first;
}

void VirtualDevice::forget(uint64_t cookie) {
    const auto drop = [&](std::deque<Transfer>& from) {
        std::erase_if(from, [&](const Transfer& one) { return one.cookie == cookie; });
    };
    drop(done_);
    drop(ignored_);
    for (auto& endpoint : waiting_) drop(endpoint.second);
}

void VirtualDevice::pump() {
    if (gone_) return;
    const Instant now = Clock::now();
    for (auto& [endpoint, transfers] : waiting_) {
        while (!transfers.empty()) {
            Transfer& transfer = transfers.front();
            bool finished = false;
            if (halted_.count(endpoint) != 0) {
                transfer.status = -EPIPE;
                finished = true;
            }
            while (!finished) {
                std::optional<Packet> packet = next_packet(endpoint, now);
                if (!packet) break;
                const size_t room = transfer.length - transfer.data.size();
                if (packet->babble || packet->data.size() > room) {
                    transfer.data += packet->data.substr(0, room);
                    transfer.status = -EOVERFLOW;
                    finished = true;
                    break;
                }
                transfer.data += packet->data;
                finished = packet->data.size() < packet_size(endpoint) ||
                           transfer.data.size() == transfer.length;
            }
            if (!finished) break;
            done_.push_back(std::move(transfer));
            transfers.pop_front();
        }
    }
}

std::optional<VirtualDevice::Packet> VirtualDevice::next_packet(uint8_t endpoint, Instant now) {
    std::deque<Packet>& queue = queued_[endpoint];
    if (queue.empty() || queue.front().due > now) return std::nullopt;
    Packet packet = std::move(queue.front());
    queue.pop_front();
    return packet;
}

std::optional<VirtualDevice::Prepared> VirtualDevice::prepare(uint8_t endpoint, Bytes message,
                                                              const AnswerShape& shape) {
    if (gone_) return std::nullopt;
    Prepared prepared;
    const std::optional<PlannedFault> fault = faults_.next(identity_.name, shape);
    if (fault) {
        switch (fault->kind) {
            case FaultKind::stall:
                halt(endpoint);
                return std::nullopt;
            case FaultKind::silence:
                return std::nullopt;
            case FaultKind::short_data:
                message.resize(message.size() / 2);
                break;
            case FaultKind::lost_sync:
                if (shape.serial_line) {
                    message.erase(static_cast<size_t>(shape.sync_at), 1);
                } else {
                    message[static_cast<size_t>(shape.sync_at)] ^= 0x55;
                }
                break;
            case FaultKind::checksum:
                message[static_cast<size_t>(shape.checksum_at)] ^= 0x10;
                break;
            case FaultKind::overflow:
                prepared.babble = true;
                break;
            case FaultKind::saturation:
                shape.saturate(message);
                break;
            case FaultKind::unplug:
                leave_bus(std::nullopt);
                return std::nullopt;
            case FaultKind::replug:
                leave_bus(fault->milliseconds.value_or(300));
                return std::nullopt;
            default:
                break;  // of mounts, which asked before they moved
        }
    }
    prepared.bytes = std::move(message);
    return prepared;
}

bool VirtualDevice::send(uint8_t endpoint, const Bytes& message, const AnswerShape& shape,
                         Instant due, bool zero_length) {
    const std::optional<Prepared> prepared = prepare(endpoint, message, shape);
    if (!prepared) return false;
    const size_t size = packet_size(endpoint), total = prepared->bytes.size();
    std::deque<Packet>& queue = queued_[endpoint];
    for (size_t first = 0; first < total; first += size) {
        queue.push_back({prepared->bytes.substr(first, size), due, false});
    }
    // A message that a fault cut to whole packets ends like any other.
    if ((zero_length && total % size == 0) || total == 0) queue.push_back({{}, due, false});
    if (prepared->babble) queue.back().babble = true;
    return true;
}

void VirtualDevice::reset() {
    halted_.clear();
    queued_.clear();
    power_on();
}

void VirtualDevice::unplug() {
    leave_bus(std::nullopt);
}

void VirtualDevice::leave_bus(std::optional<int> milliseconds) {
    if (gone_) return;
    gone_ = true;
    halted_.clear();
    queued_.clear();
    for (auto& endpoint : waiting_) {
        for (Transfer& transfer : endpoint.second) ignored_.push_back(std::move(transfer));
        endpoint.second.clear();
    }
    for (Transfer& transfer : ignored_) {
        transfer.status = -ESHUTDOWN;
        done_.push_back(std::move(transfer));
    }
    ignored_.clear();
    if (on_unplug) on_unplug(milliseconds);
}

void VirtualDevice::plug_in() {
    gone_ = false;
    power_on();
}

}  // namespace drude::usb_bench
