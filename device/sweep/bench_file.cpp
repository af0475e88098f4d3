#include "device/sweep/bench_file.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "device/sweep/scpi_file.h"
#include "materials/json_tree.h"

namespace drude {

namespace {

constexpr std::string_view format_name = "drude-bench/1";

bool is_object(const JsonValue& value) {
    try {
        value.has("");
        return true;
    } catch (const Error&) {
        return false;
    }
}

double finite_angle(const JsonValue& value) {
    const double degrees = value.number();
    if (!(std::abs(degrees) <= 360)) {
        user_error_at(value.place(), "{} is {}, expected an angle from -360 to 360 degrees",
                      value.shown(), degrees);
    }
    return degrees;
}

// The word "manual".
void expect_manual(const JsonValue& value, const char* otherwise) {
    if (value.string() == "manual") return;
    user_error_at(value.place(), "{} is '{}', expected \"manual\" or {}", value.shown(),
                  value.string(), otherwise);
}

AxisSetting read_rotator(const JsonValue& object) {
    object.allow_keys({"rotator", "zero_deg", "direction"});
    AxisSetting axis;
    axis.rotator = object.at("rotator").string();
    if (object.has("zero_deg")) axis.zero_deg = finite_angle(object.at("zero_deg"));
    if (object.has("direction")) {
        const JsonValue direction = object.at("direction");
        if (std::abs(direction.number()) != 1) {
            user_error_at(direction.place(), "{} is {}, expected 1 or -1", direction.shown(),
                          direction.number());
        }
        axis.direction = static_cast<int>(direction.number());
    }
    return axis;
}

AxisSetting read_analyser(const JsonValue& object) {
    if (!object.has("fixed_deg")) return read_rotator(object);
    object.allow_keys({"fixed_deg"});
    AxisSetting axis;
    axis.fixed_deg = finite_angle(object.at("fixed_deg"));
    return axis;
}

void read_retarder(const JsonValue& value, BenchFile* file) {
    file->has_retarder = true;
    if (!is_object(value)) return expect_manual(value, "an object with a \"rotator\"");
    value.allow_keys({"rotator", "in_deg", "out_deg"});
    file->retarder_rotator = value.at("rotator").string();
    if (value.has("in_deg")) file->retarder_in_deg = finite_angle(value.at("in_deg"));
    if (value.has("out_deg")) file->retarder_out_deg = finite_angle(value.at("out_deg"));
    if (file->retarder_in_deg == file->retarder_out_deg) {
        user_error_at(value.place(), "{} is in and out of the beam at the same angle, {} degrees",
                      value.shown(), file->retarder_in_deg);
    }
}

void read_goniometer(const JsonValue& value, BenchFile* file) {
    if (!is_object(value)) {
        expect_manual(value, "an object with \"sample\" and \"arm\", or with \"fixed_deg\"");
        file->arms = BenchFile::Arms::manual;
        return;
    }
    if (value.has("fixed_deg")) {
        value.allow_keys({"fixed_deg"});
        const JsonValue angle = value.at("fixed_deg");
        file->fixed_incidence_deg = angle.number();
        if (!(file->fixed_incidence_deg > 0 && file->fixed_incidence_deg < 90)) {
            user_error_at(angle.place(),
                          "{} is {}, expected an angle of incidence above 0 and below 90",
                          angle.shown(), file->fixed_incidence_deg);
        }
        file->arms = BenchFile::Arms::fixed;
        return;
    }
    value.allow_keys({"sample", "arm", "fixed_deg"});
    file->sample_stage = read_rotator(value.at("sample"));
    file->detector_arm = read_rotator(value.at("arm"));
    file->arms = BenchFile::Arms::motors;
}

void read_virtual(const JsonValue& value, const std::string& text, BenchFile* file) {
    value.allow_keys({"material", "settings"});
    file->virtual_material = value.at("material").string();
    if (!value.has("settings")) return;
    // The text was read once; this gives the one object as a text of its own.
    const std::string settings = nlohmann::json::parse(text)["virtual"]["settings"].dump();
    file->virtual_settings =
        parse_virtual_bench_settings(settings, file->path + ", 'virtual.settings'");
}

void read_scpi(const JsonValue& root, const std::string& instrument, const std::string& text,
               BenchFile* file) {
    if (!root.has("scpi")) return;
    const JsonValue value = root.at("scpi");
    if (!instrument.starts_with("usbtmc:")) {
        user_error_at(value.place(), "{} is for instruments of the scheme usbtmc:, found {}",
                      value.shown(), instrument);
    }
    file->scpi = read_scpi_commands(value);
    file->scpi_json = nlohmann::json::parse(text)["scpi"].dump();
}

void check_distinct(const BenchFile& file) {
    std::set<std::string> used;
    for (const std::string& uri :
         {file.polariser.rotator, file.analyser.rotator, file.retarder_rotator,
          file.sample_stage.rotator, file.detector_arm.rotator}) {
        if (!uri.empty() && !used.insert(uri).second) {
            user_error("{}: the mount {} plays two parts, expected one mount for each", file.path,
                       uri);
        }
    }
}

}  // namespace

BenchFile parse_bench_file(const std::string& json, const std::string& path) {
    const JsonDocument document = parse_json_tree(json, path);
    const JsonValue root(document);
    const std::vector<std::string> keys = {"format",      "name",     "spectrometer", "polariser",
                                           "analyser",    "retarder", "goniometer",   "head",
                                           "calibration", "virtual",  "scpi"};
    // First the format: the keys of another kind of file are nobody's spelling mistakes.
    const JsonValue format = root.at("format");
    if (format.string() != format_name) {
        user_error_at(format.place(), "{} is '{}', expected '{}'", format.shown(), format.string(),
                      format_name);
    }
    root.allow_keys(keys);
    BenchFile file;
    file.path = path;
    file.name =
        root.has("name") ? root.at("name").string() : std::filesystem::path(path).stem().string();
    if (root.has("calibration")) {
        const std::filesystem::path named = root.at("calibration").string();
        file.calibration = (std::filesystem::path(path).parent_path() / named).string();
    }
    if (root.has("virtual")) {
        root.allow_keys({"format", "name", "calibration", "virtual"});
        read_virtual(root.at("virtual"), json, &file);
        return file;
    }
    if (root.has("goniometer")) read_goniometer(root.at("goniometer"), &file);
    if (root.has("head")) {
        root.allow_keys({"format", "name", "head", "goniometer", "scpi"});
        file.head = root.at("head").string();
        read_scpi(root, file.head, json, &file);
        check_distinct(file);
        return file;
    }
    if (!root.has("spectrometer")) {
        user_error_at(root.place(),
                      "the bench has no 'spectrometer' (nor a 'head', nor is it 'virtual')");
    }
    file.spectrometer = root.at("spectrometer").string();
    read_scpi(root, file.spectrometer, json, &file);
    file.polariser = read_rotator(root.at("polariser"));
    file.analyser = read_analyser(root.at("analyser"));
    if (root.has("retarder")) read_retarder(root.at("retarder"), &file);
    if (file.arms == BenchFile::Arms::none) {
        user_error_at(root.place(),
                      "the bench has no 'goniometer': \"manual\", {{\"fixed_deg\": 70}}, or the "
                      "mounts of its 'sample' and its 'arm'");
    }
    check_distinct(file);
    return file;
}

}  // namespace drude
