// What instruments of several makers write: every variant and trap, and real exports.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "fitter/import.h"
#include "shared_data.h"

namespace drude {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Measurement read(const std::string& text, const std::string& format = "auto") {
    return parse_measurement_as(text, "export.dat", format);
}

std::string complaint(const std::string& text, const std::string& format = "auto") {
    try {
        read(text, format);
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "was accepted";
}

void expect_complaint(const std::string& text, const std::string& start, const std::string& part,
                      const std::string& format = "auto") {
    const std::string message = complaint(text, format);
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

void expect_row(const MeasurementRow& row, double nm, double angle, double psi, double delta) {
    EXPECT_DOUBLE_EQ(row.wavelength_nm, nm);
    EXPECT_EQ(row.angle_deg, angle);
    EXPECT_EQ(row.psi_deg, psi);
    EXPECT_EQ(row.delta_deg, delta);
}

// ---- Woollam

const std::string wvase_head = "glass, 65 70 75\nVASEmethod[Revs=50]\nOriginal[g.dat]\n";

TEST(ImportWoollam, WvaseWithDepolarizationOnItsOwnGrid) {
    const std::string text = wvase_head +
                             "nm\n300.0\t65\t12.14\t1.56\t0.37\t3.46\n"
                             "310.0\t65\t12.10\t361.5\t0.23\t2.08\n"
                             "dpolE\t300.0\t65\t2.5\t0.1\nDPOLE\t310\t65.0\t-0.5\t0.1\n"
                             "dpolE\t300.0\t55\t9\t0.1\n";
    EXPECT_EQ(recognise_measurement(text), "wvase");
    const Measurement m = read(text);
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[0], 300, 65, 12.14, 1.56);
    expect_row(m.rows[1], 310, 65, 12.10, 361.5);
    EXPECT_EQ(m.rows[0].sigma_psi_deg, 0.37);
    EXPECT_EQ(m.rows[0].sigma_delta_deg, 3.46);
    EXPECT_DOUBLE_EQ(m.rows[0].depolarization, 0.025);
    EXPECT_EQ(m.rows[1].depolarization, 0);
    EXPECT_EQ(m.rows[1].line, 6);
    EXPECT_EQ(m.header_value("sample"), "glass, 65 70 75");
    EXPECT_EQ(m.header_value("vase_method"), "Revs=50");
    EXPECT_EQ(m.header_value("original"), "g.dat");
    const auto warnings = import_warnings(m);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("1 of 2 points"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("1 of 3 rows"), std::string::npos) << warnings[1];
}

TEST(ImportWoollam, UnitsOfTheSpectralAxis) {
    const auto first_nm = [](const std::string& unit, const std::string& value) {
        return read("t\nVASEmethod[a]\n" + unit + "\n" + value + "\t70\t30\t100\n")
            .rows[0]
            .wavelength_nm;
    };
    EXPECT_EQ(first_nm("nm", "435.8"), 435.8);
    EXPECT_EQ(first_nm("Angstroms", "4358"), 435.8);
    EXPECT_EQ(first_nm("um", "0.4358"), 435.8);
    EXPECT_EQ(first_nm("microns", "0,4358"), 435.8);
    EXPECT_NEAR(first_nm("eV", "2.0"), 619.92099216, 1e-8);
    EXPECT_DOUBLE_EQ(first_nm("1/cm", "20000"), 500);
    expect_complaint("t\nVASEmethod[a]\nfurlongs\n4\t70\t30\t100\n",
                     "export.dat:3: ", "'furlongs', expected a unit");
    expect_complaint("t\nVASEmethod[a]\n400\t70\t30\t100\n", "export.dat:", "no unit");
}

TEST(ImportWoollam, CompleteEaseRowsAndIntensities) {
    const std::string text =
        "2nm SiO2 on Si\nVASEmethod[CompleteEASE=6.37]\nAngstroms\n"
        "E\t1930.0\t50.0\t40.0\t142.1\t0.008\t0.034\ne\t1940.0\t50.0\t40.1\t-87.5\t0.007\t0.031\n"
        "dPolE\t1930.0\t50.0\t1.8\t0.16\nuR\t1930.0\t50.0\t0.5\tinf\n";
    EXPECT_EQ(recognise_measurement(text), "completeease");
    const Measurement m = read(text);
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[1], 194, 50, 40.1, -87.5);
    EXPECT_DOUBLE_EQ(m.rows[0].depolarization, 0.018);
    EXPECT_EQ(m.rows[1].depolarization, -1);
    ASSERT_EQ(import_warnings(m).size(), 1u);
    EXPECT_NE(import_warnings(m)[0].find("1 rows of intensities"), std::string::npos);
    // Round trip through the project's own file, warnings included.
    const Measurement again = parse_measurement(format_measurement(m), "m.csv");
    EXPECT_EQ(again.rows.size(), 2u);
    EXPECT_EQ(import_warnings(again), import_warnings(m));
}

TEST(ImportWoollam, M2000TriplesWithTrailingTabAndAngleZero) {
    const std::string text =
        "\r\nVASEmethod[CompleteEASE=3.65]\r\nnm\r\n"
        "370.3\t70.0\t21.4\t145.7\t0.0140\t0.0318\t\r\ndPolE\t370.3\t0.000\t-5.28\t1.0\r\n"
        "uR\t370.3\t0.000\t0.65\t1.0\r\n"
        "371.9\t70.0\t21.0\t147.7\t0.0130\t0.0295\t\r\ndPolE\t371.9\t0.000\t4\t1.0\r\n";
    const Measurement m = read(text);
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[0], 370.3, 70, 21.4, 145.7);
    EXPECT_EQ(m.rows[0].depolarization, 0);
    EXPECT_EQ(m.rows[1].depolarization, 0.04);
    EXPECT_TRUE(m.has_sigma());
    EXPECT_EQ(m.header_value("sample"), "");
}

