// Six metals with known answers, measured as often as a test likes.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/counter_random.h"
#include "materials/film_stack.h"
#include "materials/measurement.h"

namespace drude {

// n, k of the table in Berger, Weidlich, Wilkie & Magnor 2012, and for 45..80 degrees with 0.05 and
// 0.1 degrees of noise: condition, standard deviations and correlation of the linearised problem.
struct MetalCase {
    std::string name;
    double n = 1, k = 0;
    double condition_rho2 = 0, sd_n_rho2 = 0, sd_k_rho2 = 0, correlation_rho2 = 0;
    double condition_both = 0, sd_n_both = 0, sd_k_both = 0;
};

inline const std::vector<MetalCase>& metal_cases() {
    static const std::vector<MetalCase> cases = {
        {"Cu", 1.030, 2.460, 5.2, .0054, .0128, .86, 1.0, .0026, .0025},
        {"galvanised", 3.708, 4.721, 4.7, .0256, .0191, .91, 1.2, .0059, .0060},
        {"steel", 2.400, 3.699, 4.3, .0127, .0150, .89, 1.1, .0042, .0040},
        {"Al", .875, 6.233, 24.8, .0349, .172, .98, 1.0, .0071, .0070},
        {"Au", .549, 1.810, 6.9, .0034, .0133, .81, 1.0, .0020, .0019},
        {"Ag", .290, 3.040, 23.5, .0072, .0702, .91, 1.0, .0030, .0030},
        {"Ag-Johnson", .050, 3.085, 138.7, .0073, .420, .91, 1.0, .0030, .0030},
    };
    return cases;
}

inline std::vector<double> paper_angles() {
    return {45, 50, 60, 70, 75, 80};
}

// One wavelength; seed 0 is noise-free. `stream` keeps experiments with the same seeds apart.
inline Measurement measured(const MetalCase& metal, const std::vector<double>& angles_deg,
                            uint64_t seed, uint64_t stream = 0) {
    Measurement data;
    for (size_t i = 0; i < angles_deg.size(); ++i) {
        const Reflection<double> r =
            reflect(ComplexIndex<double>{metal.n, metal.k}, std::cos(angles_deg[i] * pi / 180));
        const auto noise = normal_pair(seed, i, stream);
        MeasurementRow row;
        row.wavelength_nm = 516;
        row.angle_deg = angles_deg[i];
        row.sigma_psi_deg = 0.05;
        row.sigma_delta_deg = 0.1;
        row.psi_deg = psi(r) * 180 / pi + (seed == 0 ? 0 : 0.05 * noise[0]);
        row.delta_deg = delta(r) * 180 / pi + (seed == 0 ? 0 : 0.1 * noise[1]);
        data.rows.push_back(row);
    }
    return data;
}

}  // namespace drude
