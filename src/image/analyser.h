// A polarising filter held before a finished picture.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/stokes_layer.h"

namespace drude {

// Light meets the retarder first. Angles in degrees from the picture's horizontal,
// counter-clockwise in the picture.
struct Analyser {
    struct Retarder {
        double fast_axis_deg = 0.0;
        double retardance_deg = 90.0;  // 90: a quarter-wave plate
    };

    double axis_deg = 0.0;  // of transmission
    std::optional<Retarder> retarder;
};

// "ANGLE[,retarder=FAST[:RETARDANCE]]", all in degrees within [-360, 360]: "45" or
// "0,retarder=-45" or "0,retarder=45:127". Throws Error (user) that names `what`.
Analyser parse_analyser(std::string_view text, std::string_view what);

// "0,retarder=-45:90": reads back as the same.
std::string format_analyser(const Analyser& analyser);

Mueller<double> mueller(const Analyser& analyser);

// The suffixes of the layers that an analyser is applied to: of a wavelength the nearest spectral
// layer, otherwise R, G, B and every spectral layer. Throws Error (user) as choose_layer.
std::vector<std::string> analysed_layers(const Image& image, const std::string& where,
                                         std::optional<double> wavelength_nm);

// The light behind the analyser: S0 to S3 of each layer, and S0 of the colours again as R, G, B, or
// of a single layer as Y. Values as they come, also below 0 where R, G and B are outside Rec.709.
// Of the attributes those of the spectral layout are kept; "analyser" says what was applied. Throws
// Error (user) where S3 is missing and a retarder wants it.
Image behind_analyser(const Image& image, const std::string& where,
                      const std::vector<std::string>& layers, const Analyser& analyser);

}  // namespace drude
