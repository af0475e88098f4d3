// Optical glasses by their catalogue names.
#pragma once

#include <string_view>
#include <vector>

#include "materials/spectrum.h"

namespace drude {

// Sellmeier's formula n^2 - 1 = sum of B l^2 / (l^2 - C), l the vacuum wavelength in micrometres
// (dispersion.h), with the coefficients of SCHOTT's catalogue ("Optical Glass 2023" for the glasses
// with N-, "Optical Glass 2000" for SF5, SF10 and SF11). The formula is for air of normal pressure
// in place of vacuum, which changes n by 3 in ten thousand at most.
struct Glass {
    std::string_view name;         // "SF11"
    std::string_view designation;  // SCHOTT's, "SF11"
    double B[3], C[3];             // C in square micrometres

    double n(double wavelength_nm) const;
};

const std::vector<Glass>& glasses();

// By name, or by pbrt-v4's: its F5, F10 and F11 are SF5, SF10 and SF11. nullptr where there is
// none.
const Glass* find_glass(std::string_view name);

// n on the project's grid.
DenseSpectrum dense_index(const Glass& glass);

}  // namespace drude
