#include "device/sweep/journal_header.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "materials/json_tree.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view format_name = "drude-journal/1";

ordered_json spectrometer_json(const SpectrometerInfo& info) {
    return {{"uri", info.uri},
            {"model", info.model},
            {"serial", info.serial},
            {"wavelength_nm", info.wavelength_nm},
            {"max_counts", info.max_counts},
            {"shortest_s", info.shortest_s},
            {"longest_s", info.longest_s},
            {"readout_s", info.readout_s},
            {"nonlinearity", info.nonlinearity},
            {"dark_first", info.dark_first},
            {"dark_count", info.dark_count},
            {"has_lamp_control", info.has_lamp_control},
            {"warnings", info.warnings}};
}

double bounded(const JsonValue& value, double low, double high) {
    const double number = value.number();
    if (!(number >= low && number <= high)) {
        user_error_at(value.place(), "{} is {}, expected {} to {}", value.shown(), number, low,
                      high);
    }
    return number;
}

SpectrometerInfo read_spectrometer(const JsonValue& object) {
    object.allow_keys({"uri", "model", "serial", "wavelength_nm", "max_counts", "shortest_s",
                       "longest_s", "readout_s", "nonlinearity", "dark_first", "dark_count",
                       "has_lamp_control", "warnings"});
    SpectrometerInfo info;
    info.uri = object.at("uri").string();
    info.model = object.at("model").string();
    info.serial = object.at("serial").string();
    const JsonValue wavelengths = object.at("wavelength_nm");
    info.wavelength_nm = wavelengths.numbers();
    const auto& nm = info.wavelength_nm;
    const bool rising =
        std::adjacent_find(nm.begin(), nm.end(), std::greater_equal<double>()) == nm.end();
    if (nm.empty() || !rising || !(nm.front() > 0)) {
        user_error_at(wavelengths.place(), "{} does not rise from above 0, expected wavelengths",
                      wavelengths.shown());
    }
    info.max_counts = static_cast<uint32_t>(bounded(object.at("max_counts"), 1, 4294967295.0));
    info.shortest_s = bounded(object.at("shortest_s"), 0, 1e6);
    info.longest_s = bounded(object.at("longest_s"), 0, 1e6);
    info.readout_s = bounded(object.at("readout_s"), 0, 1e6);
    info.nonlinearity = object.at("nonlinearity").numbers();
    info.dark_first = static_cast<int>(bounded(object.at("dark_first"), 0, 1e6));
    info.dark_count = static_cast<int>(bounded(object.at("dark_count"), 0, 1e6));
    info.has_lamp_control = object.at("has_lamp_control").boolean();
    info.warnings = object.at("warnings").strings();
    return info;
}

}  // namespace

std::string format_journal_header(const JournalHeader& header) {
    ordered_json notes = ordered_json::array();
    for (const auto& [key, value] : header.notes) notes.push_back({key, value});
    ordered_json json = {{"format", format_name},
                         {"software", header.software},
                         {"started", header.started},
                         {"recipe", format_recipe(header.recipe)},
                         {"bench_name", header.bench_name},
                         {"bench", header.bench_description},
                         {"virtual", header.is_virtual},
                         {"notes", notes},
                         {"warnings", header.warnings},
                         {"mount_repeatability_deg", header.mount_repeatability_deg},
                         {"analyser_repeatability_deg", header.analyser_repeatability_deg}};
    if (header.has_spectrometer) {
        json["spectrometer"] = spectrometer_json(header.spectrometer);
    } else {
        json["head"] = header.head_identity;
    }
    return json.dump(1, ' ', false, ordered_json::error_handler_t::replace);
}

JournalHeader parse_journal_header(const std::string& text, const std::string& where) {
    const JsonDocument document = parse_json_tree(text, where);
    const JsonValue root(document);
    root.allow_keys({"format", "software", "started", "recipe", "bench_name", "bench", "virtual",
                     "notes", "warnings", "mount_repeatability_deg", "analyser_repeatability_deg",
                     "spectrometer", "head"});
    const JsonValue format = root.at("format");
    if (format.string() != format_name) {
        user_error_at(format.place(), "{} is '{}', expected '{}'", format.shown(), format.string(),
                      format_name);
    }
    JournalHeader header;
    header.software = root.at("software").string();
    header.started = root.at("started").string();
    header.recipe = parse_recipe(root.at("recipe").string(), where + ", its recipe");
    header.bench_name = root.at("bench_name").string();
    header.bench_description = root.at("bench").string();
    header.is_virtual = root.at("virtual").boolean();
    for (const JsonValue& note : root.at("notes").array()) {
        const std::vector<std::string> words = note.strings();
        if (words.size() != 2) {
            user_error_at(note.place(), "{} has {} words, expected a key and a value", note.shown(),
                          words.size());
        }
        header.notes.emplace_back(words[0], words[1]);
    }
    header.warnings = root.at("warnings").strings();
    header.mount_repeatability_deg = bounded(root.at("mount_repeatability_deg"), 0, 90);
    header.analyser_repeatability_deg = bounded(root.at("analyser_repeatability_deg"), 0, 90);
    header.has_spectrometer = root.has("spectrometer");
    if (header.has_spectrometer) {
        header.spectrometer = read_spectrometer(root.at("spectrometer"));
    } else {
        header.head_identity = root.at("head").string();
    }
    return header;
}

}  // namespace drude
