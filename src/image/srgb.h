// The sRGB transfer function (IEC 61966-2-1:1999), both ways.
#pragma once

#include <cmath>
#include <cstdint>

namespace drude {

// Display value in [0, 1] of a linear value, which is clipped to [0, 1]; NaN gives 0.
inline float srgb_from_linear(float linear) {
    if (!(linear > 0.0F)) return 0.0F;
    if (linear >= 1.0F) return 1.0F;
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

// Linear value of a display value in [0, 1].
inline float linear_from_srgb(float display) {
    return display <= 0.04045F ? display / 12.92F : std::pow((display + 0.055F) / 1.055F, 2.4F);
}

inline uint8_t srgb_byte(float linear) {
    return static_cast<uint8_t>(std::lround(255.0F * srgb_from_linear(linear)));
}

}  // namespace drude
