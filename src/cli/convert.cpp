// `drude convert`: measurements and materials in the formats of other programs.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "fitter/export.h"
#include "fitter/import.h"
#include "fitter/import_constants.h"
#include "materials/material.h"

namespace drude {

namespace {

struct ConvertOptions {
    std::string input, output, to = "auto", format = "auto";
};

const std::vector<std::string>& targets() {
    static const std::vector<std::string> names = {"auto",    "measurement",     "material", "pbrt",
                                                   "mitsuba", "refractiveindex", "csv"};
    return names;
}

bool ends_with(const std::string& text, std::string_view end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Every format that may be asked for: of measurements, then of optical constants.
const std::vector<std::string>& input_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = measurement_formats();
        all.insert(all.end(), constants_formats().begin(), constants_formats().end());
        return all;
    }();
    return names;
}

// A published set by name, or a material file of this project; everything else is a file of another
// program's.
bool is_own_material(const ConvertOptions& options) {
    if (options.format != "auto" || options.to == "measurement") return false;
    if (ends_with(options.input, ".json")) return true;
    std::error_code ignored;
    if (contains(published_names(), options.input)) return true;
    if (std::filesystem::exists(options.input, ignored)) return false;
    // No such file: a slip in a published name deserves find_material's hint, a path does not.
    return options.input.find('/') == std::string::npos &&
           options.input.find('.') == std::string::npos;
}

std::string target_by_extension(const std::string& output) {
    if (ends_with(output, ".json")) return "material";
    if (ends_with(output, ".csv")) return "csv";
    if (ends_with(output, ".yml") || ends_with(output, ".yaml")) return "refractiveindex";
    user_error("{}: no format belongs to this name; give one with --to: {}", output,
               fmt::join(targets().begin() + 2, targets().end(), ", "));
}

std::vector<std::string> write_spd_pair(const OpticalConstants& constants, std::string base) {
    if (ends_with(base, ".spd")) base.resize(base.size() - 4);
    std::vector<std::string> files = {base + ".eta.spd", base + ".k.spd"};
    write_file(files[0], format_spd(constants, IndexPart::n));
    write_file(files[1], format_spd(constants, IndexPart::k));
    return files;
}

// How the other program is told about the pair.
std::string spd_usage(const std::string& target, const std::vector<std::string>& files) {
    if (target == "pbrt") {
        return fmt::format("Material \"conductor\" \"spectrum eta\" \"{}\" \"spectrum k\" \"{}\"",
                           files[0], files[1]);
    }
    return fmt::format(
        "<bsdf type=\"conductor\"><spectrum name=\"eta\" filename=\"{}\"/>"
        "<spectrum name=\"k\" filename=\"{}\"/></bsdf>",
        files[0], files[1]);
}

// What was written, and what there is to say about it.
struct Converted {
    std::vector<std::string> files;
    std::vector<std::string> warnings;
    std::string usage;
};

Converted convert_material(const Material& material, const ConvertOptions& options) {
    Converted converted;
    converted.warnings = material.provenance.warnings;
    const std::string target =
        options.to == "auto" ? target_by_extension(options.output) : options.to;
    if (target == "material") {
        write_material(options.output, material);
        converted.files = {options.output};
        return converted;
    }
    if (!material.layers.empty()) {
        user_error(
            "{}: found {} film{} on the substrate, which the format {} cannot hold; "
            "expected a bare material",
            options.input, material.layers.size(), material.layers.size() == 1 ? "" : "s", target);
    }
    if (target == "pbrt" || target == "mitsuba") {
        converted.files = write_spd_pair(material.substrate, options.output);
        converted.usage = spd_usage(target, converted.files);
        return converted;
    }
    write_file(options.output, target == "csv" ? format_constants_csv(material.substrate)
                                               : format_refractiveindex_info(material.substrate));
    converted.files = {options.output};
    return converted;
}

// Another program's optical constants, with where they come from.
Material read_constants(const std::string& text, const std::string& format,
                        const ConvertOptions& options) {
    Material material = parse_constants_as(text, options.input, format);
    material.provenance.version = DRUDE_VERSION;
    return material;
}

Converted convert_measurement(const std::string& text, const ConvertOptions& options) {
    if (options.to != "auto" && options.to != "measurement" && options.to != "csv") {
        user_error(
            "{}: a measurement of Psi and Delta becomes a measurement file only, not {}; "
            "`drude fit` makes a material of it",
            options.input, options.to);
    }
    Measurement measurement = parse_measurement_as(text, options.input, options.format);
    if (!measurement.header_value("imported_from").empty()) {
        measurement.header.emplace_back("source_file",
                                        std::filesystem::path(options.input).filename().string());
    }
    write_measurement(options.output, measurement);
    return {{options.output}, import_warnings(measurement), ""};
}

Converted convert(const ConvertOptions& options) {
    if (is_own_material(options)) return convert_material(find_material(options.input), options);
    const std::string text = read_file(options.input);
    const std::string format =
        options.format == "auto" ? recognise_constants(text) : options.format;
    if (contains(constants_formats(), format) && options.to != "measurement") {
        return convert_material(read_constants(text, format, options), options);
    }
    return convert_measurement(text, options);
}

int run_convert(const ConvertOptions& options, const CommonOptions& common) {
    const Converted converted = convert(options);
    print_warnings(converted.warnings);
    if (common.json) {
        nlohmann::ordered_json document = {{"files", converted.files},
                                           {"warnings", converted.warnings}};
        if (!converted.usage.empty()) document["usage"] = converted.usage;
        print_json_document(document);
        return 0;
    }
    for (const std::string& file : converted.files) fmt::print("{}\n", file);
    if (!converted.usage.empty()) fmt::print("use: {}\n", converted.usage);
    return 0;
}

}  // namespace

