// Spectra on the project's 1 nm grid, the colour matching functions and the RGB bases.
//
// Everything spectral in the renderer lives on 380, 381, ... 780 nm (vacuum wavelength): no search,
// no interpolation where it is used. Integrals over the film's range are sums over the 400 samples
// 380 ... 779 times 1 nm; the last sample only closes interpolation.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace drude {

inline constexpr int spectrum_first_nm = 380;
inline constexpr int spectrum_last_nm = 780;
inline constexpr int spectrum_size = spectrum_last_nm - spectrum_first_nm + 1;
inline constexpr int spectrum_integral_size = spectrum_size - 1;

// The value at spectrum_first_nm + i nanometres.
using DenseSpectrum = std::array<double, spectrum_size>;

DenseSpectrum constant_spectrum(double value);

// Linear interpolation of (wavelength_nm ascending, values) on the grid; the end values are held
// outside the table. Throws Error (user) where the table is empty, unequal in length, not strictly
// ascending or not finite.
DenseSpectrum resample(const std::vector<double>& wavelength_nm, const std::vector<double>& values);

struct ColourMatching {
    DenseSpectrum x, y, z;
};
// CIE 1931 2 degree observer, 1 nm (CIE 15:2018).
const ColourMatching& cie1931();
// CIE 1964 10 degree observer, 1 nm (CIE 15:2018).
const ColourMatching& cie1964();
// CIE standard illuminants, relative (100 at 560 nm), 5 nm tables interpolated linearly (CIE 15).
const DenseSpectrum& illuminant_d65();
const DenseSpectrum& illuminant_a();

// Planck's law at `kelvin`, relative: 1 at its highest value, wherever on the wavelength axis that
// lies (Wien's law). Throws Error (user) where `kelvin` is not finite and > 0.
DenseSpectrum blackbody(double kelvin);

using RGB = std::array<double, 3>;  // linear sRGB / Rec.709, D65 white
using XYZ = std::array<double, 3>;

// sum over the film's range of spectrum * colour matching function * 1 nm (no factor 683).
XYZ spectrum_to_xyz(const DenseSpectrum& spectrum);
// IEC 61966-2-1; the white of this matrix is the tabulated D65 on the project's own grid, so that
// D65 times a constant is exactly grey.
RGB xyz_to_rgb(const XYZ& xyz);
XYZ rgb_to_xyz(const RGB& rgb);
// Row-major matrices behind the two.
const std::array<std::array<double, 3>, 3>& rgb_from_xyz();
const std::array<std::array<double, 3>, 3>& xyz_from_rgb();

// The three basis reflectances of Mallett & Yuksel 2019 (EGSR), for red, green, blue: they sum to
// 1, so white is a flat spectrum, and their weighted sum under D65 has the given RGB. (The
// published numbers sum to 1 within 1e-5; here they are divided by their sum.)
const std::array<DenseSpectrum, 3>& mallett_yuksel_basis();
// sum_c rgb_c basis_c: a reflectance for rgb in [0, 1].
DenseSpectrum rgb_reflectance(const RGB& rgb);
// sum_c rgb_c basis_c(lambda) D65(lambda), scaled so that rgb = (1,1,1) has Y = 1 in
// spectrum_to_xyz; rgb may exceed 1.
DenseSpectrum rgb_illuminant(const RGB& rgb);

}  // namespace drude
