#include "device/instruments/obp_link.h"

#include <algorithm>

#include "device/device_error.h"
#include "device/instruments/spectrometer_link.h"

namespace drude {

namespace {

constexpr uint16_t deferred = 255;  // an error number that means "still at it"
// For the next part of a message that has begun to come.
constexpr double part_s = 1;

}  // namespace

std::vector<uint8_t> ObpLink::query(uint32_t type, const std::vector<uint8_t>& data,
                                    Deadline deadline) {
    return exchange(type, 0, data, deadline).data;
}

void ObpLink::command(uint32_t type, const std::vector<uint8_t>& data) {
    const ObpMessage reply = exchange(type, obp_ack_request, data, deadline_in(1));
    if ((reply.flags & obp_ack) == 0) {
        device_error(Fault::bad_frame, "{}: message {:06x} was answered but not acknowledged",
                     port_.name(), type);
    }
}

void ObpLink::drain() {
    drain_all(port_, {model_.in});
}

void ObpLink::clear() {
    clear_transport(port_, {model_.out, model_.in});
}

ObpMessage ObpLink::exchange(uint32_t type, uint16_t flags, const std::vector<uint8_t>& data,
                             Deadline deadline) {
    ObpMessage request;
    request.version = model_.second ? 0x2000 : 0x1100;
    request.flags = flags;
    request.type = type;
    request.regarding = ++request_ == 0 ? ++request_ : request_;
    request.data = data;
    port_.write(model_.out, format_obp_message(request), deadline_in(1));
    for (int messages = 0; messages < 64; ++messages) {
        ObpMessage reply = receive(deadline);
        // Some firmware leaves the number of the request out.
        const bool ours =
            reply.type == type && (reply.regarding == request.regarding || reply.regarding == 0);
        if (!ours) continue;
        if ((reply.flags & (obp_nack | obp_exception)) == 0) return reply;
        if (reply.error == deferred) continue;
        device_error(reply.error == 3 ? Fault::bad_frame : Fault::refused,
                     "{}: it refuses message {:06x}: {}", port_.name(), type,
                     obp_error_text(reply.error));
    }
    device_error(Fault::bad_frame, "{}: 64 messages came, and none of them answers {:06x}",
                 port_.name(), type);
}

ObpMessage ObpLink::receive(Deadline deadline) {
    const size_t packet = port_.packet_size(model_.in);
    // One packet first: it says how long the message is. Asking for more than there is would wait
    // where the message fills its packets, asking for less loses the rest of the last one.
    std::vector<uint8_t> bytes(packet);
    size_t count = 0;
    for (int i = 0; i < 8 && count == 0; ++i) count = port_.read(model_.in, bytes, deadline);
    bytes.resize(count);
    const size_t total = obp_message_bytes(bytes, port_.name());
    // High-speed devices may send the first 64 bytes as a short packet, and go on after it.
    while (bytes.size() < total) {
        std::vector<uint8_t> rest(whole_packets(port_, model_.in, total - bytes.size()));
        try {
            rest.resize(port_.read(model_.in, rest, std::min(deadline, deadline_in(part_s))));
        } catch (const DeviceError& error) {
            if (error.fault() != Fault::timeout) throw;
            break;  // parsing says how many bytes are missing
        }
        if (rest.empty()) break;
        bytes.insert(bytes.end(), rest.begin(), rest.end());
    }
    return parse_obp_message(bytes, port_.name());
}

}  // namespace drude
