// What spectrometers store about themselves: names, polynomials of wavelength and non-linearity.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace drude {

// Text as it lies in a device's memory: up to the first NUL or FF (memory that was never written),
// blanks at its ends removed, '?' for what is not printable ASCII.
std::string stored_text(std::span<const uint8_t> bytes);

// Wavelengths of pixels 0 to `pixels` - 1: sum of c[i] * (pixel + origin)^i, in nm. Throws
// DeviceError (bad_frame), its message beginning with `device`, where a coefficient or a wavelength
// is not finite, one is not positive, or they do not ascend strictly: a memory that was never
// written or was read wrong.
std::vector<double> polynomial_wavelengths(const std::vector<double>& coefficients, int pixels,
                                           int origin, const std::string& device);

// Why coefficients of a divisor sum of c[i] * counts^i cannot be used on counts 0 to `max_counts`,
// or an empty string: none, one not finite, c[0] = 0 (never written; it would divide by nothing), a
// divisor outside [0.5, 2] somewhere.
std::string why_nonlinearity_is_unusable(const std::vector<double>& coefficients,
                                         uint32_t max_counts);

}  // namespace drude
