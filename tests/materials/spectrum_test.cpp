#include "materials/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/text_table.h"
#include "materials/embedded_tables.h"

namespace drude {
namespace {

TextTable embedded(std::string_view name) {
    for (const EmbeddedTable& table : embedded_tables()) {
        if (table.name == name) return parse_text_table(std::string(table.text), "table");
    }
    ADD_FAILURE() << "no table " << name;
    return {};
}

double column_sum(const TextTable& table, std::string_view column) {
    double sum = 0;
    for (const TableRow& row : table.rows) {
        sum += row.values.at(static_cast<size_t>(table.column(column)));
    }
    return sum;
}

DenseSpectrum product(const DenseSpectrum& a, const DenseSpectrum& b) {
    DenseSpectrum result{};
    for (size_t i = 0; i < result.size(); ++i) result[i] = a[i] * b[i];
    return result;
}

// The colour of a reflectance under D65, relative to the white reflectance.
RGB colour_under_d65(const DenseSpectrum& reflectance) {
    XYZ xyz = spectrum_to_xyz(product(reflectance, illuminant_d65()));
    const double white = spectrum_to_xyz(illuminant_d65())[1];
    for (double& value : xyz) value /= white;
    return xyz_to_rgb(xyz);
}

TEST(EmbeddedTables, AreTheFilesByteForByte) {
    ASSERT_GT(embedded_tables().size(), 30U);
    bool found_letter = false;
    for (const EmbeddedTable& table : embedded_tables()) {
        ASSERT_FALSE(table.text.empty()) << table.name;
        EXPECT_EQ(table.text.substr(0, 2), "# ") << table.name;
        EXPECT_EQ(table.text.back(), '\n') << table.name;
        found_letter = found_letter || table.text.find("Raki\xC4\x87") != std::string_view::npos;
        EXPECT_FALSE(
            parse_text_table(std::string(table.text), "table").header_value("citation").empty())
            << table.name;
    }
    EXPECT_TRUE(found_letter) << "a letter outside ASCII was lost on the way";
}

// CIE 15: the 1 nm tables' well-known sums; X, Y, Z of the equal energy spectrum are equal.
TEST(ColourMatching, SumsOfTheTables) {
    const TextTable observer = embedded("cie1931-2deg");
    ASSERT_EQ(observer.rows.size(), 471U);
    EXPECT_NEAR(column_sum(observer, "x"), 106.865469, 1e-6);
    EXPECT_NEAR(column_sum(observer, "y"), 106.856917, 1e-6);
    EXPECT_NEAR(column_sum(observer, "z"), 106.892251, 1e-6);
    const TextTable wide = embedded("cie1964-10deg");
    EXPECT_NEAR(column_sum(wide, "y") / column_sum(wide, "x"), 1, 5e-4);
    EXPECT_NEAR(column_sum(wide, "y") / column_sum(wide, "z"), 1, 5e-4);
}

TEST(ColourMatching, PeaksStandWhereTheyShould) {
    EXPECT_DOUBLE_EQ(cie1931().y[555 - spectrum_first_nm], 1.0);
    EXPECT_NEAR(cie1931().y[spectrum_integral_size], 1.499e-5, 1e-7);
    EXPECT_NEAR(cie1964().y[557 - spectrum_first_nm], 1.0, 1e-4);
}

TEST(Illuminant, D65AndAHaveTheirChromaticities) {
    const auto chromaticity = [](const DenseSpectrum& spectrum) {
        const XYZ xyz = spectrum_to_xyz(spectrum);
        const double sum = xyz[0] + xyz[1] + xyz[2];
        return std::array<double, 2>{xyz[0] / sum, xyz[1] / sum};
    };
    // CIE 15 gives 0.31272, 0.32903 and 0.44758, 0.40745. The film's range cuts off 360 to 380 nm,
    // which holds 1e-4 of the sums.
    EXPECT_NEAR(chromaticity(illuminant_d65())[0], 0.31272, 3e-5);
    EXPECT_NEAR(chromaticity(illuminant_d65())[1], 0.32903, 3e-5);
    EXPECT_NEAR(chromaticity(illuminant_a())[0], 0.44758, 5e-5);
    EXPECT_NEAR(chromaticity(illuminant_a())[1], 0.40745, 5e-5);
    EXPECT_DOUBLE_EQ(illuminant_d65()[560 - spectrum_first_nm], 100);
    EXPECT_DOUBLE_EQ(illuminant_a()[560 - spectrum_first_nm], 100);
    // Between the 5 nm rows, on the straight line.
    const double left = illuminant_d65()[0], right = illuminant_d65()[5];
    EXPECT_NEAR(illuminant_d65()[2], left + 0.4 * (right - left), 1e-12);
}

TEST(Illuminant, D65OfTheWholeTable) {
    const TextTable observer = embedded("cie1931-2deg"), d65 = embedded("illuminant-D65");
    XYZ xyz{};
    for (const TableRow& row : d65.rows) {
        const double nm = row.values[0];
        if (nm < 360) continue;
        const TableRow& matching = observer.rows.at(static_cast<size_t>(nm - 360));
        ASSERT_EQ(matching.values[0], nm);
        for (size_t i = 0; i < 3; ++i) xyz[i] += row.values[1] * matching.values[i + 1];
    }
    const double sum = xyz[0] + xyz[1] + xyz[2];
    // Every 5 nm from 360 to 780 nm.
    EXPECT_NEAR(xyz[0] / sum, 0.31272, 2.5e-5);
    EXPECT_NEAR(xyz[1] / sum, 0.32903, 2.5e-5);
}

TEST(Illuminant, AIsPlanckAtTwoThousandEightHundredFiftySix) {
    // CIE 15 defines A by Planck's law at 2848 K with c2 = 1.435e-2 m K.
    const DenseSpectrum planck = blackbody(2848 * 1.438776877e-2 / 1.435e-2);
    const double scale = 100 / planck[560 - spectrum_first_nm];
    for (size_t i = 0; i < spectrum_size; i += 5) {
        EXPECT_NEAR(planck[i] * scale / illuminant_a()[i], 1, 1e-5) << i;
    }
}

TEST(Blackbody, IsOneAtWiensWavelength) {
    // b = 2.897771955e6 nm K (CODATA 2018), so 5269 K peaks at 550 nm.
    const DenseSpectrum spectrum = blackbody(2.897771955e6 / 550);
    EXPECT_NEAR(spectrum[550 - spectrum_first_nm], 1, 1e-9);
    for (const double value : spectrum) EXPECT_LE(value, 1 + 1e-12);
    // Colder, the peak lies in the infrared and the spectrum rises all the way.
    const DenseSpectrum cold = blackbody(1000);
    EXPECT_LT(cold[0], cold[200]);
    EXPECT_LT(cold[spectrum_integral_size], 0.01);
}

TEST(Blackbody, TakesEveryPositiveTemperature) {
    for (const double kelvin : {1e-300, 1e-3, 1.0, 300.0, 1e9, 1e300}) {
        for (const double value : blackbody(kelvin)) {
            EXPECT_TRUE(value >= 0 && value <= 1 + 1e-12) << kelvin << " K: " << value;
        }
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double kelvin : {0.0, -5.0, nan, std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(blackbody(kelvin), Error);
    }
}

TEST(Resample, InterpolatesAndHolds) {
    const DenseSpectrum spectrum = resample({400, 410, 500}, {1, 2, -1});
    EXPECT_EQ(spectrum[0], 1);
    EXPECT_EQ(spectrum[20], 1);
    EXPECT_DOUBLE_EQ(spectrum[24], 1.4);
    EXPECT_EQ(spectrum[30], 2);
    EXPECT_DOUBLE_EQ(spectrum[60], 1);
    EXPECT_EQ(spectrum[120], -1);
    EXPECT_EQ(spectrum[400], -1);
    EXPECT_EQ(resample({1000}, {7})[0], 7);
    EXPECT_EQ(resample({10, 20}, {7, 8})[0], 8);
}

TEST(Resample, RefusesWhatIsNoTable) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(resample({}, {}), Error);
    EXPECT_THROW(resample({400, 500}, {1}), Error);
    EXPECT_THROW(resample({400, 400}, {1, 1}), Error);
    EXPECT_THROW(resample({500, 400}, {1, 1}), Error);
    EXPECT_THROW(resample({400, nan}, {1, 1}), Error);
    EXPECT_THROW(resample({400, 500}, {1, nan}), Error);
    try {
        resample({500, 400}, {1, 1});
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        EXPECT_NE(error.message().find("500 nm is followed by 400 nm"), std::string::npos);
    }
}

TEST(Rgb, MatrixIsThatOfTheStandardUpToTheWhite) {
    // IEC 61966-2-1, whose white (0.3127, 0.3290) is D65 rounded to four digits.
    constexpr double standard[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) {
            EXPECT_NEAR(rgb_from_xyz()[i][j], standard[i][j], 1e-3) << i << j;
        }
    }
    double luminance = 0;
    for (size_t c = 0; c < 3; ++c) luminance += xyz_from_rgb()[1][c];
    EXPECT_NEAR(luminance, 1, 1e-14);
    const RGB rgb = {0.2, -0.1, 3};
    const RGB back = xyz_to_rgb(rgb_to_xyz(rgb));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-14);
}