Command convert_command() {
    Command command;
    command.name = "convert";
    command.summary = "Convert measurements and materials from and to other programs' files";
    command.description =
        "A measurement becomes the project's own CSV: an export of SpectraRay, CompleteEASE, "
        "WVASE, Accurion, Horiba (.spe) or Film Sense, or a table with names such as Wavelength "
        "(nm), AOI, Psi, Delta; it is recognised by its content. A material (a published set by "
        "name, a material file, YAML of refractiveindex.info with tables or formulae 1 to 9, a "
        "dielectric function of SpectraRay, a table wavelength_nm,n,k) becomes what --to says, or "
        "what the name of OUT ends in:\n"
        "pbrt, mitsuba: two spectra, OUT.eta.spd and OUT.k.spd;\n"
        "refractiveindex (.yml): YAML of the refractiveindex.info database;\n"
        "csv (.csv): a table of n and k with standard deviations where they are known;\n"
        "material (.json): the project's material file.\n\n"
        "pbrt and Mitsuba take a spectrum for zero outside its samples: n and k are held from the "
        "table's ends to 360 and 830 nm.";
    command.example =
        "$ drude convert export.txt sample.csv\n"
        "sample.csv\n"
        "$ drude convert Cu-Johnson copper --to pbrt\n"
        "copper.eta.spd\n"
        "copper.k.spd\n"
        "use: Material \"conductor\" \"spectrum eta\" \"copper.eta.spd\" \"spectrum k\" "
        "\"copper.k.spd\"\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<ConvertOptions>();
        options.positional("IN", values->input, "a measurement, optical constants or a set", true);
        options.positional("OUT", values->output, "the file to write; of .spd pairs the stem",
                           true);
        options.choice("--to", values->to, targets(), "what to write; auto goes by OUT");
        options.choice("--format", values->format, input_formats(),
                       "of the file IN; auto goes by content");
        return [values, &common] { return run_convert(*values, common); };
    };
    return command;
}

}  // namespace drude
