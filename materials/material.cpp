#include "materials/material.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace drude {

void Material::check() const {
    const std::string shown = name.empty() ? "material without a name" : name;
    substrate.check();
    for (size_t i = 0; i < layers.size(); ++i) {
        layers[i].constants.check();
        const double thickness = layers[i].thickness_nm;
        if (!std::isfinite(thickness) || thickness < 0) {
            user_error("{}: layer {} is {} nm thick, expected a finite number of at least 0", shown,
                       i + 1, thickness);
        }
        const double spread = layers[i].thickness_spread_nm;
        if (!(spread >= 0 && spread <= thickness / 5)) {
            user_error(
                "{}: the thickness of layer {} scatters by {} nm, expected 0 to {} nm, a fifth of "
                "the thickness",
                shown, i + 1, spread, thickness / 5);
        }
    }
    // Not a comparison that NaN passes.
    if (!(beta >= 0 && beta < std::numbers::pi / 2)) {
        user_error(
            "{}: beta = {}, expected a number of at least 0 and below pi/2 = {:.6f} "
            "(radians; 0 is a mirror)",
            shown, beta, std::numbers::pi / 2);
    }
    if (masking == Masking::smith && lobe != Lobe::beckmann && lobe != Lobe::trowbridge_reitz) {
        user_error(
            "{}: the lobe '{}' has no Smith masking; choose the masking 'v-groove', or the "
            "lobe 'beckmann' or 'trowbridge-reitz'",
            shown, lobe_name(lobe));
    }
}

Material material_from_set(const OpticalConstants& set) {
    Material material;
    material.name = set.name;
    material.substrate = set;
    return material;
}

Material find_material(const std::string& name_or_file) {
    const bool is_file = name_or_file.find('/') != std::string::npos ||
                         std::string_view(name_or_file).ends_with(".json");
    return is_file ? read_material(name_or_file) : material_from_set(published_set(name_or_file));
}

}  // namespace drude