TEST(ImportWoollam, DynamicIsOneTimeSliceOrRefused) {
    const std::string head = "t\nVASEmethod[CompleteEASE=3.65]\nDynamic\nnm\n";
    const std::string first = "370\t70\t21.4\t145.7\t0.01\t0.03\t\t0.105\n";
    const Measurement m = read(head + first + "371\t70\t21.3\t145.9\t0.01\t0.03\t\t0.105\n");
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[1], 371, 70, 21.3, 145.9);
    EXPECT_EQ(m.rows[1].sigma_delta_deg, 0.03);
    EXPECT_EQ(m.header_value("time_min"), "0.105");
    expect_complaint(head + first + "370\t70\t21.3\t145.9\t0.01\t0.03\t\t0.2\n",
                     "export.dat:6:", "one time slice");
}

TEST(ImportWoollam, TrigIsUndoneAndSaysWhatItLost) {
    const Measurement m = read("nm  TRIG\n300 70  .245    .123\n400 70  .283    -.034 .001 .002\n");
    ASSERT_EQ(m.rows.size(), 2u);
    EXPECT_DOUBLE_EQ(m.rows[0].psi_deg, std::atan(0.245) * degrees);
    EXPECT_DOUBLE_EQ(m.rows[1].delta_deg, std::acos(-0.034) * degrees);
    const double tangent = 0.283, cosine = -0.034;
    EXPECT_NEAR(m.rows[1].sigma_psi_deg, 0.001 / (1 + tangent * tangent) * degrees, 1e-12);
    EXPECT_NEAR(m.rows[1].sigma_delta_deg, 0.002 / std::sqrt(1 - cosine * cosine) * degrees, 1e-12);
    ASSERT_EQ(import_warnings(m).size(), 1u);
    EXPECT_NE(import_warnings(m)[0].find("0 to 180"), std::string::npos);
    // Where the sine vanishes the deviation stays finite.
    const Measurement edge = read("nm TRIG\n300 70 1 1 .001 .002\n");
    EXPECT_NEAR(edge.rows[0].sigma_delta_deg, std::sqrt(0.004) * degrees, 1e-9);
    expect_complaint("nm TRIG\n300 70 .2 1.01\n", "export.dat:2: ", "cos Delta = 1.01");
    expect_complaint("nm TRIG\n300 70 -.2 .01\n", "export.dat:2: ", "tan Psi = -0.2");
}

