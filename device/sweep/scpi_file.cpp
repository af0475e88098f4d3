#include "device/sweep/scpi_file.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"

namespace drude {

namespace {

struct TextKey {
    const char* name;
    std::string ScpiCommands::*member;
    bool takes_value;  // {} stands in it
    bool may_be_empty;
};

const std::vector<TextKey>& text_keys() {
    static const std::vector<TextKey> keys = {
        {"identity", &ScpiCommands::identity, false, false},
        {"clear_status", &ScpiCommands::clear_status, false, true},
        {"next_error", &ScpiCommands::next_error, false, true},
        {"done", &ScpiCommands::done, false, true},
        {"wavelengths", &ScpiCommands::wavelengths, false, false},
        {"angle", &ScpiCommands::angle, true, false},
        {"psi_delta", &ScpiCommands::psi_delta, false, false},
        {"integration", &ScpiCommands::integration, true, false},
        {"spectrum", &ScpiCommands::spectrum, false, false},
        {"lamp", &ScpiCommands::lamp, true, true},
    };
    return keys;
}

struct TimeKey {
    const char* name;
    double ScpiCommands::*member;
};
constexpr TimeKey time_keys[] = {
    {"move_s", &ScpiCommands::move_s},
    {"measure_s", &ScpiCommands::measure_s},
    {"shortest_s", &ScpiCommands::shortest_s},
    {"longest_s", &ScpiCommands::longest_s},
};
constexpr double longest_time_s = 86400;
constexpr double largest_count = 4294967295.0;

// A line break in it would be the end of one message and the beginning of another.
void check_command(const JsonValue& value, const std::string& text) {
    const auto printable = [](char c) { return c >= 32 && c < 127; };
    if (!std::all_of(text.begin(), text.end(), printable)) {
        user_error_at(value.place(), "{} is '{}', expected printable ASCII on one line",
                      value.shown(), text);
    }
}

std::string read_command(const JsonValue& value, const TextKey& key) {
    std::string text = value.string();
    check_command(value, text);
    if (text.empty()) {
        if (key.may_be_empty) return text;
        user_error_at(value.place(), "{} is empty, expected a command of the instrument",
                      value.shown());
    }
    const size_t first = text.find("{}");
    const bool takes = first != std::string::npos;
    if (takes != key.takes_value || (takes && text.find("{}", first + 2) != std::string::npos)) {
        user_error_at(
            value.place(), "{} is '{}', expected a command {}", value.shown(), text,
            key.takes_value ? "with {} once, where its value goes" : "without {}: it has no value");
    }
    return text;
}

ScpiFormat read_format(const JsonValue& value) {
    const std::vector<std::string> names = {"ascii", "real32", "real64"};
    const std::string name = value.string();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        user_error_at(value.place(), "{} is '{}'{}, expected ascii, real32 or real64",
                      value.shown(), name, did_you_mean(name, names));
    }
    return static_cast<ScpiFormat>(found - names.begin());
}

}  // namespace

ScpiCommands read_scpi_commands(const JsonValue& object) {
    std::vector<std::string> allowed = {"setup", "format", "swapped", "max_counts"};
    for (const TextKey& key : text_keys()) allowed.emplace_back(key.name);
    for (const TimeKey& key : time_keys) allowed.emplace_back(key.name);
    object.allow_keys(allowed);
    ScpiCommands commands;
    for (const TextKey& key : text_keys()) {
        if (object.has(key.name)) commands.*key.member = read_command(object.at(key.name), key);
    }
    for (const TimeKey& key : time_keys) {
        if (!object.has(key.name)) continue;
        const JsonValue value = object.at(key.name);
        const double seconds = value.number();
        if (!(seconds > 0 && seconds <= longest_time_s)) {
            user_error_at(value.place(), "{} is {}, expected seconds above 0 and up to {}",
                          value.shown(), seconds, longest_time_s);
        }
        commands.*key.member = seconds;
    }
    if (commands.shortest_s > commands.longest_s) {
        user_error_at(object.place(), "{}: found shortest_s = {} above longest_s = {}",
                      object.shown(), commands.shortest_s, commands.longest_s);
    }
    if (object.has("setup")) {
        const JsonValue setup = object.at("setup");
        commands.setup = setup.strings();
        for (const std::string& line : commands.setup) check_command(setup, line);
    }
    if (object.has("format")) commands.format = read_format(object.at("format"));
    if (object.has("swapped")) commands.swapped = object.at("swapped").boolean();
    if (object.has("max_counts")) {
        commands.max_counts =
            static_cast<uint32_t>(object.at("max_counts").whole_number(1, largest_count));
    }
    return commands;
}

}  // namespace drude
