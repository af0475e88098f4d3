#include "materials/spectrum.h"

#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "base/text_table.h"
#include "materials/embedded_tables.h"

namespace drude {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// The columns of an embedded table that follow its wavelengths, each on the project's grid.
std::vector<DenseSpectrum> embedded_spectra(std::string_view name) {
    for (const EmbeddedTable& embedded : embedded_tables()) {
        if (embedded.name != name) continue;
        const TextTable table = parse_text_table(std::string(embedded.text), std::string(name));
        std::vector<std::vector<double>> columns(table.columns.size());
        for (const TableRow& row : table.rows) {
            for (size_t i = 0; i < columns.size(); ++i) columns[i].push_back(row.values[i]);
        }
        std::vector<DenseSpectrum> spectra;
        for (size_t i = 1; i < columns.size(); ++i) {
            spectra.push_back(resample(columns[0], columns[i]));
        }
        return spectra;
    }
    throw std::logic_error("no embedded table " + std::string(name));
}

ColourMatching embedded_observer(std::string_view name) {
    const std::vector<DenseSpectrum> spectra = embedded_spectra(name);
    return {spectra.at(0), spectra.at(1), spectra.at(2)};
}

Matrix inverse(const Matrix& m) {
    // Cofactors with cyclic indices carry their sign.
    Matrix adjugate{};
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) {
            const size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            adjugate[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    double determinant = 0;
    for (size_t j = 0; j < 3; ++j) determinant += m[0][j] * adjugate[j][0];
    for (auto& row : adjugate) {
        for (double& value : row) value /= determinant;
    }
    return adjugate;
}

std::array<double, 3> product(const Matrix& m, const std::array<double, 3>& v) {
    std::array<double, 3> result{};
    for (size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

// The primaries of IEC 61966-2-1, scaled so that they add up to the tabulated white.
Matrix make_xyz_from_rgb() {
    constexpr double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    Matrix columns{};
    for (size_t c = 0; c < 3; ++c) {
        const double x = primaries[c][0], y = primaries[c][1];
        columns[0][c] = x / y;
        columns[1][c] = 1;
        columns[2][c] = (1 - x - y) / y;
    }
    XYZ white = spectrum_to_xyz(illuminant_d65());
    const double luminance = white[1];
    for (double& value : white) value /= luminance;
    const std::array<double, 3> scale = product(inverse(columns), white);
    for (auto& row : columns) {
        for (size_t c = 0; c < 3; ++c) row[c] *= scale[c];
    }
    return columns;
}

DenseSpectrum weighted_basis(const RGB& rgb) {
    const auto& basis = mallett_yuksel_basis();
    DenseSpectrum sum{};
    for (size_t i = 0; i < sum.size(); ++i) {
        sum[i] = rgb[0] * basis[0][i] + rgb[1] * basis[1][i] + rgb[2] * basis[2][i];
    }
    return sum;
}

}  // namespace

DenseSpectrum constant_spectrum(double value) {
    DenseSpectrum spectrum;
    spectrum.fill(value);
    return spectrum;
}

DenseSpectrum resample(const std::vector<double>& wavelength_nm,
                       const std::vector<double>& values) {
    if (wavelength_nm.empty() || wavelength_nm.size() != values.size()) {
        user_error(
            "a spectrum of {} wavelengths and {} values, expected as many of both and at "
            "least one",
            wavelength_nm.size(), values.size());
    }
    for (size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(wavelength_nm[i]) || !std::isfinite(values[i])) {
            user_error("row {} of a spectrum is {} nm, {}; expected finite numbers", i + 1,
                       wavelength_nm[i], values[i]);
        }
        if (i > 0 && !(wavelength_nm[i] > wavelength_nm[i - 1])) {
            user_error(
                "the wavelengths of a spectrum must ascend, but {} nm is followed by {} nm; "
                "sort the rows and remove duplicates",
                wavelength_nm[i - 1], wavelength_nm[i]);
        }
    }
    DenseSpectrum spectrum;
    size_t upper = 0;  // the first row that is not below the grid's wavelength
    for (size_t i = 0; i < spectrum.size(); ++i) {
        const double nm = spectrum_first_nm + static_cast<double>(i);
        while (upper < wavelength_nm.size() && wavelength_nm[upper] < nm) ++upper;
        if (upper == 0) {
            spectrum[i] = values.front();
        } else if (upper == values.size()) {
            spectrum[i] = values.back();
        } else {
            const double t =
                (nm - wavelength_nm[upper - 1]) / (wavelength_nm[upper] - wavelength_nm[upper - 1]);
            spectrum[i] = std::lerp(values[upper - 1], values[upper], t);
        }
    }
    return spectrum;
}

const ColourMatching& cie1931() {
    static const ColourMatching observer = embedded_observer("cie1931-2deg");
    return observer;
}

const ColourMatching& cie1964() {
    static const ColourMatching observer = embedded_observer("cie1964-10deg");
    return observer;
}

const DenseSpectrum& illuminant_d65() {
    static const DenseSpectrum spectrum = embedded_spectra("illuminant-D65").at(0);
    return spectrum;
}

const DenseSpectrum& illuminant_a() {
    static const DenseSpectrum spectrum = embedded_spectra("illuminant-A").at(0);
    return spectrum;
}

DenseSpectrum blackbody(double kelvin) {
    if (!(kelvin > 0) || !std::isfinite(kelvin)) {
        user_error("a black body of {} K, expected a temperature above 0 K", kelvin);
    }
    // hc/k (CODATA 2018) in nm K, and the root of x = 5 (1 - exp(-x)) that is Wien's law.
    constexpr double second_radiation_constant = 1.438776877e7;
    constexpr double wien = 4.965114231744276;
    const double x_nm = second_radiation_constant / kelvin;
    DenseSpectrum spectrum;
    for (size_t i = 0; i < spectrum.size(); ++i) {
        const double x = x_nm / (spectrum_first_nm + static_cast<double>(i));
        spectrum[i] = std::pow(x / wien, 5) * std::expm1(wien) / std::expm1(x);
        // Very cold, this is infinity over infinity; the law itself is 0 there.
        if (!std::isfinite(spectrum[i])) spectrum[i] = 0;
    }
    return spectrum;
}

XYZ spectrum_to_xyz(const DenseSpectrum& spectrum) {
    const ColourMatching& observer = cie1931();
    XYZ xyz{};
    for (size_t i = 0; i < spectrum_integral_size; ++i) {
        xyz[0] += spectrum[i] * observer.x[i];
        xyz[1] += spectrum[i] * observer.y[i];
        xyz[2] += spectrum[i] * observer.z[i];
    }
    return xyz;
}

XYZ rgb_to_xyz(const RGB& rgb) {
    return product(xyz_from_rgb(), rgb);
}
RGB xyz_to_rgb(const XYZ& xyz) {
    return product(rgb_from_xyz(), xyz);
}

const Matrix& xyz_from_rgb() {
    static const Matrix matrix = make_xyz_from_rgb();
    return matrix;
}

const Matrix& rgb_from_xyz() {
    static const Matrix matrix = inverse(xyz_from_rgb());
    return matrix;
}

const std::array<DenseSpectrum, 3>& mallett_yuksel_basis() {
    static const std::array<DenseSpectrum, 3> basis = [] {
        const std::vector<DenseSpectrum> table = embedded_spectra("mallett-yuksel-2019");
        std::array<DenseSpectrum, 3> spectra = {table.at(0), table.at(1), table.at(2)};
        // The published numbers add up to 1 within 1e-5 only; white has to be exactly flat here.
        for (size_t i = 0; i < spectrum_size; ++i) {
            const double sum = spectra[0][i] + spectra[1][i] + spectra[2][i];
            for (DenseSpectrum& spectrum : spectra) spectrum[i] /= sum;
        }
        return spectra;
    }();
    return basis;
}

DenseSpectrum rgb_reflectance(const RGB& rgb) {
    return weighted_basis(rgb);
}

DenseSpectrum rgb_illuminant(const RGB& rgb) {
    // The basis adds up to 1, so that (1, 1, 1) is D65 itself.
    static const double white_luminance = spectrum_to_xyz(illuminant_d65())[1];
    DenseSpectrum spectrum = weighted_basis(rgb);
    for (size_t i = 0; i < spectrum.size(); ++i) {
        spectrum[i] *= illuminant_d65()[i] / white_luminance;
    }
    return spectrum;
}

}  // namespace drude
