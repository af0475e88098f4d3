#include "materials/lobe_scan.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace drude {
namespace {

const std::string good =
    "# sample: brushed copper\n"
    "# detector_solid_angle_sr: 0.001\n"
    "# detector_half_angle_deg: 1.02\n"
    "wavelength_nm,angle_deg,offset_deg,reflectance_s,reflectance_p,sigma_s,sigma_p\n"
    "550,60,-1,0.12,0.1,0.001,0.001\n"
    "550,60,0,0.13,0.11,0.001,0.001\n"
    "550,60,1.5,-0.0001,0.1,0.001,0.001\n";

void expect_refusal(std::string text, const std::string& from, const std::string& to,
                    const std::string& part) {
    const size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    try {
        parse_lobe_scan(text, "scan.csv");
        FAIL() << to;
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        EXPECT_NE(error.message().find(part), std::string::npos) << error.message();
        EXPECT_NE(error.message().find("scan.csv"), std::string::npos) << error.message();
    }
}

TEST(LobeScan, ReadsAndWritesBackTheSame) {
    const LobeScan scan = parse_lobe_scan(good, "scan.csv");
    ASSERT_EQ(scan.rows.size(), 3u);
    EXPECT_EQ(scan.detector_solid_angle_sr, 0.001);
    EXPECT_EQ(scan.detector_half_angle_deg, 1.02);
    EXPECT_EQ(scan.rows[2].offset_deg, 1.5);
    EXPECT_EQ(scan.rows[2].reflectance_s, -0.0001);
    EXPECT_EQ(scan.rows[2].line, 7);
    EXPECT_EQ(format_lobe_scan(scan), good);
}

TEST(LobeScan, BadInputIsNamedWithItsLine) {
    expect_refusal(good, "# detector_solid_angle_sr: 0.001\n", "", "detector_solid_angle_sr");
    expect_refusal(good, "deg: 1.02", "deg: wide", "'wide'");
    expect_refusal(good, "deg: 1.02", "deg: 0", "above 0");
    expect_refusal(good, "sr: 0.001", "sr: 7", "2 pi");
    expect_refusal(good, "sigma_s,", "sgma_s,", "did you mean 'sigma_s'");
    expect_refusal(good, ",sigma_p\n", ",depth\n", "'depth'");
    expect_refusal(good, "60,1.5", "60,30", "scan.csv:7");
    expect_refusal(good, "60,1.5", "60,0", "line 6");
    expect_refusal(good, "60,1.5", "90,0.5", "scan.csv:7");
    expect_refusal(good, "550,60,0", "-550,60,0", "scan.csv:6");
    expect_refusal(good, "0.13,0.11,0.001", "0.13,0.11,0", "sigma_s");
    expect_refusal(good, "0.13,0.11", "nan,0.11", "scan.csv:6");
    expect_refusal(good.substr(0, good.find("550,60,-1")), "# sample", "# item", "no rows");
    expect_refusal("wavelength_nm,angle_deg,psi_deg,delta_deg\n550,60,40,100\n", "550", "551",
                   "Psi and Delta");
}

}  // namespace
}  // namespace drude
