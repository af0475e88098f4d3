#include "device/signal/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "materials/json_tree.h"

namespace drude {

namespace {

constexpr const char* format_name = "drude-calibration/1";
// Six curves of a pixel each; more is a file given by mistake.
constexpr uint64_t largest_file = uint64_t{1} << 24;

struct NamedCurve {
    const char* key;
    WavelengthCurve Calibration::*curve;
    double least, most;
    bool least_excluded;
};
constexpr NamedCurve curves[] = {
    {"source_s1", &Calibration::source_s1, -1, 1, true},
    {"source_s2", &Calibration::source_s2, -1, 1, true},
    {"retardance_deg", &Calibration::retardance_deg, -360, 360, false},
    {"diattenuation", &Calibration::diattenuation, 0, 100, true},
    {"modulation_depth", &Calibration::modulation_depth, 0, 1.1, true},
};

struct NamedNumber {
    const char* key;
    double Calibration::*number;
    double least, most;
};
constexpr NamedNumber numbers[] = {
    {"polariser_offset_deg", &Calibration::polariser_offset_deg, -180, 180},
    {"analyser_offset_deg", &Calibration::analyser_offset_deg, -180, 180},
    {"polariser_offset_sigma_deg", &Calibration::polariser_offset_sigma_deg, 0, 180},
    {"analyser_offset_sigma_deg", &Calibration::analyser_offset_sigma_deg, 0, 180},
};

void check_curve(const NamedCurve& named, const WavelengthCurve& curve, const std::string& where) {
    if (curve.wavelength_nm.size() != curve.value.size()) {
        user_error("{}: '{}' has {} wavelengths and {} values, expected as many of either", where,
                   named.key, curve.wavelength_nm.size(), curve.value.size());
    }
    for (size_t i = 0; i < curve.value.size(); ++i) {
        const double nm = curve.wavelength_nm[i], value = curve.value[i];
        if (!(nm > 0 && std::isfinite(nm)) || (i > 0 && !(nm > curve.wavelength_nm[i - 1]))) {
            user_error(
                "{}: '{}' has the wavelength {} nm as number {}, expected positive ones that "
                "ascend",
                where, named.key, format_double(nm), i + 1);
        }
        const bool low = named.least_excluded ? !(value > named.least) : !(value >= named.least);
        if (low || !(value <= named.most)) {
            user_error("{}: '{}' is {} at {} nm, expected {} {} to {}", where, named.key,
                       format_double(value), format_double(nm),
                       named.least_excluded ? "above" : "from", format_double(named.least),
                       format_double(named.most));
        }
    }
}

nlohmann::ordered_json curve_json(const WavelengthCurve& curve) {
    return {{"wavelength_nm", curve.wavelength_nm}, {"value", curve.value}};
}

}  // namespace

double WavelengthCurve::at(double nm, double otherwise) const {
    if (!known()) return otherwise;
    const auto above = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), nm);
    if (above == wavelength_nm.begin()) return value.front();
    if (above == wavelength_nm.end()) return value.back();
    const auto i = static_cast<size_t>(above - wavelength_nm.begin());
    const double t = (nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
    return value[i - 1] + t * (value[i] - value[i - 1]);
}

void Calibration::check(const std::string& where) const {
    for (const NamedNumber& named : numbers) {
        const double value = this->*named.number;
        if (!(value >= named.least && value <= named.most)) {
            user_error("{}: '{}' is {}, expected {} to {} degrees", where, named.key,
                       format_double(value), format_double(named.least), format_double(named.most));
        }
    }
    for (const NamedCurve& named : curves) check_curve(named, this->*named.curve, where);
    if (source_s1.known() != source_s2.known()) {
        user_error("{}: found only one of 'source_s1' and 'source_s2', expected both or neither",
                   where);
    }
    for (const double nm : source_s1.wavelength_nm) {
        const double s1 = source_s1.at(nm, 0), s2 = source_s2.at(nm, 0);
        if (std::hypot(s1, s2) >= 1) {
            user_error("{}: the source is polarised by {} at {} nm, expected less than 1", where,
                       format_double(std::hypot(s1, s2)), format_double(nm));
        }
    }
}

std::string format_calibration(const Calibration& calibration) {
    calibration.check("calibration");
    nlohmann::ordered_json json;
    json["format"] = format_name;
    for (const NamedNumber& named : numbers) json[named.key] = calibration.*named.number;
    for (const NamedCurve& named : curves) {
        const WavelengthCurve& curve = calibration.*named.curve;
        if (curve.known()) json[named.key] = curve_json(curve);
    }
    if (!calibration.provenance.empty()) {
        nlohmann::ordered_json provenance = nlohmann::ordered_json::array();
        for (const auto& entry : calibration.provenance) {
            provenance.push_back({entry.first, entry.second});
        }
        json["provenance"] = provenance;
    }
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Calibration parse_calibration(const std::string& json, const std::string& file) {
    const JsonDocument document = parse_json_tree(json, file);
    const JsonValue root(document);
    std::vector<std::string> allowed = {"format", "provenance"};
    for (const NamedNumber& named : numbers) allowed.emplace_back(named.key);
    for (const NamedCurve& named : curves) allowed.emplace_back(named.key);
    if (const std::string found = root.at("format").string(); found != format_name) {
        user_error_at(root.at("format").place(), "found the format '{}', expected '{}'", found,
                      format_name);
    }
    root.allow_keys(allowed);
    Calibration calibration;
    for (const NamedNumber& named : numbers) {
        if (root.has(named.key)) calibration.*named.number = root.at(named.key).number();
    }
    for (const NamedCurve& named : curves) {
        if (!root.has(named.key)) continue;
        const JsonValue value = root.at(named.key);
        value.allow_keys({"wavelength_nm", "value"});
        WavelengthCurve curve{value.at("wavelength_nm").numbers(), value.at("value").numbers()};
        if (!curve.known()) {
            user_error_at(value.place(), "'{}' has no wavelength; leave out what is not known",
                          named.key);
        }
        calibration.*named.curve = std::move(curve);
    }
    if (root.has("provenance")) {
        for (const JsonValue& entry : root.at("provenance").array()) {
            const std::vector<std::string> words = entry.strings();
            if (words.size() != 2) {
                user_error_at(entry.place(),
                              "found {} strings, expected a key and a value of provenance",
                              words.size());
            }
            calibration.provenance.emplace_back(words[0], words[1]);
        }
    }
    calibration.check(file);
    return calibration;
}

Calibration read_calibration(const std::string& path) {
    return parse_calibration(read_file(path, largest_file), path);
}

}  // namespace drude
