// The material record: what a fit writes and a renderer reads (format "drude-material/1").
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "materials/lobe.h"
#include "materials/optical_constants.h"

namespace drude {

struct FilmLayer {
    OpticalConstants constants;
    double thickness_nm = 0;  // >= 0
    // Standard deviation of the thickness over the surface, Gaussian; at most a fifth of it.
    double thickness_spread_nm = 0;
};

struct Provenance {
    std::string measurement;         // file name as given
    std::string measurement_sha256;  // of its bytes
    std::string command;             // command line that made the record
    std::string version;             // of drude
    std::vector<std::string> warnings;
};

struct Material {
    std::string name;
    OpticalConstants substrate;
    std::vector<FilmLayer> layers;  // the first is the outermost
    Lobe lobe = Lobe::trowbridge_reitz;
    Masking masking = Masking::smith;
    double beta = 0;  // conventions of microfacet.h; 0 is a mirror
    Provenance provenance;

    // Throws Error (user) where a value is out of range (beta in [0, pi/2), Smith masking only
    // with Beckmann and Trowbridge-Reitz, thickness >= 0, tables as in OpticalConstants::check).
    void check() const;
};

// A published set as a bare mirror.
Material material_from_set(const OpticalConstants& set);

// JSON, with round-trip numbers. parse_material: `file` names it in errors; unknown keys, missing
// keys and wrong types are Errors (user) that name the key and the nearest valid one, and for
// syntax errors file:line:column. A substrate or a layer is a table, or {"set": "Cu-McPeak"} for a
// published set; a layer has "thickness_nm" and may have "thickness_spread_nm". Required are
// format, name and substrate; what is missing otherwise is that of a bare mirror, with Smith
// masking as far as the lobe has it.
std::string format_material(const Material& material);
Material parse_material(const std::string& json, const std::string& file);
Material read_material(const std::string& path);
void write_material(const std::string& path, const Material& material);

// What a person may name where a material is wanted: a file ("cu.json"), or a published set or
// material ("Cu-McPeak", "Cu"). A name with a path separator or ending in .json is a file.
Material find_material(const std::string& name_or_file);

}  // namespace drude