TEST(Rgb, GreyUnderD65IsGrey) {
    for (const double grey : {1.0, 0.18}) {
        for (const double value : colour_under_d65(constant_spectrum(grey))) {
            // A dozen roundings of numbers around 3.
            EXPECT_NEAR(value, grey, 1e-14);
        }
    }
}

TEST(MallettYuksel, SumsToOne) {
    const TextTable table = embedded("mallett-yuksel-2019");
    ASSERT_EQ(table.rows.size(), 81U);
    for (const TableRow& row : table.rows) {
        EXPECT_NEAR(row.values[1] + row.values[2] + row.values[3], 1, 1e-4);
    }
    const auto& basis = mallett_yuksel_basis();
    for (size_t i = 0; i < spectrum_size; ++i) {
        EXPECT_NEAR(basis[0][i] + basis[1][i] + basis[2][i], 1, 1e-15);
        for (const DenseSpectrum& spectrum : basis) {
            EXPECT_GE(spectrum[i], 0);
            EXPECT_LE(spectrum[i], 1);
        }
    }
}

TEST(MallettYuksel, ReflectanceHasItsColour) {
    for (const RGB& rgb : {RGB{1, 0, 0}, RGB{0, 1, 0}, RGB{0, 0, 1}, RGB{0.8, 0.5, 0.1},
                           RGB{0.02, 0.9, 0.4}, RGB{0, 0, 0}}) {
        const RGB seen = colour_under_d65(rgb_reflectance(rgb));
        // The basis was made on sums every 5 nm, see below; on the 1 nm grid pure green, the worst
        // of all colours, comes back as 0.99899.
        for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], rgb[c], 1.1e-3);
    }
    for (const double value : rgb_reflectance({1, 1, 1})) EXPECT_NEAR(value, 1, 1e-15);
}

