#include "fitter/import_horiba.h"

#include <algorithm>
#include <optional>

#include "fitter/import_text.h"

namespace drude {

namespace {

// "data" for "# DATA:", nothing for another line.
std::optional<std::string> block_label(std::string_view line) {
    const std::vector<Word> words = split_blanks(line);
    if (words.empty() || words[0].text[0] != '#') return std::nullopt;
    std::string label;
    for (const Word& word : words) {
        if (!label.empty()) label += ' ';
        label += lower_case(word.text);
    }
    label.erase(0, label.find_first_not_of("# "));
    while (!label.empty() && (label.back() == ':' || label.back() == ' ')) label.pop_back();
    return label;
}

struct Block {
    std::string label;
    int line = 0;
    std::vector<TextLine> lines;
};

std::vector<Block> blocks_of(const std::string& text) {
    std::vector<Block> blocks;
    bool open = false;
    for (const TextLine& line : lines_of(text)) {
        if (auto label = block_label(line.text)) {
            blocks.push_back({std::move(*label), line.number, {}});
            open = true;
        } else if (split_blanks(line.text).empty()) {
            // A blank line right below the label does not end the block yet.
            open = open && blocks.back().lines.empty();
        } else if (open) {
            blocks.back().lines.push_back(line);
        }
    }
    return blocks;
}

double angle_in(const Block& block, const std::string& file) {
    if (block.lines.empty()) {
        user_error_at({file, block.line, 0}, "found no number below INCIDENCE ANGLE");
    }
    const Place place{file, block.lines[0].number, 0};
    Word word = split_blanks(block.lines[0].text)[0];
    // "70.00deg" and the like.
    word.text = word.text.substr(0, word.text.find_first_not_of("+-.,0123456789"));
    return parse_number(word, place);
}

struct Names {
    size_t spectral = 0, psi = 0, delta = 0, count = 0;
    SpectralUnit unit = SpectralUnit::nm;
};

Names names_in(const TextLine& line, const std::string& file) {
    constexpr size_t absent = static_cast<size_t>(-1);
    const std::vector<Word> words = split_blanks(line.text);
    Names names{absent, absent, absent, words.size(), SpectralUnit::nm};
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string name = lower_case(words[i].text);
        size_t* found = nullptr;
        if (const auto unit = spectral_unit(name); unit && name != "a") {
            found = &names.spectral;
            names.unit = *unit;
        } else if (name == "psi") {
            found = &names.psi;
        } else if (name == "delta") {
            found = &names.delta;
        }
        if (!found) continue;
        if (*found != absent) {
            user_error_at({file, line.number, words[i].column}, "found the column '{}' twice",
                          shown(words[i].text));
        }
        *found = i;
    }
    if (names.spectral == absent || names.psi == absent || names.delta == absent) {
        user_error_at({file, line.number, 0},
                      "found the names '{}', expected nm or eV, Psi and Delta among them: export "
                      "Psi and Delta",
                      shown(line.text));
    }
    return names;
}

void read_data(const Block& block, double angle, Measurement& measurement) {
    if (block.lines.empty()) {
        user_error_at({measurement.file, block.line, 0}, "found no rows below DATA");
    }
    const Names names = names_in(block.lines[0], measurement.file);
    for (size_t i = 1; i < block.lines.size(); ++i) {
        const std::vector<Word> words = split_blanks(block.lines[i].text);
        const Place place{measurement.file, block.lines[i].number, 0};
        if (words.size() != names.count) {
            user_error_at(place, "found {} fields, expected {}: one for each name", words.size(),
                          names.count);
        }
        MeasurementRow row;
        row.wavelength_nm = parse_wavelength_nm(words[names.spectral], place, names.unit);
        row.angle_deg = angle;
        row.psi_deg = parse_number(words[names.psi], place);
        row.delta_deg = parse_number(words[names.delta], place);
        row.line = place.line;
        measurement.rows.push_back(row);
    }
}

}  // namespace

bool is_horiba(const std::string& text) {
    const std::vector<TextLine> lines = lines_of(text);
    return std::any_of(lines.begin(), lines.end(), [](const TextLine& line) {
        const auto label = block_label(line.text);
        return label && line.text.find(':') != line.text.npos &&
               (*label == "data" || *label == "incidence angle");
    });
}

Measurement parse_horiba(const std::string& text, const std::string& file) {
    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "Horiba .spe"}};
    const std::vector<Block> blocks = blocks_of(text);
    const auto is = [](const char* label) {
        return [label](const Block& block) { return block.label == label; };
    };
    const auto angles = std::count_if(blocks.begin(), blocks.end(), is("incidence angle"));
    if (angles == 0) user_error("{}: found no block '# INCIDENCE ANGLE:'", file);
    std::optional<double> angle;
    if (angles == 1) {
        angle = angle_in(*std::find_if(blocks.begin(), blocks.end(), is("incidence angle")), file);
    }
    for (const Block& block : blocks) {
        if (block.label == "incidence angle") angle = angle_in(block, file);
        if (block.label != "data") continue;
        if (!angle) {
            user_error_at({file, block.line, 0},
                          "found DATA above the first of {} angles of incidence, expected it below "
                          "its own",
                          angles);
        }
        read_data(block, *angle, measurement);
    }
    if (measurement.rows.empty()) user_error("{}: found no rows in a block '# DATA:'", file);
    measurement.check();
    return measurement;
}

}  // namespace drude
