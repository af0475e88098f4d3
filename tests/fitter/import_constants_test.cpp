// Optical constants of other programs: the database's YAML, SpectraRay's dielectric functions, CSV.
#include "fitter/import_constants.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/files.h"
#include "fitter/export.h"
#include "fitter/refractiveindex_formula.h"
#include "shared_data.h"

namespace drude {
namespace {

Material read(const std::string& text) {
    const std::string format = recognise_constants(text);
    return parse_constants_as(text, "some/Xx.yml", format.empty() ? "refractiveindex" : format);
}

std::string complaint(const std::string& text) {
    try {
        read(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "was accepted";
}

void expect_complaint(const std::string& text, const std::string& start, const std::string& part) {
    const std::string message = complaint(text);
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

std::string table(const std::string& type, const std::string& rows) {
    return "REFERENCES: \"A. <i>Author</i>\"\nDATA:\n  - type: tabulated " + type +
           "\n    data: |\n" + rows;
}

TEST(ImportConstants, TabulatedUnsortedAndRepeatedRows) {
    const Material m = read(
        table("nk", "        0.6 1 4\n        0.4358 2 3\n        0.5 1 2\n        0.5 3 4\n"));
    const OpticalConstants& c = m.substrate;
    EXPECT_EQ(c.wavelength_nm, (std::vector<double>{435.8, 500, 600}));
    EXPECT_EQ(c.n, (std::vector<double>{2, 2, 1}));
    EXPECT_EQ(c.k, (std::vector<double>{3, 3, 4}));
    EXPECT_EQ(c.citation, "A. Author");
    EXPECT_EQ(m.name, "Xx");
    ASSERT_EQ(m.provenance.warnings.size(), 1u);
    EXPECT_NE(m.provenance.warnings[0].find("1 rows repeat a wavelength, the first 500 nm"),
              std::string::npos);
}

TEST(ImportConstants, NegativeKIsNamed) {
    const Material m =
        read(table("nk", "        0.4 2 -0.1\n        0.5 1 -0.2\n        0.6 1 1\n"));
    EXPECT_EQ(m.substrate.k, (std::vector<double>{0, 0, 1}));
    ASSERT_EQ(m.provenance.warnings.size(), 1u);
    EXPECT_NE(m.provenance.warnings[0].find("2 of 3 rows"), std::string::npos);
    EXPECT_NE(m.provenance.warnings[0].find("-0.2 at 500 nm, line 6"), std::string::npos)
        << m.provenance.warnings[0];
}

TEST(ImportConstants, NAndKFromEntriesOfTheirOwn) {
    const Material m = read(table("n", "        0.4 2\n        0.6 4\n") +
                            "  - type: tabulated k\n    data: |\n        0.5 1\n        0.7 3\n");
    EXPECT_EQ(m.substrate.wavelength_nm, (std::vector<double>{500, 600}));
    EXPECT_EQ(m.substrate.n, (std::vector<double>{3, 4}));
    EXPECT_EQ(m.substrate.k, (std::vector<double>{1, 2}));
    const Material transparent = read(table("n", "        0.4 2\n"));
    EXPECT_EQ(transparent.substrate.k, (std::vector<double>{0}));
    EXPECT_NE(transparent.provenance.warnings[0].find("no k"), std::string::npos);
    EXPECT_NE(complaint(table("k", "        0.4 2\n")).find("k without n"), std::string::npos);
}

// Each against its formula written out by hand at L = 0.5 micrometres.
TEST(ImportConstants, FormulaeOneToNine) {
    const double l = 0.5, l2 = 0.25;
    const auto f = [&](int formula, const std::vector<double>& c) {
        return refractiveindex_formula(formula, c, l);
    };
    EXPECT_DOUBLE_EQ(f(1, {0.1, 1.2, 0.1}), std::sqrt(1 + 0.1 + 1.2 * l2 / (l2 - 0.01)));
    EXPECT_DOUBLE_EQ(f(2, {0.1, 1.2, 0.1}), std::sqrt(1 + 0.1 + 1.2 * l2 / (l2 - 0.1)));
    EXPECT_DOUBLE_EQ(f(3, {2, 0.3, -2, 0.1, 2}), std::sqrt(2 + 0.3 / l2 + 0.1 * l2));
    EXPECT_DOUBLE_EQ(f(4, {2, 0.1, 2, 0.2, 2, -0.3, 0, 0.3, 1, 0.05, 4}),
                     std::sqrt(2 + 0.1 * l2 / (l2 - 0.04) - 0.3 / (l2 - 0.3) + 0.05 * l2 * l2));
    EXPECT_DOUBLE_EQ(f(5, {1.4, 0.01, -2}), 1.4 + 0.01 / l2);
    EXPECT_DOUBLE_EQ(f(6, {0.0001, 0.05, 200}), 1 + 0.0001 + 0.05 / (200 - 4));
    const double h = 1 / (l2 - 0.028);
    EXPECT_DOUBLE_EQ(f(7, {3, 0.1, 0.01, 0.2, 0.3, 0.4}),
                     3 + 0.1 * h + 0.01 * h * h + 0.2 * l2 + 0.3 * l2 * l2 + 0.4 * l2 * l2 * l2);
    const double x = 0.3 + 0.02 * l2 / (l2 - 0.05) + 0.01 * l2;
    const double n8 = f(8, {0.3, 0.02, 0.05, 0.01});
    EXPECT_NEAR((n8 * n8 - 1) / (n8 * n8 + 2), x, 1e-14);
    EXPECT_DOUBLE_EQ(f(9, {2, 0.01, 0.03, 0.1, 0.2, 0.5}),
                     std::sqrt(2 + 0.01 / (l2 - 0.03) + 0.1 * 0.3 / (0.09 + 0.5)));
    EXPECT_TRUE(std::isnan(f(10, {1})));
    // Terms padded with zeros are no terms.
    EXPECT_DOUBLE_EQ(f(4, {4, 0, 0, 0, 0, 0, 0, 0, 0}), 2);
}

TEST(ImportConstants, AFormulaIsTabulatedOverItsRange) {
    const std::string text =
        "DATA:\n  - type: formula 5\n    wavelength_range: 0.2005 1.2\n    coefficients: 1.4 0.01 "
        "-2\n";
    const Material m = read(text);
    const OpticalConstants& c = m.substrate;
    EXPECT_EQ(c.first_nm(), 200.5);
    EXPECT_EQ(c.last_nm(), 1200);
    EXPECT_EQ(c.wavelength_nm[1], 201);
    EXPECT_DOUBLE_EQ(c.at(500).n, 1.4 + 0.01 / 0.25);
    EXPECT_EQ(c.kind, "calculated");
    expect_complaint(
        "DATA:\n  - type: formula 2\n    wavelength_range: 0.2 1\n"
        "    coefficients: 0 -5 0.001\n",
        "some/Xx.yml:4:19: ", "no real n at 200 nm");
    expect_complaint(
        "DATA:\n  - type: formula 5\n    wavelength_range: 0 1e30\n"
        "    coefficients: 1.5\n",
        "some/Xx.yml:3:23: ", "first and the last wavelength");
    expect_complaint("DATA:\n  - type: formula 8\n    range: 0.4 1\n    coefficients: 1 2 3 4 5\n",
                     "some/Xx.yml:4:19: ", "1 to 4 for formula 8");
}

TEST(ImportConstants, YamlTrapsNameTheirLine) {
    const std::string where = "some/Xx.yml:5";
    expect_complaint(table("nk", "        0.4 2\n"), where, "2 numbers");
    expect_complaint(table("nk", "        0.4 2 nan\n"), where, "'nan'");
    expect_complaint(table("nk", "        0.4 0 1\n"), where, "n = 0");
    expect_complaint(table("nk", "        0 1 1\n"), where, "above 0");
    expect_complaint(table("nm", "        0.4 2 1\n"),
                     "some/Xx.yml:3:11: ", "did you mean 'tabulated n");
    expect_complaint("DATA:\n  - type: formula 12\n    coefficients: 1\n",
                     "some/Xx.yml:2:11: ", "formula 9");
    expect_complaint("DATA:\n  - type: tabulated nk\n", "some/Xx.yml:2:5: ", "no 'data'");
    expect_complaint("DATA: 5\n", "some/Xx.yml: ", "no list");
    expect_complaint("DATA: [\n", "some/Xx.yml:", "no YAML");
    expect_complaint(
        table("nk", "        0.4 2 1\n") + "  - type: tabulated n\n    data: |\n        1 1\n",
        "some/Xx.yml:6:5: ", "second entry of n");
    expect_complaint(std::string(100000, '['), "some/Xx.yml:", "no YAML");
}

TEST(ImportConstants, ExportedConstantsReadBackToTheLastBit) {
    OpticalConstants constants;
    constants.name = "Xx";
    constants.kind = "measured";
    constants.citation = "B. Author, J. Metals 1, 2 (1999)";
    for (int i = 0; i < 500; ++i) {
        constants.wavelength_nm.push_back(0.00123 * std::pow(1.07, i) + i / 3.0);
        constants.n.push_back(0.1 + std::sin(i) * std::sin(i) * 3);
        constants.k.push_back(std::abs(std::cos(i)) * 1e-3);
    }
    constants.wavelength_nm.insert(constants.wavelength_nm.begin(), 1e-9);
    constants.n.insert(constants.n.begin(), 1e-17);
    constants.k.insert(constants.k.begin(), 1e6);
    for (const std::string& text :
         {format_refractiveindex_info(constants), format_constants_csv(constants)}) {
        const OpticalConstants c = read(text).substrate;
        EXPECT_EQ(c.wavelength_nm, constants.wavelength_nm);
        EXPECT_EQ(c.n, constants.n);
        EXPECT_EQ(c.k, constants.k);
        EXPECT_EQ(c.citation, constants.citation);
    }
    constants.sigma_n.assign(501, 0.1);
    constants.sigma_k.assign(501, 1.0 / 3);
    const OpticalConstants c = read(format_constants_csv(constants)).substrate;
    EXPECT_EQ(c.sigma_n, constants.sigma_n);
    EXPECT_EQ(c.sigma_k, constants.sigma_k);
}

TEST(ImportConstants, SpectraRayDielectricFunctions) {
    const std::string by_wavelength =
        "Name=Xx\r\nUnits=Wavelength,E1E2\r\nBegin of array\r\n400 3 4 \r\n500,5 -3 4\r\nEnd of "
        "array\r\nrest\r\n";
    EXPECT_EQ(recognise_constants(by_wavelength), "spectraray-dielectric");
    const OpticalConstants c = read(by_wavelength).substrate;
    EXPECT_EQ(c.wavelength_nm, (std::vector<double>{400, 500.5}));
    EXPECT_DOUBLE_EQ(c.n[0], 2);
    EXPECT_DOUBLE_EQ(c.k[0], 1);
    EXPECT_DOUBLE_EQ(c.n[1], 1);
    EXPECT_DOUBLE_EQ(c.k[1], 2);
    const Material m = read("Units=eV,E1E2\nBegin of array\n2 4 0\n3 4 -1e-9\nEnd of array\n");
    EXPECT_NEAR(m.substrate.wavelength_nm[1], 619.92099216, 1e-8);
    EXPECT_EQ(m.substrate.n[1], 2);
    EXPECT_EQ(m.substrate.k, (std::vector<double>{0, 0}));
    EXPECT_EQ(m.provenance.warnings.size(), 1u);
    const std::string head = "Units=eV,E1E2\nBegin of array\n", place = "some/Xx.yml:3";
    expect_complaint(head + "2 4 nan\nEnd of array\n", place + ":5: ", "'nan'");
    expect_complaint(head + "2 4\nEnd of array\n", place, "2 fields");
    expect_complaint(head + "2 -4 -1\nEnd of array\n", place, "amplifies");
    expect_complaint(head + "2 -4 0\nEnd of array\n", place, "n = 0");
    expect_complaint(head + "2 4 1\n", "some/Xx.yml: ", "End of array");
    expect_complaint("Units=knots,E1E2\nBegin of array\n", "some/Xx.yml:1: ", "'knots");
    expect_complaint("Units=eV,NK\nBegin of array\n", "some/Xx.yml:1: ", "'nk'");
}

TEST(ImportConstants, UnknownFormatsNameTheNearest) {
    try {
        parse_constants_as("", "x", "refractivindex");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(error.message().find("did you mean 'refractiveindex'"), std::string::npos);
    }
    EXPECT_EQ(recognise_constants("wavelength_nm,angle_deg,psi_deg,delta_deg\n"), "");
    EXPECT_EQ(recognise_constants(""), "");
}

// The database's own files against the project's tables, which were made from them.
TEST(ImportConstants, RealDatabaseFiles) {
    for (const char* name : {"Cu/McPeak", "Ag/Johnson", "Au/Olmon-ev", "Al/Rakic", "Fe/Querry"}) {
        const std::string path = shared_data("literature/" + std::string(name) + ".yml");
        DRUDE_NEED_SHARED(path);
        std::string full = name;
        full.replace(full.find('/'), 1, "-");
        const OpticalConstants& published = published_set(full);
        const OpticalConstants c =
            parse_constants_as(read_file(path), path, "refractiveindex").substrate;
        // The project's tables are cut to the range that is drawn.
        ASSERT_GE(c.n.size(), published.n.size()) << name;
        for (size_t i = 0; i < published.n.size(); ++i) {
            const Index index = c.at(published.wavelength_nm[i]);
            EXPECT_NEAR(index.n, published.n[i], 1e-9) << name;
            EXPECT_NEAR(index.k, published.k[i], 1e-9) << name;
        }
        EXPECT_FALSE(c.citation.empty());
    }
    const std::string sapphire = shared_data("literature/Al2O3/Malitson-o.yml");
    DRUDE_NEED_SHARED(sapphire);
    const Material m = parse_constants_as(read_file(sapphire), sapphire, "refractiveindex");
    EXPECT_NEAR(m.substrate.at(550).n, 1.770, 5e-4);
    const std::string yang = shared_data("literature/Ag/Yang.yml");
    DRUDE_NEED_SHARED(yang);
    const Material ag = parse_constants_as(read_file(yang), yang, "refractiveindex");
    EXPECT_EQ(ag.provenance.warnings.size(), 1u);
}

}  // namespace
}  // namespace drude
