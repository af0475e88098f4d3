// The names of the microfacet lobes and of the masking terms. Their mathematics is in microfacet.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drude {

enum class Lobe { blinn_phong, gaussian, beckmann, trowbridge_reitz };
enum class Masking { v_groove, smith };

// "blinn-phong", "gaussian", "beckmann", "trowbridge-reitz"; "v-groove", "smith".
std::string_view lobe_name(Lobe lobe);
std::string_view masking_name(Masking masking);
const std::vector<std::string>& lobe_names();
const std::vector<std::string>& masking_names();
// Throw Error (user) naming the nearest.
Lobe parse_lobe(std::string_view name);
Masking parse_masking(std::string_view name);

}  // namespace drude
