#include "materials/glasses.h"

#include <cmath>

#include "materials/dispersion.h"

namespace drude {

const std::vector<Glass>& glasses() {
    static const std::vector<Glass> all = {
        {"BK7",
         "N-BK7",
         {1.03961212, 0.231792344, 1.01046945},
         {0.00600069867, 0.0200179144, 103.560653}},
        {"BAF10",
         "N-BAF10",
         {1.5851495, 0.143559385, 1.08521269},
         {0.00926681282, 0.0424489805, 105.613573}},
        {"FK51A",
         "N-FK51A",
         {0.971247817, 0.216901417, 0.904651666},
         {0.00472301995, 0.0153575612, 168.68133}},
        {"LASF9",
         "N-LASF9",
         {2.00029547, 0.298926886, 1.80691843},
         {0.0121426017, 0.0538736236, 156.530829}},
        {"SF5",
         "SF5",
         {1.46141885, 0.247713019, 0.949995832},
         {0.0111826126, 0.0508594669, 112.041888}},
        {"SF10",
         "SF10",
         {1.61625977, 0.259229334, 1.07762317},
         {0.0127534559, 0.0581983954, 116.60768}},
        {"SF11",
         "SF11",
         {1.73848403, 0.311168974, 1.17490871},
         {0.0136068604, 0.0615960463, 121.922711}},
    };
    return all;
}

const Glass* find_glass(std::string_view name) {
    const bool is_short = name == "F5" || name == "F10" || name == "F11";
    for (const Glass& glass : glasses()) {
        if (glass.name == name || (is_short && glass.name.substr(1) == name)) return &glass;
    }
    return nullptr;
}

double Glass::n(double wavelength_nm) const {
    const double l = wavelength_nm / 1000;
    double square = 1;
    for (int i = 0; i < 3; ++i) square += sellmeier_term(B[i], std::sqrt(C[i]), l).re;
    return std::sqrt(square);
}

DenseSpectrum dense_index(const Glass& glass) {
    DenseSpectrum result;
    for (int i = 0; i < spectrum_size; ++i) result[i] = glass.n(spectrum_first_nm + i);
    return result;
}

}  // namespace drude
