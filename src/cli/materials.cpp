// `drude materials`: the published optical constants that come with the program.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/numbers.h"
#include "cli/command_list.h"
#include "cli/warnings.h"
#include "materials/material.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

struct MaterialsOptions {
    std::string name;
    std::string range;
    double step = 0;
};

void print_json(const ordered_json& document) {
    fmt::print("{}\n", document.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

bool is_default(const OpticalConstants& set) {
    return published_set(set.material).name == set.name;
}

std::string range_text(const OpticalConstants& set) {
    return fmt::format("{}-{}", set.first_nm(), set.last_nm());
}

void list_json() {
    ordered_json sets = ordered_json::array();
    for (const OpticalConstants& set : published_sets()) {
        sets.push_back({{"name", set.name},
                        {"material", set.material},
                        {"default", is_default(set)},
                        {"kind", set.kind},
                        {"first_nm", set.first_nm()},
                        {"last_nm", set.last_nm()},
                        {"points", set.wavelength_nm.size()},
                        {"citation", set.citation},
                        {"note", published_note(set.name)}});
    }
    print_json({{"sets", sets}});
}

void list_text() {
    size_t name_width = 4, range_width = 8;
    for (const OpticalConstants& set : published_sets()) {
        name_width = std::max(name_width, set.name.size());
        range_width = std::max(range_width, range_text(set).size());
    }
    const auto line = [&](const auto&... cells) {
        fmt::print("{:<{}}  {:<8}  {:<10}  {:<{}}  {:>6}  {}\n", cells...);
    };
    line("name", name_width, "default", "kind", "range nm", range_width, "points", "citation");
    for (const OpticalConstants& set : published_sets()) {
        line(set.name, name_width, is_default(set) ? "of " + set.material : std::string(), set.kind,
             range_text(set), range_width, set.wavelength_nm.size(), set.citation);
    }
}

// The wavelengths asked for, empty for the table's own; `cut` is set to the range where only the
// table's own rows inside it are wanted.
std::vector<double> wanted_grid(const OpticalConstants& set, const MaterialsOptions& options,
                                bool step_given, std::vector<double>& cut) {
    const std::string& range = options.range;
    const auto colons = std::count(range.begin(), range.end(), ':');
    if (step_given) {
        if (!range.empty() && colons != 1) {
            user_error("--range: found '{}' beside --step, expected FIRST:LAST", range);
        }
        const std::string ends =
            range.empty() ? fmt::format("{}:{}", set.first_nm(), set.last_nm()) : range;
        return parse_grid(fmt::format("{}:{}", ends, options.step), "--range");
    }
    if (colons == 1 && range.find(',') == std::string::npos) {
        std::string ends = range;
        std::replace(ends.begin(), ends.end(), ':', ',');
        cut = parse_grid(ends, "--range");
        if (cut[0] > cut[1]) {
            user_error("--range: '{}' is empty: {} > {}", range, cut[0], cut[1]);
        }
        return {};
    }
    return range.empty() ? std::vector<double>() : parse_grid(range, "--range");
}

// The rows that are wanted of `set`, interpolated (and then without standard deviations) where a
// grid is asked for.
OpticalConstants wanted_rows(const OpticalConstants& set, const MaterialsOptions& options,
                             bool step_given) {
    std::vector<double> cut;
    const std::vector<double> grid = wanted_grid(set, options, step_given, cut);
    if (grid.empty() && cut.empty()) return set;
    OpticalConstants rows = set;
    rows.wavelength_nm = grid;
    for (std::vector<double>* column : {&rows.n, &rows.k, &rows.sigma_n, &rows.sigma_k}) {
        column->clear();
    }
    for (const double wavelength : grid) {
        const Index index = set.at(wavelength);
        rows.n.push_back(index.n);
        rows.k.push_back(index.k);
    }
    for (size_t i = 0; grid.empty() && i < set.wavelength_nm.size(); ++i) {
        if (set.wavelength_nm[i] < cut[0] || set.wavelength_nm[i] > cut[1]) continue;
        rows.wavelength_nm.push_back(set.wavelength_nm[i]);
        rows.n.push_back(set.n[i]);
        rows.k.push_back(set.k[i]);
        if (!set.sigma_n.empty()) rows.sigma_n.push_back(set.sigma_n[i]);
        if (!set.sigma_k.empty()) rows.sigma_k.push_back(set.sigma_k[i]);
    }
    if (rows.wavelength_nm.empty()) {
        user_error("{} has no row from {} to {} nm (its table spans {} nm); --step interpolates",
                   set.name, cut[0], cut[1], range_text(set));
    }
    return rows;
}

void print_rows_json(const OpticalConstants& rows, const std::vector<std::string>& warnings) {
    ordered_json document = {{"name", rows.name},
                             {"material", rows.material},
                             {"citation", rows.citation},
                             {"kind", rows.kind},
                             {"note", published_note(rows.name)},
                             {"wavelength_nm", rows.wavelength_nm},
                             {"n", rows.n},
                             {"k", rows.k}};
    if (!rows.sigma_n.empty()) document["sigma_n"] = rows.sigma_n;
    if (!rows.sigma_k.empty()) document["sigma_k"] = rows.sigma_k;
    document["warnings"] = warnings;
    print_json(document);
}

void print_rows_csv(const OpticalConstants& rows) {
    const auto header = [](const char* key, std::string value) {
        // A value from a file may hold line breaks, which end a header line.
        for (char& c : value) c = c == '\n' || c == '\r' ? ' ' : c;
        if (!value.empty()) fmt::print("# {}: {}\n", key, value);
    };
    header("name", rows.name);
    header("material", rows.material);
    header("kind", rows.kind);
    header("citation", rows.citation);
    header("note", published_note(rows.name));
    std::string text = "wavelength_nm,n,k";
    if (!rows.sigma_n.empty()) text += ",sigma_n";
    if (!rows.sigma_k.empty()) text += ",sigma_k";
    for (size_t i = 0; i < rows.wavelength_nm.size(); ++i) {
        text += fmt::format("\n{},{},{}", rows.wavelength_nm[i], rows.n[i], rows.k[i]);
        if (!rows.sigma_n.empty()) text += fmt::format(",{}", rows.sigma_n[i]);
        if (!rows.sigma_k.empty()) text += fmt::format(",{}", rows.sigma_k[i]);
    }
    fmt::print("{}\n", text);
}

int run_materials(const MaterialsOptions& options, const OptionSet& given, bool json) {
    const bool step_given = given.given("--step");
    if (options.name.empty()) {
        if (step_given || given.given("--range")) {
            user_error(
                "--range and --step choose rows of one set: name it, as in "
                "`drude materials Cu --range 380:780 --step 5`");
        }
        json ? list_json() : list_text();
        return 0;
    }
    const OpticalConstants set = find_material(options.name).substrate;
    const OpticalConstants rows = wanted_rows(set, options, step_given);
    const auto [first, last] =
        std::minmax_element(rows.wavelength_nm.begin(), rows.wavelength_nm.end());
    const std::string warning = set.range_warning(*first, *last);
    if (!warning.empty()) print_warning(warning);
    if (json) {
        print_rows_json(
            rows, warning.empty() ? std::vector<std::string>() : std::vector<std::string>{warning});
    } else {
        print_rows_csv(rows);
    }
    return 0;
}

}  // namespace

Command materials_command() {
    Command command;
    command.name = "materials";
    command.summary = "List the published optical constants, or print one set";
    command.description =
        "Without a name: every published set of optical constants N = n + ik that comes with the "
        "program, what kind it is (measured, calculated, digitised from a figure), its range, its "
        "number of points and where it was published. Wherever a material is wanted, a set is "
        "named in full (Cu-Johnson), or a material alone (Cu), which stands for the set marked as "
        "its default.\n\n"
        "With a name, or a material file (cu.json): its rows as CSV. --range FIRST:LAST keeps the "
        "table's own rows inside the range; with --step, or as FIRST:LAST:STEP or a list, n and k "
        "are interpolated linearly at those wavelengths. Outside its table a set holds its end "
        "value, with a warning.";
    command.example =
        "$ drude materials Cu-Johnson --range 500:600\n"
        "# name: Cu-Johnson\n"
        "# material: Cu\n"
        "# kind: measured\n"
        "# citation: Johnson, Christy (1972), Optical constants of the noble metals, Phys. Rev. B "
        "6, 4370-4379, doi 10.1103/PhysRevB.6.4370\n"
        "# note: room temperature; cut to 200-2500 nm\n"
        "wavelength_nm,n,k\n"
        "520.9,1.18,2.608\n"
        "548.6,1.02,2.577\n"
        "582.1,0.7,2.704\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<MaterialsOptions>();
        options.positional("NAME", values->name, "a set, a material or a material file", false);
        options.option("--range", values->range,
                       "wavelengths in nm: FIRST:LAST, FIRST:LAST:STEP or a list");
        options.option("--step", values->step, "interpolate every so many nm");
        return [values, &options, &common] { return run_materials(*values, options, common.json); };
    };
    return command;
}

}  // namespace drude
