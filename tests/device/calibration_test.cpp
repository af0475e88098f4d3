#include "device/signal/calibration.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace drude {
namespace {

Calibration full() {
    Calibration c;
    c.polariser_offset_deg = 0.1 + 0.2;
    c.analyser_offset_deg = -1.0 / 3;
    c.polariser_offset_sigma_deg = 0.002;
    c.source_s1 = {{400, 500, 700}, {0.01, 0.02, 1.0 / 7}};
    c.source_s2 = {{400, 500, 700}, {-0.01, 0, 1e-17}};
    c.retardance_deg = {{380, 780}, {130.2, 63.4}};
    c.diattenuation = {{380}, {0.98}};
    c.modulation_depth = {{380, 780}, {0.9999, 1.0001}};
    c.provenance = {{"straight_through", "6 scans \"as is\""}, {"azimuth", "residual"}};
    return c;
}

std::string message(const std::string& json) {
    try {
        parse_calibration(json, "cal.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "nothing";
}
void expect_says(const std::string& json, const std::string& words) {
    EXPECT_NE(message(json).find(words), std::string::npos) << message(json);
}

TEST(Calibration, ReadsBackWithTheSameBits) {
    const Calibration a = full(), b = parse_calibration(format_calibration(a), "cal.json");
    EXPECT_EQ(format_calibration(a), format_calibration(b));
    EXPECT_EQ(b.polariser_offset_deg, a.polariser_offset_deg);
    EXPECT_EQ(b.source_s1.value, a.source_s1.value);
    EXPECT_EQ(b.retardance_deg.wavelength_nm, a.retardance_deg.wavelength_nm);
    EXPECT_EQ(b.provenance, a.provenance);
    const Calibration empty = parse_calibration(format_calibration({}), "cal.json");
    EXPECT_FALSE(empty.retardance_deg.known());
}

TEST(Calibration, CurvesAreInterpolatedAndHeld) {
    const WavelengthCurve curve{{400, 500, 700}, {1, 3, 2}};
    EXPECT_EQ(curve.at(300, 9), 1);
    EXPECT_EQ(curve.at(400, 9), 1);
    EXPECT_EQ(curve.at(450, 9), 2);
    EXPECT_EQ(curve.at(500, 9), 3);
    EXPECT_EQ(curve.at(600, 9), 2.5);
    EXPECT_EQ(curve.at(900, 9), 2);
    EXPECT_EQ(WavelengthCurve().at(500, 9), 9);
}

TEST(Calibration, WhatIsWrongIsSaidWithItsPlace) {
    expect_says("{\n \"format\": \"drude-calibration/1\",\n \"retardence_deg\": {}}",
                "retardance_deg");
    expect_says("{\"format\": \"drude-calibration/2\"}", "cal.json:1:12");
    expect_says("[]", "cal.json");
    expect_says("{\"format\": \"drude-calibration/1\", \"polariser_offset_deg\": 200}",
                "-180 to 180");
    const std::string head = "{\"format\": \"drude-calibration/1\", ";
    expect_says(head + "\"diattenuation\": {\"wavelength_nm\": [400, 300], \"value\": [1, 1]}}",
                "ascend");
    expect_says(head + "\"diattenuation\": {\"wavelength_nm\": [400], \"value\": [0]}}", "above 0");
    expect_says(head + "\"diattenuation\": {\"wavelength_nm\": [400], \"value\": [1, 1]}}",
                "1 wavelengths and 2");
    expect_says(head + "\"source_s1\": {\"wavelength_nm\": [400], \"value\": [0.1]}}", "both");
    expect_says(head +
                    "\"source_s1\": {\"wavelength_nm\": [400], \"value\": [0.8]}, "
                    "\"source_s2\": {\"wavelength_nm\": [400], \"value\": [0.8]}}",
                "less than 1");
    expect_says(head + "\"provenance\": [[\"a\"]]}", "a key and a value");
    expect_says(head + "\"modulation_depth\": {\"wavelength_nm\": [], \"value\": []}}",
                "leave out");
}

}  // namespace
}  // namespace drude
