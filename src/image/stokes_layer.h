// The Stokes vectors of a finished picture: by wavelength, or from the luminance of its colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "materials/mueller.h"

namespace drude {

// The wavelength of a spectral layer ("S1.550,000000nm": 550), or nothing for another channel.
std::optional<double> layer_wavelength(const std::string& channel);

// Whether S0, S1 and S2 are there for "R" or "550,000000nm".
bool has_linear(const Image& image, const std::string& suffix);

// Component `i` (0 to 3) of a layer, a value a pixel: of the channel "S<i>.<suffix>", or for "Y"
// the luminance (Rec.709) of S<i>.R, S<i>.G and S<i>.B, which is linear in the spectrum where R, G
// and B of their own may be negative. Throws Error (user) that names the file `where` and the
// channel that is missing.
std::vector<double> stokes_values(const Image& image, const std::string& where, int i,
                                  const std::string& suffix);

// What a picture is looked at in.
struct LayerChoice {
    std::string suffix;                   // "550,000000nm", or "Y"
    std::optional<double> wavelength_nm;  // of the spectral layer
};

// Spectral layers with S0, S1 and S2, by ascending wavelength.
std::vector<LayerChoice> spectral_layers(const Image& image);

// The spectral layer nearest to a wavelength in nm, the shorter of two as near; without one Y of
// the colours. Throws Error (user) that names the file `where` and says what to do where the file
// has no S0, S1 and S2 of that kind.
LayerChoice choose_layer(const Image& image, const std::string& where,
                         std::optional<double> wavelength_nm);

// One Stokes vector a pixel, in the picture's frame, with the signs of mueller.h.
struct StokesLayer {
    int width = 0, height = 0;
    LayerChoice choice;
    std::vector<double> s[4];  // row-major; s[3] empty where it was not asked for

    // S3 is 0 where it was not asked for.
    Stokes<double> at(size_t pixel) const;
};

// Files whose attribute polarisationHandedness is "left" count S3 > 0 counter-clockwise; here it
// has the other sign.
bool is_left_handed(const Image& image);

// Throws Error (user) as stokes_values.
StokesLayer read_stokes_layer(const Image& image, const std::string& where,
                              const LayerChoice& choice, bool with_s3);

}  // namespace drude
