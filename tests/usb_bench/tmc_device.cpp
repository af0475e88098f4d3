#include "usb_bench/tmc_device.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"

namespace drude::usb_bench {

namespace {

constexpr uint8_t bulk_out = 0x02, bulk_in = 0x81;
constexpr size_t header = 12, largest_response = 65536;
constexpr char success = '\x01', not_in_progress = '\x81';

Identity identity_of(const std::string& serial) {
    Identity id;
    id.name = "usbtmc:" + serial;
    // The numbers that pid.codes keeps for tests.
    id.vendor = 0x1209;
    id.product = 0x5E11;
    id.interface_class = 0xFE;
    id.subclass = 3;
    id.protocol = 1;
    id.endpoints = {{bulk_out, 512}, {bulk_in, 512}};
    id.manufacturer = "Virtual";
    id.product_name = "Virtual ellipsometer head";
    id.serial = serial;
    id.kernel_driver = "usbtmc";
    return id;
}

std::vector<double> wavelengths() {
    return parse_grid("380:780:10", "wavelengths");
}

}  // namespace

TmcDevice::TmcDevice(const std::string& serial, Material sample, FaultPlan& faults)
    : VirtualDevice(identity_of(serial), faults), sample_(std::move(sample)) {}

void TmcDevice::power_on() {
    forget_messages();
    errors_.clear();
    angle_deg_ = 70;
}

void TmcDevice::forget_messages() {
    message_.clear();
    response_.clear();
    requested_ = false;
    drop_queued(bulk_in);
}

std::string TmcDevice::describe(const Transfer& transfer) const {
    if (transfer.type == TransferType::control) {
        if ((transfer.setup[0] & 0x60) == 0) return "standard request";
        return fmt::format("class request {}", transfer.setup[1]);
    }
    if (transfer.data.size() < header) return "part of a header";
    if (transfer.data[0] == 2) return "request for an answer";
    std::string text = transfer.data.substr(header);
    while (!text.empty() && (text.back() == '\0' || text.back() == '\n')) text.pop_back();
    return fmt::format("message '{}'", text);
}

bool TmcDevice::control(Transfer& transfer) {
    const uint8_t type = transfer.setup[0], request = transfer.setup[1];
    const bool of_interface = type == 0xA1, of_endpoint = type == 0xA2;
    const auto tag = static_cast<uint8_t>(transfer.value());
    if (of_interface && request == 7) {
        // Capabilities: USBTMC 1.00; USB488 1.00; 488.2, REN and triggers; SCPI.
        transfer.data = Bytes(24, '\0');
        transfer.data[0] = success;
        transfer.data[3] = transfer.data[13] = 1;
        transfer.data[14] = 4;
        transfer.data[15] = 8;
        return true;
    }
    if (of_interface && request == 5) {
        forget_messages();
        transfer.data = {success};
        return true;
    }
    if (of_interface && request == 6) {
        transfer.data = {success, '\0'};
        return true;
    }
    if (of_interface && request == 128) {
        const char status = response_.empty() ? '\0' : '\x10';
        transfer.data = {success, static_cast<char>(tag), status};
        return true;
    }
    if (of_interface && request >= 160 && request <= 162) {
        transfer.data = {success};
        return true;
    }
    if (of_endpoint && request == 1) {
        // A transfer that was taken whole is in progress no more; the message begun is forgotten.
        const bool begun = !message_.empty() && out_tag_ == tag;
        message_.clear();
        transfer.data = {begun ? success : not_in_progress, static_cast<char>(out_tag_)};
        if (begun) halt(bulk_out);
        return true;
    }
    if (of_endpoint && request == 3) {
        const bool open = requested_ && tag_ == tag;
        transfer.data = {open ? success : not_in_progress, static_cast<char>(tag_)};
        if (open) {
            requested_ = false;
            // The end of the transfer that the host waits for.
            AnswerShape shape;
            shape.what = "end of an aborted transfer";
            drop_queued(bulk_in);
            send(bulk_in, {}, shape, Clock::now());
        }
        return true;
    }
    if (of_endpoint && (request == 2 || request == 4)) {
        transfer.data = Bytes(8, '\0');
        transfer.data[0] = success;
        return true;
    }
    return false;
}

void TmcDevice::receive(uint8_t endpoint, const Bytes& data) {
    if (endpoint != bulk_out || data.size() < header || data[1] == 0 ||
        byte_at(data, 1) != static_cast<uint8_t>(~byte_at(data, 2))) {
        halt(endpoint);
        return;
    }
    const auto size = static_cast<uint32_t>(read_little_endian(data, 4, 4));
    if (data[0] == 1 && data.size() % 4 == 0 && size <= data.size() - header && size > 0) {
        out_tag_ = byte_at(data, 1);
        message_ += data.substr(header, size);
        if ((data[8] & 1) == 0) return;
        execute(std::exchange(message_, {}));
    } else if (data[0] == 2 && data.size() == header && size > 0) {
        tag_ = byte_at(data, 1);
        wanted_ = size;
        requested_ = true;
        answer_request();
    } else {
        halt(endpoint);
    }
}

void TmcDevice::execute(std::string command) {
    while (!command.empty() && (command.back() == '\n' || command.back() == '\r')) {
        command.pop_back();
    }
    // A new message ends the answer to the one before (IEEE 488.2, 6.3.2.3: query interrupted).
    if (!response_.empty()) errors_.push_back("-410,\"Query INTERRUPTED\"");
    response_.clear();
    if (!command.empty() && command.back() == '?') {
        response_ = query(command);
        if (!response_.empty()) response_ += '\n';
    } else if (command == "*CLS") {
        errors_.clear();
    } else if (command.rfind("SOUR:ANG ", 0) == 0) {
        const auto angle = parse_double(command.substr(9));
        if (angle && *angle > 0 && *angle < 90) {
            angle_deg_ = *angle;
        } else {
            errors_.push_back("-222,\"Data out of range\"");
        }
    } else {
        errors_.push_back("-113,\"Undefined header\"");
    }
    answer_request();
}

std::string TmcDevice::query(const std::string& command) {
    if (command == "*IDN?") {
        return fmt::format("Virtual,ELLIPSO-1,{},0.1", identity().serial);
    }
    if (command == "*OPC?") return "1";
    if (command == "SYST:ERR?") {
        if (errors_.empty()) return "0,\"No error\"";
        const std::string first = errors_.front();
        errors_.pop_front();
        return first;
    }
    if (command == "SENS:WAV?") {
        std::vector<std::string> all;
        for (const double nm : wavelengths()) all.push_back(format_double(nm));
        return fmt::format("{}", fmt::join(all, ","));
    }
    if (command == "MEAS:PSID?") return measure();
    errors_.push_back("-113,\"Undefined header\"");
    return "";
}

std::string TmcDevice::measure() const {
    const Measurement truth =
        simulate_ellipsometer(sample_, {{angle_deg_}, wavelengths(), 0, 0, 1});
    std::vector<std::string> numbers;
    for (const MeasurementRow& row : truth.rows) {
        for (const double value : {row.wavelength_nm, row.psi_deg, row.delta_deg}) {
            numbers.push_back(format_double(value));
        }
    }
    return fmt::format("{}", fmt::join(numbers, ","));
}

void TmcDevice::answer_request() {
    if (!requested_ || response_.empty()) return;
    const auto size = std::min<size_t>({wanted_, response_.size(), largest_response});
    const bool end = size == response_.size();
    Bytes bytes{'\x02', static_cast<char>(tag_), static_cast<char>(~tag_), '\0'};
    bytes += little_endian(size, 4) + little_endian(end ? 1 : 0, 4) + response_.substr(0, size);
    while (bytes.size() % 4 != 0) bytes += '\0';
    AnswerShape shape;
    shape.what = fmt::format("{} bytes", size);
    shape.sync_at = 1;
    response_.erase(0, size);
    // An answer that gets lost leaves its request open, as in an instrument that hangs.
    if (send(bulk_in, bytes, shape, Clock::now(), true)) requested_ = false;
}

}  // namespace drude::usb_bench