TEST(ImportWoollam, TrapsNameTheirLine) {
    const std::string head = wvase_head + "nm\n";
    const std::string row = "300\t65\t12\t100\n";
    expect_complaint(head + row + row, "export.dat:6: ", "twice");
    expect_complaint(head + row + "310\t65\tnan\t100\n", "export.dat:6:8: ", "'nan'");
    expect_complaint(head + "310\t65\tnan\t100\n", "export.dat:5:8: ", "'nan'");
    expect_complaint(head + row + "310\t65\t12\t100\t7\n", "export.dat:6: ", "5 numbers");
    expect_complaint(head + row + "310\t65\t12\n", "export.dat:6: ", "3 numbers");
    expect_complaint(head + row + "310\t95\t12\t100\n", "export.dat:6: ", "angle_deg = 95");
    expect_complaint(head + row + "Aps\t310\t65\t12\t100\n", "export.dat:6: ", "anisotropic");
    expect_complaint(head + row + "dpolE\t300\t65\t1\t1\ndpolE\t300\t65\t1\t1\n",
                     "export.dat:7: ", "twice");
    expect_complaint(head + row + "dpolE\t300\t65\tinf\t1\n", "export.dat:6:14: ", "'inf'");
    expect_complaint(head, "export.dat: ", "no rows", "wvase");
}

// ---- Accurion

const std::string accurion_head =
    "#Lambda\tAOI\tDelta\tPsi\tZone\tX_pos\n#nm\tdeg\tdeg\tdeg\t-\t\xB5m\n";

TEST(ImportAccurion, ZonesAreAveragedAroundTheCircle) {
    const Measurement m = read(accurion_head +
                               "658.0\t50.0\t359.0\t31.4\t4\t1\n658.0\t50.0\t1.0\t31.2\t2\t1\n"
                               "658.0\t50.0\t3.0\t31.2\t1\t1\n658.0\t50.0\t-3.0\t31.4\t3\t1\n"
                               "658.0\t50.0\t77\t77\t0\t1\n658.0\t50.0\t0.2\t0.2\t5\t1\n");
    ASSERT_EQ(m.rows.size(), 1u);
    EXPECT_NEAR(m.rows[0].psi_deg, 31.3, 1e-12);
    EXPECT_NEAR(std::remainder(m.rows[0].delta_deg, 360), 0, 1e-9);
    EXPECT_EQ(m.header_value("zones_averaged"), "4");
    EXPECT_TRUE(import_warnings(m).empty());
}

TEST(ImportAccurion, NanRowsAreDroppedWithAWarning) {
    const Measurement m =
        read(accurion_head +
             "658\t50\t10\t31\t1\t1\n658\t50\t10\t31\t2\t1\n658\t52\tNaN\tNaN\t1\t1\n"
             "658\t52\t10\t33\t2\t1\n658\t54\tNaN\tNaN\t1\t1\n658\t54\tNaN\tNaN\t0\t1\n");
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[1], 658, 52, 33, 10);
    const auto warnings = import_warnings(m);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("3 of 6 rows hold NaN"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("1 of 2 points have fewer than 2"), std::string::npos);
    expect_complaint(accurion_head + "658\t54\tNaN\tNaN\t1\t1\n", "export.dat: ", "NaN");
}

