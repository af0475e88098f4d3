// The colour spaces of pbrt-v4's ColorSpace directive, brought to the project's linear sRGB.
//
// Primaries and whites (CIE xy) are those of the standards:
//   "srgb"        IEC 61966-2-1: the project's own, see materials/spectrum.h
//   "rec2020"     ITU-R BT.2020: (0.708, 0.292) (0.170, 0.797) (0.131, 0.046), D65
//   "dci-p3"      SMPTE EG 432-1: (0.680, 0.320) (0.265, 0.690) (0.150, 0.060), D65, as pbrt-v4
//                 has it (the cinema's own white is greener)
//   "aces2065-1"  SMPTE ST 2065-1: (0.7347, 0.2653) (0, 1) (0.0001, -0.0770), white (0.32168,
//                 0.33767)
// D65 is the tabulated one behind the project's sRGB, so that white stays white exactly.
#pragma once

#include <string_view>

#include "materials/spectrum.h"

namespace drude {

enum class ColourSpace { srgb, rec2020, dci_p3, aces2065_1 };

// "srgb", ... ; srgb for any other name, which the vocabulary has to keep out.
ColourSpace parse_colour_space(std::string_view name);
std::string_view colour_space_name(ColourSpace space);

// Linear RGB of a space as linear sRGB that has the same XYZ: the colour of a light. Components
// may come out negative or above 1.
RGB light_to_srgb(ColourSpace space, const RGB& rgb);

// The colour of matter: the same, after the white of the space is turned into that of sRGB by the
// Bradford transformation (Lam 1985; the matrix of ICC.1:2022, annex E), so that a grey surface
// stays grey in every space.
RGB matter_to_srgb(ColourSpace space, const RGB& rgb);

// The linear sRGB colour in [0, highest] that keeps the luminance of `rgb` (itself held in that
// range) and takes as much of its chroma as there is room for; `rgb` itself where it lies in range.
RGB into_gamut(const RGB& rgb, double highest);

}  // namespace drude
