#include "device/instruments/scpi_link.h"

#include <cmath>
#include <utility>

#include "device/device_error.h"

namespace drude {

namespace {

constexpr double short_answer_s = 2;
// SCPI-99, 21.8.1: queues are short, but one that never empties must not be read for ever.
constexpr int most_errors = 32;

std::string without_line_end(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    return text;
}

}  // namespace

std::string scpi_command(const std::string& command, const std::string& value) {
    const size_t at = command.find("{}");
    if (at == std::string::npos) {
        user_error("the SCPI command '{}' has no {{}} where its value goes", command);
    }
    return command.substr(0, at) + value + command.substr(at + 2);
}

ScpiLink::ScpiLink(std::shared_ptr<UsbPort> port, ScpiCommands commands)
    : tmc_(std::move(port)), commands_(std::move(commands)) {
    identity_ = parse_scpi_identity(ask_once(commands_.identity, short_answer_s), name());
    start();
}

std::string ScpiLink::uri() {
    const UsbPort& port = tmc_.port();
    return fmt::format("usbtmc:{:04x}:{:04x}:{}", port.vendor(), port.product(), port.serial());
}

// What was left in the queue by whoever used the instrument before is nobody's error now.
void ScpiLink::start() {
    if (!commands_.clear_status.empty()) {
        tmc_.write(commands_.clear_status + "\n", deadline_in(short_answer_s));
    }
    for (const std::string& line : commands_.setup) command(line, short_answer_s);
}

std::string ScpiLink::ask_once(const std::string& question, double seconds) {
    try {
        return tmc_.ask(question + "\n", seconds);
    } catch (const DeviceError& error) {
        if (error.fault() != Fault::timeout) throw;
        device_error(Fault::timeout, "{}: no answer to '{}' within {} s", name(), question,
                     seconds);
    }
}

void ScpiLink::check_errors(const std::string& about) {
    if (commands_.next_error.empty()) return;
    std::string words;
    for (int count = 0; count < most_errors; ++count) {
        const ScpiError error =
            parse_scpi_error(ask_once(commands_.next_error, short_answer_s), name());
        if (error.code == 0) break;
        if (!words.empty()) words += "; ";
        words += scpi_error_words(error);
    }
    if (!words.empty()) {
        device_error(Fault::refused, "{}: answers to '{}' with error {}", name(), about, words);
    }
}

std::string ScpiLink::ask(const std::string& question, double seconds) {
    const std::string answer = without_line_end(ask_once(question, seconds));
    check_errors(question);
    return answer;
}

std::vector<double> ScpiLink::ask_numbers(const std::string& question, double seconds) {
    // A block of floats may end in a byte that looks like the end of a line.
    const std::string answer = ask_once(question, seconds);
    check_errors(question);
    return parse_scpi_numbers(answer, commands_.format, commands_.swapped, name());
}

void ScpiLink::command(const std::string& text, double seconds) {
    tmc_.write(text + "\n", deadline_in(short_answer_s));
    if (!commands_.done.empty()) {
        const std::string done = ask_once(commands_.done, seconds);
        if (parse_scpi_number(done, name()) != 1) {
            device_error(Fault::bad_frame, "{}: answered '{}' to '{}'; expected 1", name(),
                         without_line_end(done), commands_.done);
        }
    }
    check_errors(text);
}

std::vector<double> ScpiLink::wavelengths() {
    std::vector<double> values = ask_numbers(commands_.wavelengths, short_answer_s);
    for (size_t i = 0; i < values.size(); ++i) {
        const double below = i > 0 ? values[i - 1] : 0;
        if (!std::isfinite(values[i]) || values[i] <= below) {
            device_error(Fault::bad_frame,
                         "{}: wavelength {} of {} is {} nm after {}; expected them to ascend",
                         name(), i + 1, values.size(), values[i], below);
        }
    }
    return values;
}

void ScpiLink::recover() {
    tmc_.clear();
    start();
}

bool ScpiLink::reconnect(double seconds) {
    if (!tmc_.reopen(seconds)) return false;
    const ScpiIdentity now =
        parse_scpi_identity(ask_once(commands_.identity, short_answer_s), name());
    if (now.model != identity_.model || now.serial != identity_.serial) {
        device_error(Fault::refused, "{}: the instrument that came back is {}; expected {}", name(),
                     now.str(), identity_.str());
    }
    start();
    return true;
}

}  // namespace drude