TEST(ImportAccurion, ColumnsInAnyOrderWithoutUnitsOrZones) {
    const std::string rows = "0\t40\t365.0\t6.1\t179.785156\t32.535931\n";
    const std::string names = "#ROIidx\tAOI\tLambda\tBandwidth\tDelta\tPsi\n";
    for (const char* units : {"#-\tdeg\tnm\tnm\tdeg\tdeg\n", "\n", "\t\t\t\t\t\n", ""}) {
        const Measurement m = read(names + units + rows);
        ASSERT_EQ(m.rows.size(), 1u) << units;
        expect_row(m.rows[0], 365, 40, 32.535931, 179.785156);
    }
    EXPECT_EQ(recognise_measurement(names + rows), "accurion");
    // Without "#" it is as good as any named table; asked for by name it reads the same.
    EXPECT_EQ(read("Lambda\tAOI\tPsi\tDelta\n365\t40\t30\t100\n", "accurion").rows.size(), 1u);
}

TEST(ImportAccurion, TrapsNameTheirLine) {
    const std::string row = "658\t50\t10\t31\t1\t1\n";
    expect_complaint(accurion_head + row + row, "export.dat:4: ", "map");
    expect_complaint(accurion_head + "658\t50\t10\n", "export.dat:3: ", "3 fields");
    expect_complaint(accurion_head + "658\t50\tx\t31\t1\t1\n", "export.dat:3:8: ", "'x'");
    expect_complaint(accurion_head + "658\t50\t10\t31\t9\t1\n", "export.dat:3:14: ", "zone 9");
    expect_complaint("#Lambda\tAOI\tDelta\tPsi\n#nm\trad\tdeg\tdeg\n1\t1\t1\t1\n",
                     "export.dat:2:5: ", "expected deg");
    expect_complaint("#Lambda\tAOI\tDelta\tDelta\tPsi\n1\t1\t1\t1\t1\n",
                     "export.dat:1:19: ", "twice");
    expect_complaint("#Lambda\tAOI\tDelta\n1\t1\t1\n", "export.dat:1: ", "'psi'", "accurion");
}

// ---- Horiba

TEST(ImportHoriba, BlocksAndAngles) {
    const std::string text =
        "# SAMPLE:\r\nb\xE9ton\r\n\r\n# INCIDENCE ANGLE:\r\n70.05\xB0 fixed\r\n\r\n"
        "# DATA:\r\nnm Psi Is Delta\r\n400,5 25.1 0.2 110.2\r\n410 25.3 0.3 -111.5\r\n\r\n# "
        "END:\r\n";
    EXPECT_EQ(recognise_measurement(text), "horiba");
    const Measurement m = read(text);
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[0], 400.5, 70.05, 25.1, 110.2);
    expect_row(m.rows[1], 410, 70.05, 25.3, -111.5);
    EXPECT_EQ(m.rows[0].line, 9);
    const Measurement two = read(
        "# INCIDENCE ANGLE:\n60\n\n# DATA:\neV Psi Delta\n2 20 100\n\n"
        "# INCIDENCE ANGLE:\n70\n\n# DATA:\neV Psi Delta\n2 22 90\n");
    EXPECT_EQ(two.angles(), (std::vector<double>{60, 70}));
    EXPECT_NEAR(two.rows[1].wavelength_nm, 619.92099216, 1e-8);
    // The angle may stand below the data where it is the only one.
    EXPECT_EQ(read("# DATA:\nnm Psi Delta\n400 20 100\n\n# INCIDENCE ANGLE:\n60\n").rows.size(),
              1u);
}

TEST(ImportHoriba, TrapsNameTheirLine) {
    const std::string head = "# INCIDENCE ANGLE:\n70\n\n# DATA:\n";
    expect_complaint(head + "nm Is Ic\n400 1 1\n", "export.dat:5: ", "export Psi and Delta");
    expect_complaint(head + "nm Psi Delta\n400 20\n", "export.dat:6: ", "2 fields");
    expect_complaint(head + "nm Psi Delta\n400 20 nan\n", "export.dat:6:8: ", "'nan'");
    expect_complaint(head + "nm Psi Delta\n400 20 9\n400 20 9\n", "export.dat:7: ", "twice");
    expect_complaint("# DATA:\nnm Psi Delta\n400 20 9\n", "export.dat: ", "INCIDENCE ANGLE");
    expect_complaint("# INCIDENCE ANGLE:\nsteep\n\n# DATA:\nnm Psi Delta\n400 20 9\n",
                     "export.dat:2:1: ", "expected a finite number");
    expect_complaint(head, "export.dat:4: ", "no rows");
}

