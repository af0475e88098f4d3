// The tables of optical constants that are compiled in: those with a `material` and a `set`.
#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "base/error.h"
#include "base/text_table.h"
#include "materials/embedded_tables.h"
#include "materials/optical_constants.h"

namespace drude {

namespace {

struct Library {
    std::vector<OpticalConstants> sets;
    std::vector<std::string> notes;  // one a set
    // Index into `sets` of the default of each material.
    std::vector<std::pair<std::string, size_t>> defaults;
};

struct Entry {
    OpticalConstants constants;
    std::string note;
    bool is_default = false;
};

Entry read_entry(const TextTable& table) {
    Entry entry;
    entry.note = table.header_value("note");
    entry.is_default = table.header_value("default") == "yes";
    OpticalConstants& set = entry.constants;
    set.material = table.header_value("material");
    set.name = set.material + "-" + table.header_value("set");
    set.citation = table.header_value("citation");
    set.kind = table.header_value("kind");
    if (table.columns != std::vector<std::string>{"wavelength_nm", "n", "k"}) {
        throw std::logic_error(set.name + ": columns are not wavelength_nm,n,k");
    }
    for (const TableRow& row : table.rows) {
        set.wavelength_nm.push_back(row.values[0]);
        set.n.push_back(row.values[1]);
        set.k.push_back(row.values[2]);
    }
    return entry;
}

Library make_library() {
    std::vector<Entry> entries;
    for (const EmbeddedTable& embedded : embedded_tables()) {
        // Colour matching functions and illuminants name no material; do not parse them here.
        if (embedded.text.find("# material:") == std::string_view::npos) continue;
        entries.push_back(read_entry(
            parse_text_table(std::string(embedded.text), std::string(embedded.name) + ".csv")));
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.constants.material, a.constants.name) <
               std::tie(b.constants.material, b.constants.name);
    });
    Library library;
    for (Entry& entry : entries) {
        if (entry.is_default) {
            library.defaults.emplace_back(entry.constants.material, library.sets.size());
        }
        library.sets.push_back(std::move(entry.constants));
        library.notes.push_back(std::move(entry.note));
    }
    return library;
}

const Library& library() {
    static const Library the_library = make_library();
    return the_library;
}

}  // namespace

const std::vector<OpticalConstants>& published_sets() {
    return library().sets;
}

const OpticalConstants& published_set(std::string_view name) {
    for (const auto& [material, index] : library().defaults) {
        if (material == name) return library().sets[index];
    }
    for (const OpticalConstants& set : library().sets) {
        if (set.name == name) return set;
    }
    user_error("'{}' is no published material or set{}; `drude materials` lists them", name,
               did_you_mean(name, published_names()));
}

std::vector<std::string> published_names() {
    std::vector<std::string> names;
    for (const auto& [material, index] : library().defaults) names.push_back(material);
    for (const OpticalConstants& set : library().sets) names.push_back(set.name);
    return names;
}

std::string published_note(std::string_view full_name) {
    for (size_t i = 0; i < library().sets.size(); ++i) {
        if (library().sets[i].name == full_name) return library().notes[i];
    }
    return {};
}

}  // namespace drude
