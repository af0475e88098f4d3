// Reading optical constants of other programs as materials.
#pragma once

#include <string>
#include <vector>

#include "materials/material.h"

namespace drude {

// "refractiveindex" (import_refractiveindex.h), "spectraray-dielectric" (import_dielectric.h),
// "nk" (the CSV that format_constants_csv writes: wavelength_nm,n,k[,sigma_n,sigma_k]).
const std::vector<std::string>& constants_formats();

// The format of a file by its content, or "" where it is none of them.
std::string recognise_constants(const std::string& text);

// A bare mirror of the file's constants; what was changed on reading is in provenance.warnings.
// The name is the file's own where it gives one, else the file name without folder and extension.
// Throws Error (user) with file and line for what the format forbids and for an unknown format.
Material parse_constants_as(const std::string& text, const std::string& file,
                            const std::string& format);

}  // namespace drude
