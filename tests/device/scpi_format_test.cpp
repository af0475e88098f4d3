#include "device/instruments/scpi_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "device/ftdi_packets.h"
#include "device/scpi_bytes.h"

namespace drude {
namespace {

TEST(ScpiBlock, DefiniteLength) {
    EXPECT_EQ(parse_scpi_block("#15hello", "head"), "hello");
    EXPECT_EQ(parse_scpi_block("#15hello\n", "head"), "hello");
    EXPECT_EQ(parse_scpi_block("#3005hello", "head"), "hello");
    EXPECT_EQ(parse_scpi_block("#10", "head"), "");
    EXPECT_EQ(parse_scpi_block("#14\n\n\n\n\n", "head"), "\n\n\n\n");
}

TEST(ScpiBlock, WhatIsNone) {
    for (const char* answer :
         {"", "#", "#0hello", "#1", "#15hell", "#15hello!", "#15hello\n\n", "#2 5hello",
          "#2-5hello", "#9", "#9999999999", "#X5hello", "hello", "#2+5hello", "#299short"}) {
        EXPECT_EQ(fault_of([&] { parse_scpi_block(answer, "head"); }), Fault::bad_frame) << answer;
    }
}

TEST(ScpiNumber, ReadsDecimalsAndWhatStandsForNone) {
    EXPECT_EQ(parse_scpi_number("  +1.25E+2\n", "head"), 125);
    EXPECT_EQ(parse_scpi_number("-0.5", "head"), -0.5);
    EXPECT_TRUE(std::isnan(parse_scpi_number("9.91E37", "head")));
    EXPECT_TRUE(std::isnan(parse_scpi_number("+9.910000E+37", "head")));
    EXPECT_TRUE(std::isnan(parse_scpi_number("NaN", "head")));
    EXPECT_EQ(parse_scpi_number("9.9E37", "head"), INFINITY);
    EXPECT_EQ(parse_scpi_number("-9.9E+37", "head"), -INFINITY);
    EXPECT_EQ(parse_scpi_number("NINF", "head"), -INFINITY);
    for (const char* text : {"", " ", "1,2", "one", "1 2", "0x10", "infinity", "1e999", "--1"}) {
        EXPECT_EQ(fault_of([&] { parse_scpi_number(text, "head"); }), Fault::bad_frame) << text;
    }
}

TEST(ScpiNumbers, InEveryFormat) {
    const std::vector<double> expected = {400, -1.5, 123.25};
    EXPECT_EQ(parse_scpi_numbers("400, -1.5,1.2325E2\n", ScpiFormat::ascii, false, "h"), expected);
    EXPECT_EQ(parse_scpi_numbers(scpi_block("400,-1.5,123.25"), ScpiFormat::ascii, false, "h"),
              expected);
    // 400 = 1.5625 2^8, -1.5, 123.25 = 1.92578125 2^6 in IEEE 754, by hand.
    const std::string floats("\x43\xC8\0\0\xBF\xC0\0\0\x42\xF6\x80\0", 12);
    EXPECT_EQ(parse_scpi_numbers(scpi_block(floats) + "\n", ScpiFormat::real32, false, "h"),
              expected);
    std::string swapped(floats);
    for (size_t at = 0; at < swapped.size(); at += 4) {
        std::reverse(swapped.begin() + static_cast<int>(at),
                     swapped.begin() + static_cast<int>(at) + 4);
    }
    EXPECT_EQ(parse_scpi_numbers(scpi_block(swapped), ScpiFormat::real32, true, "h"), expected);
    std::string doubles;
    for (const double value : expected) doubles += big_endian(std::bit_cast<uint64_t>(value));
    EXPECT_EQ(parse_scpi_numbers(scpi_block(doubles), ScpiFormat::real64, false, "h"), expected);
}

TEST(ScpiNumbers, NoneAndInfinityAsFloatsToo) {
    const std::string none = big_endian(std::bit_cast<uint32_t>(9.91e37F));
    const std::string infinite = big_endian(std::bit_cast<uint32_t>(-9.9e37F));
    const std::string nan = big_endian(std::bit_cast<uint32_t>(std::nanf("")));
    const std::vector<double> values =
        parse_scpi_numbers(scpi_block(none + infinite + nan), ScpiFormat::real32, false, "h");
    ASSERT_EQ(values.size(), 3u);
    EXPECT_TRUE(std::isnan(values[0]));
    EXPECT_EQ(values[1], -INFINITY);
    EXPECT_TRUE(std::isnan(values[2]));
}

TEST(ScpiNumbers, WhatIsNone) {
    const auto fault = [](const std::string& answer, ScpiFormat format) {
        return fault_of([&] { parse_scpi_numbers(answer, format, false, "h"); });
    };
    EXPECT_EQ(fault("", ScpiFormat::ascii), Fault::bad_frame);
    EXPECT_EQ(fault("1,,2", ScpiFormat::ascii), Fault::bad_frame);
    EXPECT_EQ(fault("1,2,", ScpiFormat::ascii), Fault::bad_frame);
    EXPECT_EQ(fault("1,2", ScpiFormat::real32), Fault::bad_frame);
    EXPECT_EQ(fault(scpi_block("1234567"), ScpiFormat::real32), Fault::bad_frame);
    EXPECT_EQ(fault(scpi_block(""), ScpiFormat::real64), Fault::bad_frame);
    EXPECT_EQ(fault("#216" + std::string(15, 'x'), ScpiFormat::real64), Fault::bad_frame);
}

TEST(ScpiError, CodeAndText) {
    EXPECT_EQ(parse_scpi_error("0,\"No error\"\n", "h").code, 0);
    const ScpiError error = parse_scpi_error("-222,\"Data out of range;SOUR:ANG 200\"\n", "h");
    EXPECT_EQ(error.code, -222);
    EXPECT_EQ(scpi_error_words(error), "-222, Data out of range;SOUR:ANG 200");
    EXPECT_EQ(scpi_error_words(parse_scpi_error("-113", "h")), "-113, command error");
    EXPECT_EQ(scpi_error_words(parse_scpi_error("-410", "h")), "-410, query error");
    EXPECT_EQ(scpi_error_words(parse_scpi_error("+7", "h")), "7, an error of the instrument's own");
    for (const char* answer : {"", "No error", "99999,\"x\"", "1.5,\"x\""}) {
        EXPECT_EQ(fault_of([&] { parse_scpi_error(answer, "h"); }), Fault::bad_frame) << answer;
    }
}

TEST(ScpiIdentity, UpToFourFields) {
    const ScpiIdentity identity = parse_scpi_identity("drude, HEAD-1,7,0.1\r\n", "h");
    EXPECT_EQ(identity.model, "HEAD-1");
    EXPECT_EQ(identity.str(), "drude, HEAD-1, 7, 0.1");
    EXPECT_EQ(parse_scpi_identity("drude,HEAD-1", "h").str(), "drude, HEAD-1");
    for (const char* answer : {"", "\n", "a\x01,b", "1,2,3,4,5"}) {
        EXPECT_EQ(fault_of([&] { parse_scpi_identity(answer, "h"); }), Fault::bad_frame);
    }
}

}  // namespace
}  // namespace drude