// ---- Film Sense

TEST(ImportFilmSense, NcsBecomePsiAndDelta) {
    const std::string text =
        "Film_Sense_Data\n2\t1\t-70.012\t-0.002\n367.20\t14.32\t3.39\n449.64\t16.00\t6.05\n"
        "0.60270\t-0.74368\t0.28928\t0.99845\t16.5\n0.8\t0.6\t0\t1.0004\t25.2\n3\nFit_Diff\t0.1\n";
    EXPECT_EQ(recognise_measurement(text), "filmsense");
    const Measurement m = read(text);
    ASSERT_EQ(m.rows.size(), 2u);
    EXPECT_EQ(m.rows[0].wavelength_nm, 367.2);
    EXPECT_EQ(m.rows[0].angle_deg, 70.012);
    const double psi = m.rows[0].psi_deg / degrees, delta = m.rows[0].delta_deg / degrees;
    EXPECT_NEAR(std::cos(2 * psi), 0.60270, 2e-5);
    EXPECT_NEAR(std::sin(2 * psi) * std::cos(delta), -0.74368, 2e-5);
    EXPECT_NEAR(std::sin(2 * psi) * std::sin(delta), 0.28928, 2e-5);
    EXPECT_NEAR(m.rows[0].depolarization, 1 - 0.99845 * 0.99845, 1e-12);
    EXPECT_EQ(m.rows[1].depolarization, 0);
    EXPECT_NEAR(m.rows[1].psi_deg, std::acos(0.8) / 2 * degrees, 1e-12);
}

TEST(ImportFilmSense, TrapsNameTheirLine) {
    const std::string wave = "367.2 1\n";
    expect_complaint("Film_Sense_Dyn_Data\n1 7 -70\n", "export.dat:1: ", "series in time");
    expect_complaint("Film_Sense_Data\n1 3 -70\n", "export.dat:2:3: ", "one point");
    expect_complaint("Film_Sense_Data\n1e9 1 -70\n", "export.dat:2:1: ", "wavelengths");
    expect_complaint("Film_Sense_Data\n2 1 -70\n" + wave, "export.dat:3: ", "end of the file");
    expect_complaint("Film_Sense_Data\n1 1 70\n" + wave + "0 0 0 1\n",
                     "export.dat:4: ", "N = C = S");
    expect_complaint("Film_Sense_Data\n1 1 70\n" + wave + "nan 0 0 1\n",
                     "export.dat:4:1: ", "'nan'");
    expect_complaint("Film_Sense_Data\n1 1 70\n" + wave + "1 0 0\n", "export.dat:4: ", "3 fields");
    expect_complaint("Film_Sense_Data\n2 1 70\n" + wave + wave + "0 1 0 1\n0 1 0 1\n",
                     "export.dat:6: ", "twice");
}

// ---- any table

TEST(ImportTable, NamesSeparatorsAndUnits) {
    const std::vector<std::string> alike = {
        "Wavelength (nm),AOI,Psi,Delta\n400.5,65,42.5,130.75\n",
        "Psi;Delta;Wavelength;Angle of incidence\n42,5;130,75;400,5;65\n",
        "# a note\nlambda\taoi\tpsi_deg\tdelta_deg\n400,5\t65\t42,5\t130,75\n",
        "wl theta Psi Delta\nnm deg deg deg\n400.5 65 42.5 130.75\n",
        "\"Wavelength [um]\",\"Angle [deg]\",\"Psi [deg]\",\"Delta "
        "[deg]\"\n0.4005,65,42.5,130.75,\n",
        "\xCE\xBB (nm);\xCE\xB8;\xCE\xA8;\xCE\x94\r\n400,5;65;42,5;130,75\r\n",
        "Angstrom,angle,psi,delta\n4005,65,42.5,130.75\n"};
    for (const std::string& text : alike) {
        EXPECT_EQ(recognise_measurement(text), "table") << text;
        const Measurement m = read(text);
        ASSERT_EQ(m.rows.size(), 1u) << text;
        expect_row(m.rows[0], 400.5, 65, 42.5, 130.75);
        EXPECT_FALSE(m.has_sigma());
    }
}

