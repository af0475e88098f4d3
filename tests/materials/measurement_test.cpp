#include "materials/measurement.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace drude {
namespace {

constexpr const char* plain =
    "# sample: copper\n"
    "# notes: polished: twice\n"
    "wavelength_nm,angle_deg,psi_deg,delta_deg\n"
    "550,60,36.5,126.25\n"
    "550,70,35,-250.125\n"
    "380,60,39,480\n";

std::string complaint(const std::string& text) {
    try {
        parse_measurement(text, "m.csv");
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "was accepted";
}

// The complaint about one more row under a plain header.
std::string complaint_about_row(const std::string& row) {
    return complaint("wavelength_nm,angle_deg,psi_deg,delta_deg\n500,60,40,100\n" + row + "\n");
}

void expect_starts(const std::string& message, const std::string& start) {
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
}
void expect_holds(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Measurement, ReadsRowsHeaderAndLines) {
    const Measurement m = parse_measurement(plain, "m.csv");
    ASSERT_EQ(m.rows.size(), 3u);
    EXPECT_EQ(m.header_value("sample"), "copper");
    EXPECT_EQ(m.header_value("notes"), "polished: twice");
    EXPECT_EQ(m.header_value("absent"), "");
    EXPECT_EQ(m.rows[1].angle_deg, 70);
    EXPECT_EQ(m.rows[1].delta_deg, -250.125);
    EXPECT_EQ(m.rows[2].delta_deg, 480);
    EXPECT_EQ(m.rows[2].line, 6);
    EXPECT_EQ(m.rows[0].depolarization, -1);
    EXPECT_FALSE(m.has_sigma());
    EXPECT_FALSE(m.has_depolarization());
    EXPECT_EQ(m.wavelengths(), (std::vector<double>{380, 550}));
    EXPECT_EQ(m.angles(), (std::vector<double>{60, 70}));
}

TEST(Measurement, WindowsLinesAndColumnsInAnyOrder) {
    const Measurement m = parse_measurement(
        "\xEF\xBB\xBF# sample: x\r\nsigma_delta_deg,angle_deg,psi_deg,delta_deg,wavelength_nm,"
        "sigma_psi_deg,depolarization\r\n0.1,60,40,100,500,0.05,0.02\r\n",
        "m.csv");
    ASSERT_EQ(m.rows.size(), 1u);
    EXPECT_EQ(m.rows[0].wavelength_nm, 500);
    EXPECT_EQ(m.rows[0].sigma_psi_deg, 0.05);
    EXPECT_EQ(m.rows[0].sigma_delta_deg, 0.1);
    EXPECT_EQ(m.rows[0].depolarization, 0.02);
    EXPECT_TRUE(m.has_sigma());
    EXPECT_TRUE(m.has_depolarization());
}

TEST(Measurement, WritingAndReadingKeepsEveryBit) {
    Measurement m;
    m.header = {{"sample", "third of a\nlife"}};
    m.rows = {{1000.0 / 3, 100.0 / 3, 1e-17, -359.99999999999994, 0.05, 1.0 / 7, 1.0 / 9},
              {1000.1 + 0.2, 89.999999999, 90, 1e5, 0, 0, -1}};
    const Measurement back = parse_measurement(format_measurement(m), "m.csv");
    ASSERT_EQ(back.rows.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(back.rows[i].wavelength_nm, m.rows[i].wavelength_nm);
        EXPECT_EQ(back.rows[i].angle_deg, m.rows[i].angle_deg);
        EXPECT_EQ(back.rows[i].psi_deg, m.rows[i].psi_deg);
        EXPECT_EQ(back.rows[i].delta_deg, m.rows[i].delta_deg);
        EXPECT_EQ(back.rows[i].sigma_psi_deg, m.rows[i].sigma_psi_deg);
        EXPECT_EQ(back.rows[i].sigma_delta_deg, m.rows[i].sigma_delta_deg);
        EXPECT_EQ(back.rows[i].depolarization, m.rows[i].depolarization);
    }
    EXPECT_EQ(back.header_value("sample"), "third of a life");
}

TEST(Measurement, ColumnsAppearOnlyWhereTheyAreKnown) {
    Measurement m;
    m.rows = {{500, 60, 40, 100}};
    EXPECT_EQ(format_measurement(m), "wavelength_nm,angle_deg,psi_deg,delta_deg\n500,60,40,100\n");
    m.rows[0].sigma_psi_deg = 0.05;
    m.rows[0].sigma_delta_deg = 0.1;
    EXPECT_EQ(format_measurement(m),
              "wavelength_nm,angle_deg,psi_deg,delta_deg,sigma_psi_deg,sigma_delta_deg\n"
              "500,60,40,100,0.05,0.1\n");
}

TEST(Measurement, ErrorsNameTheLine) {
    expect_starts(complaint_about_row("500,0,40,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("500,90,40,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("0,70,40,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("-5,70,40,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("500,70,-0.001,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("500,70,90.001,100"), "m.csv:3: ");
    expect_starts(complaint_about_row("500,70,nan,100"), "m.csv:3:8: ");
    expect_starts(complaint_about_row("500,70,40,inf"), "m.csv:3:11: ");
    expect_starts(complaint_about_row("500,70,40"), "m.csv:3: ");
    expect_starts(complaint_about_row("500,70,40,banana"), "m.csv:3:11: ");
}

TEST(Measurement, DuplicatesNameBothLines) {
    const std::string message = complaint(
        "wavelength_nm,angle_deg,psi_deg,delta_deg\n500,60,40,100\n500,70,40,90\n\n"
        "500,60,40.1,100\n");
    expect_starts(message, "m.csv:5: ");
    expect_holds(message, "line 2");
    expect_holds(message, "line 5");
}

TEST(Measurement, ColumnsThatAreWrongMissingOrDouble) {
    expect_holds(complaint("wavelength_nm,angle_deg,psi_deg,delta\n500,60,40,100\n"), "'delta'");
    expect_holds(complaint("wavelength_nm,angle_deg,psi_deg,detla_deg\n500,60,40,100\n"),
                 "did you mean 'delta_deg'");
    expect_holds(complaint("wavelength_nm,angle_deg,psi_deg\n500,60,40\n"), "'delta_deg'");
    expect_holds(complaint("wavelength_nm,psi_deg,psi_deg,delta_deg\n500,60,40,1\n"), "'psi_deg'");
    expect_holds(complaint("wavelength_nm,angle_deg,psi_deg,delta_deg,sigma_psi_deg\n"
                           "500,60,40,1,1\n"),
                 "both or none");
    expect_holds(complaint("wavelength_nm,angle_deg,offset_deg,reflectance_s\n500,60,1,1\n"),
                 "lobe scan");
}

TEST(Measurement, NothingIsNoMeasurement) {
    expect_holds(complaint("wavelength_nm,angle_deg,psi_deg,delta_deg\n"), "no rows");
    expect_holds(complaint(""), "m.csv");
    expect_holds(complaint("\n\n# only: comments\n"), "m.csv");
}

TEST(Measurement, SigmasAndDepolarizationAreChecked) {
    const std::string head =
        "wavelength_nm,angle_deg,psi_deg,delta_deg,sigma_psi_deg,sigma_delta_deg,depolarization\n";
    expect_starts(complaint(head + "500,60,40,100,-0.1,0.1,0\n"), "m.csv:2: ");
    expect_starts(complaint(head + "500,60,40,100,0.1,0.1,1.5\n"), "m.csv:2: ");
    EXPECT_EQ(parse_measurement(head + "500,60,40,100,0,0.1,-1\n", "m.csv").has_sigma(), false);
}

}  // namespace
}  // namespace drude
