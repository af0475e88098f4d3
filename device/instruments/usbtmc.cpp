#include "device/instruments/usbtmc.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "device/bench_clock.h"
#include "device/device_error.h"

namespace drude {

namespace {

// bmRequestType of class requests: to the interface and to an endpoint, answers to the host.
constexpr uint8_t to_interface = 0xA1, to_endpoint = 0xA2;
constexpr double control_s = 1;
constexpr double check_again_s = 0.01;
// An instrument that keeps answering "nothing yet" is not waited for by asking again.
constexpr int most_empty_parts = 4;

size_t round_up(size_t size, size_t packet) {
    return (size + packet - 1) / packet * packet;
}

}  // namespace

Usbtmc::Usbtmc(std::shared_ptr<UsbPort> port, const UsbtmcOptions& options)
    : port_(std::move(port)), options_(options) {
    for (const auto& entry : port_->endpoints()) {
        const bool in = (entry.first & 0x80) != 0;
        if (entry.second == 2 && in && in_ == 0) in_ = entry.first;
        if (entry.second == 2 && !in && out_ == 0) out_ = entry.first;
        if (entry.second == 3 && in && interrupt_ == 0) interrupt_ = entry.first;
    }
    if (in_ == 0 || out_ == 0 || port_->packet_size(in_) == 0) {
        device_error(Fault::io,
                     "{}: has no pair of bulk endpoints; an instrument of the USBTMC class has one "
                     "each way",
                     name());
    }
    start();
}

std::vector<uint8_t> Usbtmc::request(uint8_t type, uint8_t number, uint16_t value, uint16_t index,
                                     uint16_t length) {
    std::vector<uint8_t> answer =
        port_->control_in({type, number, value, index}, length, deadline_in(control_s));
    if (answer.empty()) {
        device_error(Fault::short_read, "{}: no answer to control request {}", name(), number);
    }
    // Bytes that it leaves out say nothing.
    answer.resize(length);
    return answer;
}

void Usbtmc::start() {
    capabilities_ = parse_usbtmc_capabilities(
        port_->control_in({to_interface, usbtmc::get_capabilities, 0, port_->interface_number()},
                          24, deadline_in(control_s)),
        name());
    if (capabilities_.listen_only || capabilities_.talk_only) {
        device_error(Fault::refused,
                     "{}: says that it only {}; expected an instrument that answers", name(),
                     capabilities_.listen_only ? "listens" : "talks");
    }
    clear();
}

void Usbtmc::write(std::string_view message, Deadline deadline) {
    if (out_of_step_) clear();
    size_t at = 0;
    do {
        const size_t size = std::min<size_t>(options_.transfer, message.size() - at);
        tag_ = next_usbtmc_tag(tag_);
        const bool end = at + size == message.size();
        try {
            port_->write(out_, encode_usbtmc_out(tag_, message.substr(at, size), end), deadline);
        } catch (const DeviceError& error) {
            back_in_step(tag_, false, error.fault());
            throw;
        }
        at += size;
    } while (at < message.size());
}

UsbtmcPart Usbtmc::read_transfer(uint8_t tag, uint32_t size, Deadline deadline) {
    // One byte more than the longest transfer: it always ends with a short or empty packet, never
    // because the buffer is full.
    std::vector<uint8_t> buffer(round_up(usbtmc_header + size + 4, port_->packet_size(in_)));
    size_t received = port_->read(in_, buffer, deadline);
    // The empty packet that ended an earlier transfer.
    if (received == 0) received = port_->read(in_, buffer, deadline);
    return parse_usbtmc_in(std::span<const uint8_t>(buffer).first(received), tag, size, name());
}

std::string Usbtmc::read(Deadline deadline, std::optional<char> terminator) {
    if (terminator && !capabilities_.terminator) {
        device_error(Fault::refused, "{}: cannot end an answer at a character", name());
    }
    if (out_of_step_) clear();
    std::string answer;
    int empty = 0;
    for (;;) {
        tag_ = next_usbtmc_tag(tag_);
        UsbtmcPart part;
        try {
            port_->write(out_, encode_usbtmc_request(tag_, options_.transfer, terminator),
                         deadline);
            part = read_transfer(tag_, options_.transfer, deadline);
            answer += part.data;
            if (part.end || (terminator && part.terminated)) return answer;
            empty = part.data.empty() ? empty + 1 : 0;
            if (answer.size() > options_.largest_answer || empty > most_empty_parts) {
                device_error(Fault::bad_frame, "{}: an answer {}", name(),
                             empty > 0
                                 ? std::string("without data that does not end")
                                 : fmt::format("of more than {} bytes", options_.largest_answer));
            }
        } catch (const DeviceError& error) {
            back_in_step(tag_, true, error.fault());
            throw;
        }
    }
}

std::string Usbtmc::ask(std::string_view message, double seconds) {
    const Deadline deadline = deadline_in(seconds);
    write(message, deadline);
    return read(deadline);
}

// What went wrong first is what the caller reports; where the way back fails too, the next message
// begins with a clear.
void Usbtmc::back_in_step(uint8_t tag, bool in, Fault fault) {
    out_of_step_ = true;
    if (fault == Fault::unplugged) return;
    try {
        if (in) {
            if (fault == Fault::stall) {
                port_->clear_halt(in_);
                port_->clear_halt(out_);
            }
            abort_in(tag);
        } else {
            abort_out(tag);
            port_->clear_halt(out_);
        }
        out_of_step_ = false;
    } catch (const DeviceError&) {
        return;
    }
}

void Usbtmc::drain_in(Deadline deadline) {
    std::vector<uint8_t> buffer(64 * port_->packet_size(in_));
    // Also where it sends faster than it is read.
    while (std::chrono::steady_clock::now() < deadline) {
        try {
            if (port_->read(in_, buffer, deadline) < buffer.size()) return;
        } catch (const DeviceError& error) {
            if (error.fault() == Fault::timeout) return;
            if (error.fault() != Fault::overflow) throw;
        }
    }
}

// USBTMC 1.0, 4.2.1.4 and 4.2.1.5.
void Usbtmc::abort_in(uint8_t tag) {
    const Deadline end = deadline_in(options_.settle_s);
    std::vector<uint8_t> begun = request(to_endpoint, usbtmc::initiate_abort_in, tag, in_, 2);
    if (begun[0] == usbtmc::not_in_progress && begun[1] != tag && begun[1] != 0) {
        // It works on another request than the last one, and says which.
        begun = request(to_endpoint, usbtmc::initiate_abort_in, begun[1], in_, 2);
    }
    if (begun[0] != usbtmc::success) {
        // It knows of no request; what it sent for one is dropped until it is silent.
        port_->drain(in_, 0.05, end);
        return;
    }
    drain_in(std::min(end, deadline_in(control_s)));
    for (;;) {
        const std::vector<uint8_t> status = request(to_endpoint, usbtmc::check_abort_in, 0, in_, 8);
        if (status[0] != usbtmc::pending) {
            if (status[0] == usbtmc::success) return;
            device_error(Fault::refused, "{}: did not give up an answer: {}", name(),
                         usbtmc_status_words(status[0]));
        }
        if (std::chrono::steady_clock::now() >= end) {
            device_error(Fault::timeout, "{}: did not give up an answer in {} s", name(),
                         options_.settle_s);
        }
        if ((status[1] & 1) != 0) {
            drain_in(std::min(end, deadline_in(control_s)));
        } else {
            real_clock().sleep(check_again_s);
        }
    }
}

// USBTMC 1.0, 4.2.1.2 and 4.2.1.3.
void Usbtmc::abort_out(uint8_t tag) {
    const Deadline end = deadline_in(options_.settle_s);
    const std::vector<uint8_t> begun =
        request(to_endpoint, usbtmc::initiate_abort_out, tag, out_, 2);
    if (begun[0] == usbtmc::not_in_progress) return;
    if (begun[0] != usbtmc::success) {
        device_error(Fault::refused, "{}: did not give up a message: {}", name(),
                     usbtmc_status_words(begun[0]));
    }
    for (;;) {
        const std::vector<uint8_t> status =
            request(to_endpoint, usbtmc::check_abort_out, 0, out_, 8);
        if (status[0] == usbtmc::success) return;
        if (status[0] != usbtmc::pending || std::chrono::steady_clock::now() >= end) {
            device_error(Fault::refused, "{}: did not give up a message: {}", name(),
                         usbtmc_status_words(status[0]));
        }
        real_clock().sleep(check_again_s);
    }
}

uint8_t Usbtmc::status_byte() {
    // USB488 1.0, 4.3.1: tags of these requests go from 2 to 127.
    status_tag_ = status_tag_ >= 127 ? uint8_t{2} : static_cast<uint8_t>(status_tag_ + 1);
    const std::vector<uint8_t> answer =
        request(to_interface, usbtmc::read_status_byte, status_tag_, port_->interface_number(), 3);
    if (answer[0] != usbtmc::success) {
        device_error(Fault::refused, "{}: does not tell its status byte: {}", name(),
                     usbtmc_status_words(answer[0]));
    }
    if (answer[1] != status_tag_) {
        device_error(Fault::bad_frame, "{}: a status byte for request {}; expected that for {}",
                     name(), answer[1], status_tag_);
    }
    if (interrupt_ == 0) return answer[2];
    // With an interrupt endpoint the byte comes there, after the tag with bit 7 set; what else
    // comes there are requests for service.
    const Deadline deadline = deadline_in(control_s);
    std::vector<uint8_t> packet(std::max<size_t>(port_->packet_size(interrupt_), 2));
    for (;;) {
        const size_t size = port_->read(interrupt_, packet, deadline);
        if (size >= 2 && packet[0] == (0x80 | status_tag_)) return packet[1];
    }
}

void Usbtmc::clear() {
    const Deadline end = deadline_in(options_.settle_s);
    out_of_step_ = true;
    const uint16_t interface = port_->interface_number();
    const std::vector<uint8_t> begun =
        request(to_interface, usbtmc::initiate_clear, 0, interface, 1);
    if (begun[0] != usbtmc::success) {
        device_error(Fault::refused, "{}: does not clear its buffers: {}", name(),
                     usbtmc_status_words(begun[0]));
    }
    for (;;) {
        const std::vector<uint8_t> status =
            request(to_interface, usbtmc::check_clear, 0, interface, 2);
        if (status[0] == usbtmc::success) break;
        if (status[0] != usbtmc::pending || std::chrono::steady_clock::now() >= end) {
            device_error(Fault::refused, "{}: did not clear its buffers: {}; switch it off and on",
                         name(), usbtmc_status_words(status[0]));
        }
        if ((status[1] & 1) != 0) {
            drain_in(std::min(end, deadline_in(control_s)));
        } else {
            real_clock().sleep(check_again_s);
        }
    }
    port_->clear_halt(out_);
    port_->clear_halt(in_);
    out_of_step_ = false;
}

bool Usbtmc::reopen(double seconds) {
    if (!port_->reopen(seconds)) return false;
    tag_ = 0;
    start();
    return true;
}

}  // namespace drude