// On its own grid, every 5 nm from 380 to 780 nm, the published basis reproduces the primaries.
TEST(MallettYuksel, IsExactOnItsOwnGrid) {
    std::array<XYZ, 3> colours{};
    XYZ white{};
    for (size_t i = 0; i < spectrum_size; i += 5) {
        const std::array<double, 3> matching = {cie1931().x[i], cie1931().y[i], cie1931().z[i]};
        for (size_t axis = 0; axis < 3; ++axis) {
            const double weight = matching[axis] * illuminant_d65()[i];
            white[axis] += weight;
            for (size_t c = 0; c < 3; ++c) {
                colours[c][axis] += weight * mallett_yuksel_basis()[c][i];
            }
        }
    }
    for (size_t c = 0; c < 3; ++c) {
        // The chromaticity of the primary of IEC 61966-2-1.
        const double sum = colours[c][0] + colours[c][1] + colours[c][2];
        constexpr double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
        EXPECT_NEAR(colours[c][0] / sum, primaries[c][0], 1e-5);
        EXPECT_NEAR(colours[c][1] / sum, primaries[c][1], 1e-5);
    }
    // The luminances of the primaries under D65.
    EXPECT_NEAR(colours[0][1] / white[1], 0.2126, 1e-4);
    EXPECT_NEAR(colours[1][1] / white[1], 0.7152, 1e-4);
    EXPECT_NEAR(colours[2][1] / white[1], 0.0722, 1e-4);
}

TEST(MallettYuksel, IlluminantHasItsColourAndLuminance) {
    const XYZ white = spectrum_to_xyz(rgb_illuminant({1, 1, 1}));
    // A sum of 400 terms: about 400 roundings of 1.1e-16 at most.
    EXPECT_NEAR(white[1], 1, 1e-13);
    for (const double value : xyz_to_rgb(white)) EXPECT_NEAR(value, 1, 1e-12);
    const RGB bright = {25, 3, 100};
    const RGB seen = xyz_to_rgb(spectrum_to_xyz(rgb_illuminant(bright)));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], bright[c], 1.1e-3 * 100);
}

}  // namespace
}  // namespace drude
