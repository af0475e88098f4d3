// Optical constants as files hold them (in any order, with repeats) made into a table.
#pragma once

#include <string>
#include <vector>

#include "materials/optical_constants.h"

namespace drude {

struct ConstantsRow {
    double wavelength_nm = 0;
    double n = 0, k = 0;
    double sigma_n = 0, sigma_k = 0;  // 0 where not known
    int line = 0;
};

// The rows by ascending wavelength, into `constants`. Rows of the same wavelength become their
// mean; k below 0, which no passive material has, becomes 0; both with a warning that counts them
// and names the worst. Throws Error (user) with the line for n not above 0, values that are not
// finite and wavelengths not above 0, and where there are no rows.
void fill_constants(std::vector<ConstantsRow> rows, const std::string& file,
                    OpticalConstants& constants, std::vector<std::string>& warnings);

}  // namespace drude
