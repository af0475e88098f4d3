#include "fitter/paper_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "materials/fresnel.h"

namespace drude {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

const std::vector<std::string>& paper_block_names() {
    static const std::vector<std::string> names = {"Fresnel terms", "Blinn-Phong", "Gaussian",
                                                   "Beckmann", "Trowbridge-Reitz"};
    return names;
}

const std::vector<PaperMetal>& paper_table() {
    static const std::vector<PaperMetal> table = {
        {"copper",
         "Cu",
         "Cu-Hagemann",
         516,
         {{{1.030, 2.460, none},
           {1.032, 2.459, 0.786},
           {1.232, 2.458, 0.358},
           {1.032, 2.459, 0.786},
           {1.232, 2.458, 0.187}}}},
        {"galvanised steel",
         "Zn",
         "Zn-Werner-DFT",
         500,
         {{{3.708, 4.721, none},
           {3.708, 4.721, 0.867},
           {3.708, 4.721, 0.213},
           {3.708, 4.721, 0.867},
           {3.708, 4.721, 0.259}}}},
        {"steel",
         "steel",
         "steel-Karlsson-austenitic",
         500,
         {{{2.400, 3.699, none},
           {2.400, 3.700, 0.255},
           {2.471, 3.500, 0.307},
           {2.400, 3.700, 1.180},
           {2.471, 3.500, 0.246}}}},
        {"aluminium foil",
         "Al",
         "Al-Rakic",
         516,
         {{{0.875, 6.233, none},
           {0.875, 6.233, 0.637},
           {0.876, 6.233, 0.438},
           {0.875, 6.233, 0.637},
           {0.875, 6.233, 0.501}}}},
        {"gold",
         "Au",
         "Au-Olmon-ev",
         516,
         {{{0.549, 1.810, none},
           {0.549, 1.810, 0.443},
           {0.550, 1.810, 0.218},
           {0.549, 1.810, 0.866},
           {0.550, 1.810, 0.185}}}},
        {"silver",
         "Ag",
         "Ag-Rakic-BB",
         495,
         {{{0.290, 3.040, none},
           {0.289, 3.040, 0.793},
           {0.289, 3.040, 0.825},
           {0.289, 3.040, 0.793},
           {0.289, 3.040, 0.736}}}},
    };
    return table;
}

const std::vector<double>& paper_angles_deg() {
    static const std::vector<double> angles = {45, 50, 60, 70, 75, 80};
    return angles;
}

const PaperMetal* paper_metal_of(const std::string& sample) {
    const std::string name = lower_case(sample);
    const std::string first_word = name.substr(0, name.find_first_of(" -_,;("));
    struct Word {
        const char* word;
        const char* material;
    };
    constexpr Word words[] = {{"copper", "Cu"},   {"cu", "Cu"},         {"galvanised", "Zn"},
                              {"zinc", "Zn"},     {"galvanized", "Zn"}, {"zn", "Zn"},
                              {"steel", "steel"}, {"aluminium", "Al"},  {"aluminum", "Al"},
                              {"al", "Al"},       {"gold", "Au"},       {"au", "Au"},
                              {"silver", "Ag"},   {"ag", "Ag"}};
    for (const Word& word : words) {
        if (first_word != word.word) continue;
        for (const PaperMetal& metal : paper_table()) {
            if (metal.material == word.material) return &metal;
        }
    }
    return nullptr;
}

Measurement paper_measurement(const PaperMetal& metal, const PaperValues& values) {
    Measurement data;
    data.header = {{"sample", metal.name}};
    for (const double angle : paper_angles_deg()) {
        const Reflection<double> r =
            reflect(ComplexIndex<double>{values.n, values.k}, std::cos(angle * pi / 180));
        MeasurementRow row;
        row.wavelength_nm = metal.wavelength_nm;
        row.angle_deg = angle;
        row.psi_deg = psi(r) * 180 / pi;
        row.delta_deg = delta(r) * 180 / pi;
        row.sigma_psi_deg = 0.05;
        row.sigma_delta_deg = 0.1;
        data.rows.push_back(row);
    }
    return data;
}

}  // namespace drude