TEST(ImportTable, DeviationsDepolarizationAndStrangers) {
    const Measurement m =
        read("Energy,AOI,Psi,Delta,Psi_err,dDelta,Depol %,Comment\n2,65,42,130,0.1,0.2,1.5,7\n");
    EXPECT_NEAR(m.rows[0].wavelength_nm, 619.92099216, 1e-8);
    EXPECT_EQ(m.rows[0].sigma_psi_deg, 0.1);
    EXPECT_EQ(m.rows[0].sigma_delta_deg, 0.2);
    EXPECT_EQ(m.rows[0].depolarization, 0.015);
    ASSERT_EQ(import_warnings(m).size(), 1u);
    EXPECT_NE(import_warnings(m)[0].find("Comment"), std::string::npos);
}

TEST(ImportTable, WithoutNamesOnlyWhereAskedFor) {
    const std::string text = "400 65 42 130\n410 65 41 131\n";
    EXPECT_EQ(recognise_measurement(text), "");
    expect_complaint(text, "export.dat: ", "--format table");
    const Measurement m = read(text, "table");
    ASSERT_EQ(m.rows.size(), 2u);
    expect_row(m.rows[1], 410, 65, 41, 131);
    expect_complaint("400 65 42\n", "export.dat:1: ", "3 numbers", "table");
}

TEST(ImportTable, TrapsNameTheirLine) {
    const std::string head = "nm,aoi,psi,delta\n";
    const std::string row = "400,65,42,130\n";
    expect_complaint(head + row + row, "export.dat:3: ", "twice", "table");
    expect_complaint(head + "400,65,42\n", "export.dat:2: ", "3 fields", "table");
    expect_complaint(head + "400,65,nan,130\n", "export.dat:2:8: ", "'nan'", "table");
    expect_complaint("nm,aoi,psi\n400,65,42\n", "export.dat:1: ", "'delta'", "table");
    expect_complaint("nm,aoi,psi,psi,delta\n1,1,1,1,1\n", "export.dat:1:12: ", "second column",
                     "table");
    expect_complaint("nm,aoi,psi,delta,dpsi\n1,1,1,1,1\n", "export.dat:1: ", "only one", "table");
}

TEST(ImportFormats, EveryFormatIsListedAndNearWordsAreOffered) {
    for (const std::string& format : measurement_formats()) {
        if (format == "auto") continue;
        EXPECT_NE(complaint("", format), "was accepted") << format;
    }
    expect_complaint("x", "found the format", "did you mean 'completeease'", "compleatease");
    expect_complaint("x", "found the format", "did you mean 'accurion'", "acurion");
    expect_complaint("\xFF\xFE;\0", "export.dat: ", "UTF-16");
}

// Any damage to a good file reads or is refused; nothing else may happen.
TEST(ImportFormats, DamagedFilesReadOrAreRefused) {
    const std::vector<std::pair<std::string, std::string>> good = {
        {"wvase", wvase_head + "Dynamic\nnm\n300\t65\t12\t1\t1\t1\t\t2\ndpolE\t300\t65\t1\t1\n"},
        {"accurion", accurion_head + "658.0\t50.0\t9.0\t31.4\t4\t1\n"},
        {"horiba", "# INCIDENCE ANGLE:\n70\n\n# DATA:\nnm Psi Delta\n400 20 9\n"},
        {"filmsense", "Film_Sense_Data\n1 1 70\n367.2 1\n0.8 0.6 0 1 2\n"},
        {"table", "Wavelength (nm),AOI,Psi,Delta\n400.5,65,42.5,130.75\n"}};
    for (const auto& [format, text] : good) {
        EXPECT_EQ(complaint(text, format), "was accepted") << format;
        int refused = 0;
        for (size_t at = 0; at < text.size(); ++at) {
            if (complaint(text.substr(0, at), format) != "was accepted") ++refused;
            for (const char c : {'\0', '\n', '\t', ' ', '#', '9', '-', ',', 'e', '\xFF'}) {
                std::string damaged = text;
                damaged[at] = c;
                if (complaint(damaged, format) != "was accepted") ++refused;
                complaint(damaged);
            }
        }
        EXPECT_GT(refused, 50) << format;
    }
}

