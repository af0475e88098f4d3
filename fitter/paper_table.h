// Table 1 of Berger, Weidlich, Wilkie & Magnor, "Verifying and Modeling the Polarizing Reflectance
// of Real-World Metallic Surfaces", IEEE CG&A 32(2), 24-33 (2012), doi 10.1109/MCG.2011.110, as
// printed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "materials/measurement.h"

namespace drude {

// One fit of the table: the Fresnel terms alone (beta NaN), or under one of the four lobes.
struct PaperValues {
    double n = 0, k = 0, beta = 0;
};

struct PaperMetal {
    std::string name;      // "galvanised steel"
    std::string material;  // "Zn": whose published sets are its literature here
    // The set that takes the place of the paper's literature [12] (Palik 1985, which may not be
    // shipped): the nearest to it of the free ones; for the steels the nearest there is.
    std::string literature;
    double wavelength_nm = 0;
    std::array<PaperValues, 5> blocks;  // in the order of paper_block_names()
};

// "Fresnel terms", then the lobes in the order of the enumeration Lobe, which is the table's.
const std::vector<std::string>& paper_block_names();

// Six metals, in the table's order.
const std::vector<PaperMetal>& paper_table();

// 45, 50, 60, 70, 75 and 80 degrees: the angles at which the paper's samples are taken to have
// been measured.
const std::vector<double>& paper_angles_deg();

// The metal that a sample's name means: one of the table's by name ("copper", "Al foil"), by
// material ("Cu") or by published set ("Cu-McPeak"), letter case free; null where it means none.
const PaperMetal* paper_metal_of(const std::string& sample);

// Noise-free Psi and Delta of a bare surface of these n and k, at paper_angles_deg().
Measurement paper_measurement(const PaperMetal& metal, const PaperValues& values);

}  // namespace drude
