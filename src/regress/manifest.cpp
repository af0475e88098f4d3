#include "regress/manifest.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "materials/json_tree.h"

namespace drude {

namespace {

constexpr std::string_view format_name = "drude-references/1";

double fraction(const JsonValue& value) {
    const double number = value.number();
    if (!(number > 0 && number < 1)) {
        user_error_at(value.place(), "{} is {}; expected more than 0 and less than 1",
                      value.shown(), number);
    }
    return number;
}

std::string file_word(const JsonValue& value) {
    std::string text = value.string();
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_' || c == '.';
    };
    if (text.empty() || text[0] == '.' || text[0] == '-' ||
        !std::all_of(text.begin(), text.end(), fits)) {
        user_error_at(value.place(),
                      "{} is '{}'; expected letters, digits, '-', '_' and '.', for it is a file's "
                      "name",
                      value.shown(), text);
    }
    return text;
}

ReferenceCase read_case(const JsonValue& object) {
    object.allow_keys({"name", "scene", "purpose", "samples", "seed", "reference_samples",
                       "reference_seed", "largest_bias", "wavelengths", "transport", "resolution",
                       "history"});
    // Two batches of 16: with fewer samples a batch is smaller, and the noise test cannot take the
    // batches of both pictures for alike.
    constexpr double fewest_samples = 32, most_samples = 1 << 24, largest_seed = 9007199254740992.0;
    ReferenceCase one;
    one.name = file_word(object.at("name"));
    one.scene = object.at("scene").string();
    one.purpose = object.at("purpose").string();
    one.samples = static_cast<int>(object.at("samples").whole_number(fewest_samples, most_samples));
    one.reference_samples =
        static_cast<int>(object.at("reference_samples").whole_number(fewest_samples, most_samples));
    one.seed = static_cast<uint64_t>(object.at("seed").whole_number(0, largest_seed));
    one.reference_seed =
        static_cast<uint64_t>(object.at("reference_seed").whole_number(0, largest_seed));
    if (one.seed == one.reference_seed) {
        user_error_at(object.at("seed").place(),
                      "'{}': seed and reference_seed are both {}; the noise of the two pictures "
                      "must be independent",
                      one.name, one.seed);
    }
    one.largest_bias = fraction(object.at("largest_bias"));
    if (object.has("wavelengths")) {
        one.wavelengths = static_cast<int>(object.at("wavelengths").whole_number(0, 40));
    }
    if (object.has("transport")) {
        const JsonValue transport = object.at("transport");
        const std::string word = transport.string();
        if (word != "stokes" && word != "auto") {
            user_error_at(transport.place(), "'transport' is '{}', expected 'stokes' or 'auto'{}",
                          word, did_you_mean(word, {"stokes", "auto"}));
        }
        one.stokes = word == "stokes";
    }
    if (object.has("resolution")) one.resolution = object.at("resolution").string();
    if (object.has("history")) {
        for (const JsonValue& entry : object.at("history").array()) {
            entry.allow_keys({"date", "version", "why"});
            one.history.push_back({entry.at("date").string(), entry.at("version").string(),
                                   entry.at("why").string()});
        }
    }
    return one;
}

}  // namespace

std::string ReferenceManifest::scene_path(const ReferenceCase& one) const {
    return std::filesystem::path(folder + "/" + one.scene).lexically_normal().string();
}

ReferenceManifest read_manifest(const std::string& folder) {
    ReferenceManifest manifest;
    manifest.folder = folder;
    while (manifest.folder.size() > 1 && manifest.folder.back() == '/') manifest.folder.pop_back();
    const JsonDocument document = parse_json_tree(read_file(manifest.path()), manifest.path());
    const JsonValue root(document);
    const JsonValue format = root.at("format");
    if (format.string() != format_name) {
        user_error_at(format.place(), "'format' is '{}', expected '{}', the one this version reads",
                      format.string(), format_name);
    }
    root.allow_keys({"format", "alpha", "cases"});
    manifest.alpha = fraction(root.at("alpha"));
    std::set<std::string> names;
    for (const JsonValue& object : root.at("cases").array()) {
        manifest.cases.push_back(read_case(object));
        if (!names.insert(manifest.cases.back().name).second) {
            user_error_at(object.at("name").place(), "the name '{}' is used twice",
                          manifest.cases.back().name);
        }
    }
    if (manifest.cases.empty()) {
        user_error_at(root.at("cases").place(), "no case; expected at least one");
    }
    return manifest;
}

void write_manifest(const ReferenceManifest& manifest) {
    nlohmann::ordered_json root;
    root["format"] = format_name;
    root["alpha"] = manifest.alpha;
    root["cases"] = nlohmann::ordered_json::array();
    for (const ReferenceCase& one : manifest.cases) {
        nlohmann::ordered_json object = {{"name", one.name},
                                         {"scene", one.scene},
                                         {"purpose", one.purpose},
                                         {"samples", one.samples},
                                         {"seed", one.seed},
                                         {"reference_samples", one.reference_samples},
                                         {"reference_seed", one.reference_seed},
                                         {"largest_bias", one.largest_bias}};
        if (one.wavelengths != 0) object["wavelengths"] = one.wavelengths;
        if (!one.stokes) object["transport"] = "auto";
        if (!one.resolution.empty()) object["resolution"] = one.resolution;
        if (!one.history.empty()) object["history"] = nlohmann::ordered_json::array();
        for (const ReferenceUpdate& update : one.history) {
            object["history"].push_back(
                {{"date", update.date}, {"version", update.version}, {"why", update.why}});
        }
        root["cases"].push_back(std::move(object));
    }
    // Bytes that are no UTF-8 in a reason are replaced rather than refused.
    write_file(manifest.path(),
               root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace drude