// ---- real exports

TEST(ImportReal, CompleteEase) {
    const std::string path = shared_data("measured/completeease_SiO2_on_Si.dat");
    DRUDE_NEED_SHARED(path);
    const Measurement m = import_measurement(path);
    ASSERT_EQ(m.rows.size(), 3u * 1088);
    EXPECT_EQ(m.angles(), (std::vector<double>{50, 60, 70}));
    expect_row(m.rows.front(), 193, 50, 40.014217, 142.127655);
    expect_row(m.rows.back(), 1700, 70, 7.212368, 176.874298);
    EXPECT_EQ(m.rows.back().sigma_delta_deg, 0.216504);
    EXPECT_TRUE(m.has_sigma());
    EXPECT_TRUE(m.has_depolarization());
    EXPECT_DOUBLE_EQ(m.rows.front().depolarization, 0.01800296);
    EXPECT_EQ(m.header_value("sample"), "2nm SiO2 on Si on RC2");
    EXPECT_EQ(m.header_value("imported_from"), "CompleteEASE ASCII");
    const auto warnings = import_warnings(m);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("631 of 3264 points"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("3264 rows of intensities"), std::string::npos) << warnings[1];
}

TEST(ImportReal, M2000) {
    const std::string path = shared_data("measured/m2000_static.dat");
    DRUDE_NEED_SHARED(path);
    const Measurement m = import_measurement(path);
    ASSERT_EQ(m.rows.size(), 398u);
    EXPECT_EQ(m.angles(), (std::vector<double>{70}));
    expect_row(m.rows.front(), 370.324, 70, 21.4553, 145.7525);
    expect_row(m.rows.back(), 999.935, 70, 1.8282, 24.4792);
    EXPECT_EQ(m.rows.back().sigma_psi_deg, 0.0057);
    EXPECT_TRUE(m.has_depolarization());
    EXPECT_NE(import_warnings(m)[0].find("320 of 398 points"), std::string::npos);
}

TEST(ImportReal, WvaseTapeOnGlass) {
    const std::string path = shared_data("measured/wvase_tape_on_glass.dat");
    DRUDE_NEED_SHARED(path);
    const Measurement m = import_measurement(path);
    ASSERT_EQ(m.rows.size(), 3u * 181);
    EXPECT_EQ(m.angles(), (std::vector<double>{65, 70, 75}));
    expect_row(m.rows.front(), 300, 65, 12.140821, 1.5609661);
    expect_row(m.rows.back(), 1200, 75, 27.725864, 0.55148453);
    EXPECT_EQ(m.header_value("original"), "glas_e1.dat");
    // Its depolarization was measured at other angles.
    EXPECT_FALSE(m.has_depolarization());
    ASSERT_EQ(import_warnings(m).size(), 1u);
    EXPECT_NE(import_warnings(m)[0].find("284 of 284 rows"), std::string::npos);
}

TEST(ImportReal, WvaseSimulation) {
    const std::string path = shared_data("measured/wvase_simulated_Al.txt");
    DRUDE_NEED_SHARED(path);
    const Measurement m = import_measurement(path);
    ASSERT_EQ(m.rows.size(), 41u);
    EXPECT_EQ(m.angles(), (std::vector<double>{65}));
    expect_row(m.rows.front(), 400, 65, 42.885, 130.75);
    expect_row(m.rows.back(), 800, 65, 41.051, 152.67);
    EXPECT_FALSE(m.has_sigma());
}

}  // namespace
}  // namespace drude
