#include "fitter/import.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "fitter/import_spectraray.h"
#include "shared_data.h"

namespace drude {
namespace {

constexpr const char* two_angles =
    "; WAVELENGTH 50.20000 50.20000 60.20000 60.20000 \n"
    "190.13558 45.74309 168.36886 55.11351 170.81765 \n"
    "190.59492 47.53618 -87.30627 51.39424 359.23138 \n";

std::string complaint(const std::string& text, const std::string& format = "auto") {
    try {
        parse_measurement_as(text, "export.txt", format);
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "was accepted";
}

void expect_starts(const std::string& message, const std::string& start) {
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
}

void expect_same_rows(const Measurement& a, const Measurement& b) {
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (size_t i = 0; i < a.rows.size(); ++i) {
        EXPECT_EQ(a.rows[i].wavelength_nm, b.rows[i].wavelength_nm);
        EXPECT_EQ(a.rows[i].angle_deg, b.rows[i].angle_deg);
        EXPECT_EQ(a.rows[i].psi_deg, b.rows[i].psi_deg);
        EXPECT_EQ(a.rows[i].delta_deg, b.rows[i].delta_deg);
    }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

TEST(Import, SpectraRayRowsAnglesAndLines) {
    const Measurement m = parse_measurement_as(two_angles, "export.txt", "auto");
    ASSERT_EQ(m.rows.size(), 4u);
    EXPECT_EQ(m.rows[0].wavelength_nm, 190.13558);
    EXPECT_EQ(m.rows[0].angle_deg, 50.2);
    EXPECT_EQ(m.rows[0].psi_deg, 45.74309);
    EXPECT_EQ(m.rows[0].delta_deg, 168.36886);
    EXPECT_EQ(m.rows[1].angle_deg, 60.2);
    EXPECT_EQ(m.rows[3].psi_deg, 51.39424);
    EXPECT_EQ(m.rows[3].delta_deg, 359.23138);
    EXPECT_EQ(m.rows[2].delta_deg, -87.30627);
    EXPECT_EQ(m.rows[3].line, 3);
    EXPECT_FALSE(m.has_sigma());
    EXPECT_NE(m.header_value("imported_from"), "");
}

TEST(Import, SpectraRayVariantsReadAlike) {
    const Measurement expected = parse_spectraray(two_angles, "a");
    expect_same_rows(expected, parse_spectraray(with(two_angles, "\n", "\r\n"), "b"));
    expect_same_rows(expected, parse_spectraray(with(two_angles, ".", ","), "c"));
    expect_same_rows(expected, parse_spectraray(with(two_angles, " ", "\t"), "d"));
    expect_same_rows(expected, parse_spectraray(with(two_angles, "; WAVE", ";wave"), "e"));
    expect_same_rows(expected, parse_spectraray("\xEF\xBB\xBF" + std::string(two_angles), "f"));
    expect_same_rows(expected,
                     parse_spectraray(two_angles + std::string("\n; a comment\n\n"), "g"));
    const std::string no_last_newline(two_angles, std::string(two_angles).size() - 2);
    expect_same_rows(expected, parse_spectraray(no_last_newline, "h"));
}

TEST(Import, SpectraRayTrapsNameTheirLine) {
    const std::string head = "; WAVELENGTH 50 50 60 60\n";
    expect_starts(complaint("; WAVELENGTH 50 50 60 70\n1 2 3 4 5\n"), "export.txt:1:20: ");
    expect_starts(complaint("; WAVELENGTH 50 50 60\n1 2 3 4\n"), "export.txt:1:20: ");
    expect_starts(complaint("; WAVELENGTH 50 50 50 50\n1 2 3 4 5\n"), "export.txt:1:20: ");
    expect_starts(complaint("; WAVELENGTH\n1 2 3\n"), "export.txt:1: ");
    expect_starts(complaint(head + "500 40 100 40 100\n500 40 100 40 100\n"), "export.txt:3: ");
    expect_starts(complaint(head + "500 40 100 40\n"), "export.txt:2: ");
    expect_starts(complaint(head + "500 40 100 40 100 7\n"), "export.txt:2: ");
    expect_starts(complaint(head + "500 40 nan 40 100\n"), "export.txt:2:8: ");
    expect_starts(complaint(head + "500 40 1,0,0 40 100\n"), "export.txt:2:8: ");
    expect_starts(complaint(head + "500 40 100 90.5 100\n"), "export.txt:2: ");
    expect_starts(complaint(head + "-500 40 100 40 100\n"), "export.txt:2: ");
    expect_starts(complaint("; WAVELENGTH 0 0\n500 40 100\n"), "export.txt:2: ");
    expect_starts(complaint(head), "export.txt: ");
    std::string mueller = "; WAVELENGTH";
    for (int i = 0; i < 16; ++i) mueller += " 70.2";
    EXPECT_NE(complaint(mueller + "\n").find("Mueller"), std::string::npos);
}

TEST(Import, FormatIsRecognisedByContentAndMayBeForced) {
    const std::string csv = "# sample: x\nwavelength_nm,angle_deg,psi_deg,delta_deg\n500,60,40,9\n";
    EXPECT_EQ(recognise_measurement(csv), "csv");
    EXPECT_EQ(recognise_measurement(two_angles), "spectraray");
    EXPECT_EQ(recognise_measurement(""), "");
    EXPECT_EQ(recognise_measurement("{\"format\": \"drude-material/1\"}"), "");
    EXPECT_EQ(parse_measurement_as(csv, "a", "auto").rows.size(), 1u);
    EXPECT_EQ(parse_measurement_as(two_angles, "a", "spectraray").rows.size(), 4u);
    EXPECT_NE(complaint(csv, "spectraray"), "was accepted");
    EXPECT_NE(complaint(csv, "spectrary").find("did you mean 'spectraray'"), std::string::npos);
    EXPECT_NE(complaint("").find("empty"), std::string::npos);
    EXPECT_NE(complaint(std::string("\0\1\2;", 4)).find("none of the formats"), std::string::npos);
}

// Any damage to a good file reads or is refused; nothing else may happen.
TEST(Import, DamagedFilesReadOrAreRefused) {
    const std::string good = two_angles;
    int refused = 0;
    for (size_t at = 0; at < good.size(); ++at) {
        for (const char c : {'\0', '\n', ' ', ';', '9', '-', ',', 'e', '\xFF'}) {
            std::string damaged = good;
            damaged[at] = c;
            if (complaint(damaged) != "was accepted") ++refused;
            if (complaint(good.substr(0, at)) != "was accepted") ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(Import, RealSpectraRayExport) {
    const std::string path = shared_data("measured/spectraray_SiO2_on_Si_50_60_70.txt");
    DRUDE_NEED_SHARED(path);
    const Measurement m = import_measurement(path);
    EXPECT_EQ(m.rows.size(), 3u * 2209);
    EXPECT_EQ(m.angles(), (std::vector<double>{50.2, 60.2, 70.2}));
    EXPECT_EQ(m.rows[0].wavelength_nm, 190.13558);
    EXPECT_EQ(m.rows[0].psi_deg, 45.74309);
    // Through the project's own format without loss.
    expect_same_rows(m, parse_measurement(format_measurement(m), "m.csv"));
}

}  // namespace
}  // namespace drude
