// VirtualBenchSettings: their bounds, and their JSON.
#include <limits>
#include <type_traits>

#include "base/numbers.h"
#include "device/virtual/virtual_optics.h"
#include "materials/json_tree.h"

namespace drude {

namespace {

constexpr double largest_exact = 9007199254740992;  // 2^53, the whole numbers that JSON keeps

// Every setting with its key and bounds, once for reading, writing and checking. `visit` takes
// (key, value, least, most); bounds are meant for each element of a list.
template <class Settings, class Visit>
void for_each_setting(Settings& s, Visit visit) {
    const double any = std::numeric_limits<double>::max();
    visit("seed", s.seed, 0, largest_exact);
    visit("pixels", s.pixels, 2, 65536);
    visit("first_nm", s.first_nm, 100, 20000);
    visit("last_nm", s.last_nm, 100, 20000);
    visit("max_counts", s.max_counts, 255, 4294967295.0);
    visit("full_scale_s", s.full_scale_s, 1e-6, 1e4);
    visit("electrons_per_count", s.electrons_per_count, 0, any);
    visit("read_noise_counts", s.read_noise_counts, 0, any);
    visit("relative_noise", s.relative_noise, 0, 1);
    visit("dark_counts", s.dark_counts, 0, any);
    visit("dark_counts_per_s", s.dark_counts_per_s, 0, any);
    // Beyond -0.5 more light would read less.
    visit("nonlinearity", s.nonlinearity, -0.4, 0.4);
    visit("reported_nonlinearity", s.reported_nonlinearity, -any, any);
    visit("quantise", s.quantise, 0, 1);
    visit("lamp_temperature_K", s.lamp_temperature_K, 500, 20000);
    visit("source_dop", s.source_dop, 0, 1);
    visit("source_aolp_deg", s.source_aolp_deg, -360, 360);
    visit("drift_per_hour", s.drift_per_hour, -1, 1);
    visit("polariser_extinction", s.polariser_extinction, 0, 1);
    visit("analyser_extinction", s.analyser_extinction, 0, 1);
    visit("polariser_offset_deg", s.polariser_offset_deg, -360, 360);
    visit("analyser_offset_deg", s.analyser_offset_deg, -360, 360);
    visit("retardance_deg", s.retardance_deg, -360, 360);
    visit("retarder_nm", s.retarder_nm, 100, 20000);
    visit("retarder_diattenuation", s.retarder_diattenuation, 0.01, 100);
    visit("eccentricity_deg", s.eccentricity_deg, -45, 45);
    visit("mount_jitter_deg", s.mount_jitter_deg, 0, 45);
    visit("detector_half_angle_deg", s.detector_half_angle_deg, 0.001, 45);
}

void check_bounds(const std::string& where, const char* key, double value, double least,
                  double most) {
    // Not a comparison that NaN passes.
    if (value >= least && value <= most) return;
    if (most == std::numeric_limits<double>::max()) {
        const char* expected = least == 0 ? "a finite number of at least 0" : "a finite number";
        user_error("{}: {} = {}, expected {}", where, key, format_double(value), expected);
    }
    user_error("{}: {} = {}, expected a number from {} to {}", where, key, format_double(value),
               format_double(least), format_double(most));
}

}  // namespace

void VirtualBenchSettings::check(const std::string& where) const {
    for_each_setting(*this, [&](const char* key, const auto& value, double least, double most) {
        if constexpr (std::is_same_v<decltype(value), const std::vector<double>&>) {
            for (const double element : value) check_bounds(where, key, element, least, most);
        } else {
            check_bounds(where, key, static_cast<double>(value), least, most);
        }
    });
    if (!(first_nm < last_nm)) {
        user_error(
            "{}: the pixels lie from first_nm = {} to last_nm = {}, expected more at the end",
            where, format_double(first_nm), format_double(last_nm));
    }
}

std::string format_virtual_bench_settings(const VirtualBenchSettings& settings) {
    std::vector<std::string> defaults, written;
    const auto texts = [](std::vector<std::string>* out) {
        return [out](const char* key, const auto& value, double, double) {
            using Value = std::decay_t<decltype(value)>;
            std::string text;
            if constexpr (std::is_same_v<Value, bool>) {
                text = value ? "true" : "false";
            } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
                for (const double element : value) {
                    text += (text.empty() ? "" : ", ") + json_number(element);
                }
                text = "[" + text + "]";
            } else if constexpr (std::is_integral_v<Value>) {
                text = std::to_string(value);
            } else {
                text = json_number(value);
            }
            out->push_back("\"" + std::string(key) + "\": " + text);
        };
    };
    const VirtualBenchSettings none;
    for_each_setting(none, texts(&defaults));
    for_each_setting(settings, texts(&written));
    std::string json;
    for (size_t i = 0; i < written.size(); ++i) {
        if (written[i] != defaults[i]) json += (json.empty() ? "" : ", ") + written[i];
    }
    return "{" + json + "}";
}

VirtualBenchSettings read_virtual_bench_settings(const JsonValue& value) {
    VirtualBenchSettings settings;
    std::vector<std::string> keys;
    const auto read = [&](const char* key, auto& setting, double least, double most) {
        using Value = std::decay_t<decltype(setting)>;
        keys.emplace_back(key);
        if (!value.has(key)) return;
        const JsonValue member = value.at(key);
        if constexpr (std::is_same_v<Value, bool>) {
            setting = member.boolean();
        } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
            setting = member.numbers();
        } else if constexpr (std::is_integral_v<Value>) {
            setting = static_cast<Value>(member.whole_number(least, most));
        } else {
            setting = member.number();
        }
    };
    for_each_setting(settings, read);
    value.allow_keys(keys);
    settings.check(value.place().str());
    return settings;
}

VirtualBenchSettings parse_virtual_bench_settings(const std::string& json,
                                                  const std::string& where) {
    const JsonDocument document = parse_json_tree(json, where);
    return read_virtual_bench_settings(JsonValue(document));
}

}  // namespace drude
