// The material record as JSON.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "materials/json_tree.h"
#include "materials/material.h"

namespace drude {

namespace {

constexpr std::string_view format_name = "drude-material/1";
// A record has a few hundred rows, some 100 bytes each; this keeps a file given by mistake out of
// memory, where its tree may be fifty times as large.
constexpr uint64_t largest_record = uint64_t{1} << 23;

// ---- writing
// -------------------------------------------------------------------------------------

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string pair(std::string_view key, const std::string& value) {
    return fmt::format("\"{}\": {}", key, value);
}

// Columns stay readable: as many numbers a line as fit.
std::string numbers_text(const std::vector<double>& values, const std::string& indent) {
    constexpr size_t width = 100;
    std::string text = "[\n", line = indent + "  ";
    for (size_t i = 0; i < values.size(); ++i) {
        const std::string word = json_number(values[i]) + (i + 1 < values.size() ? "," : "");
        if (line.size() + word.size() > width) {
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
            line = indent + "  ";
        }
        line += word + " ";
    }
    return text + line.substr(0, line.find_last_not_of(' ') + 1) + "\n" + indent + "]";
}

std::string object_text(const std::vector<std::string>& members, const std::string& indent) {
    const std::string inner = indent + "  ";
    return "{\n" + inner + fmt::format("{}", fmt::join(members, ",\n" + inner)) + "\n" + indent +
           "}";
}

std::vector<std::string> constants_members(const OpticalConstants& constants,
                                           const std::string& indent) {
    const std::string inner = indent + "  ";
    std::vector<std::string> members = {
        pair("name", quoted(constants.name)),
        pair("material", quoted(constants.material)),
        pair("citation", quoted(constants.citation)),
        pair("kind", quoted(constants.kind)),
        pair("range_policy", constants.policy == RangePolicy::clamp ? "\"clamp\"" : "\"error\""),
        pair("wavelength_nm", numbers_text(constants.wavelength_nm, inner)),
        pair("n", numbers_text(constants.n, inner)),
        pair("k", numbers_text(constants.k, inner))};
    if (!constants.sigma_n.empty()) {
        members.push_back(pair("sigma_n", numbers_text(constants.sigma_n, inner)));
    }
    if (!constants.sigma_k.empty()) {
        members.push_back(pair("sigma_k", numbers_text(constants.sigma_k, inner)));
    }
    return members;
}

std::string provenance_text(const Provenance& provenance) {
    std::vector<std::string> warnings;
    for (const std::string& warning : provenance.warnings) warnings.push_back(quoted(warning));
    return object_text(
        {pair("measurement", quoted(provenance.measurement)),
         pair("measurement_sha256", quoted(provenance.measurement_sha256)),
         pair("command", quoted(provenance.command)), pair("version", quoted(provenance.version)),
         pair("warnings", fmt::format("[{}]", fmt::join(warnings, ", ")))},
        "  ");
}

// ---- reading
// -------------------------------------------------------------------------------------

// The value of `key`, or `otherwise` where it is missing.
std::string string_or(const JsonValue& object, std::string_view key, std::string otherwise) {
    return object.has(key) ? object.at(key).string() : std::move(otherwise);
}

RangePolicy read_policy(const JsonValue& object) {
    const std::string policy = string_or(object, "range_policy", "clamp");
    if (policy == "clamp") return RangePolicy::clamp;
    if (policy == "error") return RangePolicy::error;
    const JsonValue value = object.at("range_policy");
    user_error_at(value.place(), "{} is '{}', expected 'clamp' or 'error'{}", value.shown(), policy,
                  did_you_mean(policy, {"clamp", "error"}));
}

// A table, or the name of a published set. `extra`: keys that stand beside the constants.
OpticalConstants read_constants(const JsonValue& object, const std::string& default_name,
                                const std::vector<std::string>& extra) {
    std::vector<std::string> keys = {"name",         "material",      "citation", "kind",
                                     "range_policy", "wavelength_nm", "n",        "k",
                                     "sigma_n",      "sigma_k",       "set"};
    if (object.has("set")) keys = {"set", "range_policy"};
    keys.insert(keys.end(), extra.begin(), extra.end());
    object.allow_keys(keys);

    OpticalConstants constants;
    if (object.has("set")) {
        const JsonValue set = object.at("set");
        constants = set.located([&] { return published_set(set.string()); });
        constants.policy = read_policy(object);
        return constants;
    }
    constants.name = string_or(object, "name", default_name);
    constants.material = string_or(object, "material", "");
    constants.citation = string_or(object, "citation", "");
    constants.kind = string_or(object, "kind", "");
    constants.policy = read_policy(object);
    constants.wavelength_nm = object.at("wavelength_nm").numbers();
    constants.n = object.at("n").numbers();
    constants.k = object.at("k").numbers();
    if (object.has("sigma_n")) constants.sigma_n = object.at("sigma_n").numbers();
    if (object.has("sigma_k")) constants.sigma_k = object.at("sigma_k").numbers();
    object.located([&] { constants.check(); });
    return constants;
}

FilmLayer read_layer(const JsonValue& object, const std::string& material_name) {
    FilmLayer layer;
    layer.constants =
        read_constants(object, material_name + " film", {"thickness_nm", "thickness_spread_nm"});
    const JsonValue thickness = object.at("thickness_nm");
    layer.thickness_nm = thickness.number();
    if (layer.thickness_nm < 0) {
        user_error_at(thickness.place(), "{} is {}, expected at least 0", thickness.shown(),
                      layer.thickness_nm);
    }
    if (object.has("thickness_spread_nm")) {
        const JsonValue spread = object.at("thickness_spread_nm");
        layer.thickness_spread_nm = spread.number();
        if (!(layer.thickness_spread_nm >= 0 &&
              layer.thickness_spread_nm <= layer.thickness_nm / 5)) {
            user_error_at(spread.place(), "{} is {}, expected 0 to {}, a fifth of the thickness",
                          spread.shown(), layer.thickness_spread_nm, layer.thickness_nm / 5);
        }
    }
    return layer;
}

Provenance read_provenance(const JsonValue& object) {
    object.allow_keys({"measurement", "measurement_sha256", "command", "version", "warnings"});
    Provenance provenance;
    provenance.measurement = string_or(object, "measurement", "");
    provenance.measurement_sha256 = string_or(object, "measurement_sha256", "");
    provenance.command = string_or(object, "command", "");
    provenance.version = string_or(object, "version", "");
    if (object.has("warnings")) provenance.warnings = object.at("warnings").strings();
    return provenance;
}

// Lobe, masking and beta. Where the masking is not given, it is Smith's as far as the lobe has it.
void read_surface(const JsonValue& record, Material& material) {
    if (record.has("lobe")) {
        const JsonValue lobe = record.at("lobe");
        material.lobe = lobe.located([&] { return parse_lobe(lobe.string()); });
    }
    if (record.has("masking")) {
        const JsonValue masking = record.at("masking");
        material.masking = masking.located([&] { return parse_masking(masking.string()); });
    } else {
        const bool has_smith =
            material.lobe == Lobe::beckmann || material.lobe == Lobe::trowbridge_reitz;
        material.masking = has_smith ? Masking::smith : Masking::v_groove;
    }
    if (record.has("beta")) {
        const JsonValue beta = record.at("beta");
        material.beta = beta.number();
        if (!(material.beta >= 0 && material.beta < std::numbers::pi / 2)) {
            beta.located([&] { material.check(); });
        }
    }
    (record.has("masking") ? record.at("masking") : record).located([&] { material.check(); });
}

}  // namespace

std::string format_material(const Material& material) {
    material.check();
    std::vector<std::string> layers;
    for (const FilmLayer& layer : material.layers) {
        std::vector<std::string> members = constants_members(layer.constants, "    ");
        members.push_back(pair("thickness_nm", json_number(layer.thickness_nm)));
        if (layer.thickness_spread_nm > 0) {
            members.push_back(pair("thickness_spread_nm", json_number(layer.thickness_spread_nm)));
        }
        layers.push_back("\n    " + object_text(members, "    "));
    }
    const std::string layers_text =
        layers.empty() ? "[]" : fmt::format("[{}\n  ]", fmt::join(layers, ","));
    return object_text(
               {pair("format", quoted(std::string(format_name))),
                pair("name", quoted(material.name)),
                pair("substrate", object_text(constants_members(material.substrate, "  "), "  ")),
                pair("layers", layers_text),
                pair("lobe", quoted(std::string(lobe_name(material.lobe)))),
                pair("masking", quoted(std::string(masking_name(material.masking)))),
                pair("beta", json_number(material.beta)),
                pair("provenance", provenance_text(material.provenance))},
               "") +
           "\n";
}

Material parse_material(const std::string& json, const std::string& file) {
    const JsonDocument document = parse_json_tree(json, file);
    const JsonValue record(document);
    // First the format: the keys of another version are nobody's spelling mistakes.
    const JsonValue format = record.at("format");
    if (format.string() != format_name) {
        user_error_at(format.place(), "'format' is '{}', expected '{}', the one this version reads",
                      format.string(), format_name);
    }
    record.allow_keys(
        {"format", "name", "substrate", "layers", "lobe", "masking", "beta", "provenance"});
    Material material;
    material.name = record.at("name").string();
    material.substrate = read_constants(record.at("substrate"), material.name, {});
    if (record.has("layers")) {
        for (const JsonValue& layer : record.at("layers").array()) {
            material.layers.push_back(read_layer(layer, material.name));
        }
    }
    if (record.has("provenance")) material.provenance = read_provenance(record.at("provenance"));
    read_surface(record, material);
    return material;
}

Material read_material(const std::string& path) {
    return parse_material(read_file(path, largest_record), path);
}

void write_material(const std::string& path, const Material& material) {
    write_file(path, format_material(material));
}

}  // namespace drude
