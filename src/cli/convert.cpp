// `drude convert`: measurements and materials in the formats of other programs.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "fitter/export.h"
#include "fitter/import.h"
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

// A material by name, or a material file; everything else is a measurement.
bool is_material(const ConvertOptions& options) {
    if (options.format != "auto" || options.to == "measurement") return false;
    if (ends_with(options.input, ".json")) return true;
    std::error_code ignored;
    const auto& names = published_names();
    if (std::find(names.begin(), names.end(), options.input) != names.end()) return true;
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
    const std::vector<std::string> files = {base + ".eta.spd", base + ".k.spd"};
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

std::vector<std::string> convert_material(const ConvertOptions& options, std::string* usage) {
    const Material material = find_material(options.input);
    const std::string target =
        options.to == "auto" ? target_by_extension(options.output) : options.to;
    if (target == "material") {
        write_material(options.output, material);
        return {options.output};
    }
    if (!material.layers.empty()) {
        user_error(
            "{}: found {} film{} on the substrate, which the format {} cannot hold; "
            "expected a bare material",
            options.input, material.layers.size(), material.layers.size() == 1 ? "" : "s", target);
    }
    if (target == "pbrt" || target == "mitsuba") {
        const auto files = write_spd_pair(material.substrate, options.output);
        *usage = spd_usage(target, files);
        return files;
    }
    write_file(options.output, target == "csv" ? format_constants_csv(material.substrate)
                                               : format_refractiveindex_info(material.substrate));
    return {options.output};
}

std::vector<std::string> convert_measurement(const ConvertOptions& options) {
    if (options.to != "auto" && options.to != "measurement" && options.to != "csv") {
        user_error(
            "{}: a measurement of Psi and Delta becomes a measurement file only, not {}; "
            "`drude fit` makes a material of it",
            options.input, options.to);
    }
    Measurement measurement = import_measurement(options.input, options.format);
    if (measurement.header_value("imported_from").size() > 0) {
        measurement.header.emplace_back("source_file",
                                        std::filesystem::path(options.input).filename().string());
    }
    write_measurement(options.output, measurement);
    return {options.output};
}

int run_convert(const ConvertOptions& options, const CommonOptions& common) {
    std::string usage;
    const std::vector<std::string> files =
        is_material(options) ? convert_material(options, &usage) : convert_measurement(options);
    if (common.json) {
        nlohmann::ordered_json document = {{"files", files}};
        if (!usage.empty()) document["usage"] = usage;
        print_json_document(document);
        return 0;
    }
    for (const std::string& file : files) fmt::print("{}\n", file);
    if (!usage.empty()) fmt::print("use: {}\n", usage);
    return 0;
}

}  // namespace

Command convert_command() {
    Command command;
    command.name = "convert";
    command.summary = "Convert measurements and materials from and to other programs' files";
    command.description =
        "A measurement (SpectraRay's ASCII export of Psi and Delta, recognised by its content) "
        "becomes the project's own CSV. A material (a published set by name, or a material file) "
        "becomes what --to says, or what the name of OUT ends in:\n"
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
        options.positional("IN", values->input, "a measurement, a material file or a set", true);
        options.positional("OUT", values->output, "the file to write; of .spd pairs the stem",
                           true);
        options.choice("--to", values->to, targets(), "what to write; auto goes by OUT");
        options.choice("--format", values->format, measurement_formats(),
                       "of a measurement IN; auto goes by content");
        return [values, &common] { return run_convert(*values, common); };
    };
    return command;
}

}  // namespace drude
