#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "device/fake_tmc.h"
#include "device/instruments/scpi_format.h"
#include "device/instruments/scpi_head.h"
#include "device/instruments/scpi_link.h"

namespace drude {
namespace {

std::string block(const std::string& bytes) {
    const std::string size = std::to_string(bytes.size());
    return "#" + std::to_string(size.size()) + size + bytes;
}

// Most significant byte first, by shifting.
template <class Bits>
std::string big_endian(Bits bits) {
    std::string bytes;
    for (int byte = sizeof(Bits) - 1; byte >= 0; --byte) {
        bytes += static_cast<char>((bits >> (8 * byte)) & 0xFF);
    }
    return bytes;
}

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
    EXPECT_EQ(parse_scpi_numbers(block("400,-1.5,123.25"), ScpiFormat::ascii, false, "h"),
              expected);
    // 400 = 1.5625 2^8, -1.5, 123.25 = 1.92578125 2^6 in IEEE 754, by hand.
    const std::string floats("\x43\xC8\0\0\xBF\xC0\0\0\x42\xF6\x80\0", 12);
    EXPECT_EQ(parse_scpi_numbers(block(floats) + "\n", ScpiFormat::real32, false, "h"), expected);
    std::string swapped(floats);
    for (size_t at = 0; at < swapped.size(); at += 4) {
        std::reverse(swapped.begin() + static_cast<int>(at),
                     swapped.begin() + static_cast<int>(at) + 4);
    }
    EXPECT_EQ(parse_scpi_numbers(block(swapped), ScpiFormat::real32, true, "h"), expected);
    std::string doubles;
    for (const double value : expected) doubles += big_endian(std::bit_cast<uint64_t>(value));
    EXPECT_EQ(parse_scpi_numbers(block(doubles), ScpiFormat::real64, false, "h"), expected);
}

TEST(ScpiNumbers, NoneAndInfinityAsFloatsToo) {
    const std::string none = big_endian(std::bit_cast<uint32_t>(9.91e37F));
    const std::string infinite = big_endian(std::bit_cast<uint32_t>(-9.9e37F));
    const std::string nan = big_endian(std::bit_cast<uint32_t>(std::nanf("")));
    const std::vector<double> values =
        parse_scpi_numbers(block(none + infinite + nan), ScpiFormat::real32, false, "h");
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
    EXPECT_EQ(fault(block("1234567"), ScpiFormat::real32), Fault::bad_frame);
    EXPECT_EQ(fault(block(""), ScpiFormat::real64), Fault::bad_frame);
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

TEST(ScpiCommand, PutsTheValueInItsPlace) {
    EXPECT_EQ(scpi_command("SOUR:ANG {} DEG", "70"), "SOUR:ANG 70 DEG");
    EXPECT_THROW(scpi_command("SOUR:ANG", "70"), Error);
}

TEST(ScpiRows, ThreeFiveOrSixColumns) {
    const std::vector<double> wavelengths = {400, 500};
    std::vector<MeasurementRow> rows =
        scpi_rows({400, 43, 110, 500, 44, 120}, wavelengths, 70, "h");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].wavelength_nm, 500);
    EXPECT_EQ(rows[1].angle_deg, 70);
    EXPECT_EQ(rows[1].psi_deg, 44);
    EXPECT_EQ(rows[1].delta_deg, 120);
    EXPECT_EQ(rows[1].sigma_psi_deg, 0);
    EXPECT_EQ(rows[1].depolarization, -1);
    rows = scpi_rows({400, 43, 110, .1, .2, 500, 44, -120, .3, NAN}, wavelengths, 70, "h");
    EXPECT_EQ(rows[0].sigma_psi_deg, .1);
    EXPECT_EQ(rows[0].sigma_delta_deg, .2);
    EXPECT_EQ(rows[1].delta_deg, -120);
    EXPECT_EQ(rows[1].sigma_delta_deg, 0);
    rows = scpi_rows({400, NAN, 110, .1, .2, 0, 500.0000001, 44, 120, .3, .4, 0.25}, wavelengths,
                     70, "h");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].wavelength_nm, 500);
    EXPECT_EQ(rows[0].depolarization, 0.25);
}

TEST(ScpiRows, WhatNoSampleGives) {
    const std::vector<double> wavelengths = {400};
    const auto fault = [&](const std::vector<double>& numbers) {
        return fault_of([&] { scpi_rows(numbers, wavelengths, 70, "h"); });
    };
    EXPECT_EQ(fault({400, 43}), Fault::bad_frame);
    EXPECT_EQ(fault({400, 43, 110, 1}), Fault::bad_frame);
    EXPECT_EQ(fault({}), Fault::bad_frame);
    EXPECT_EQ(fault({401, 43, 110}), Fault::bad_frame);
    EXPECT_EQ(fault({NAN, 43, 110}), Fault::bad_frame);
    EXPECT_EQ(fault({400, 91, 110}), Fault::bad_frame);
    EXPECT_EQ(fault({400, -1, 110}), Fault::bad_frame);
    EXPECT_EQ(fault({400, 43, INFINITY}), Fault::bad_frame);
    EXPECT_EQ(fault({400, 43, 110, -1, 0}), Fault::bad_frame);
    EXPECT_EQ(fault({400, 43, 110, 0, 0, 1.5}), Fault::bad_frame);
    EXPECT_EQ(fault({400, NAN, NAN}), Fault::refused);
}

TEST(ScpiCounts, RoundedAndClipped) {
    EXPECT_EQ(scpi_counts({0, 1.4, 1.6, 1e9, INFINITY}, 5, 65535, "h"),
              (std::vector<uint32_t>{0, 1, 2, 65535, 65535}));
    EXPECT_EQ(fault_of([&] { scpi_counts({1}, 2, 65535, "h"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { scpi_counts({-1}, 1, 65535, "h"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { scpi_counts({NAN}, 1, 65535, "h"); }), Fault::bad_frame);
}

// A head as the documented command set has it.
class ScpiHeadTest : public testing::Test {
  protected:
    FakeTmc head_;
    std::vector<std::string> errors_;  // the queue

    void SetUp() override {
        head_.answers = {{"*IDN?", "drude,HEAD-1,7,0.1\n"},
                         {"*OPC?", "1\n"},
                         {"SENS:WAV?", "400,500,600\n"},
                         {"MEAS:PSID?", "400,43,110,500,44,120,600,45,130\n"},
                         {"MEAS:SPEC?", "100,200.4,70000\n"}};
        head_.otherwise = [this](const std::string& question) {
            if (question != "SYST:ERR?") return std::string();
            if (errors_.empty()) return std::string("0,\"No error\"\n");
            const std::string first = errors_.front();
            errors_.erase(errors_.begin());
            return first;
        };
    }
};

TEST_F(ScpiHeadTest, MeasuresPsiAndDelta) {
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port);
    EXPECT_EQ(head->uri(), "usbtmc:1209:5e11:H1");
    EXPECT_EQ(head->identity(), "drude, HEAD-1, 7, 0.1");
    const std::vector<MeasurementRow> rows = head->measure(72.5);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[2].wavelength_nm, 600);
    EXPECT_EQ(rows[2].angle_deg, 72.5);
    EXPECT_EQ(rows[2].psi_deg, 45);
    EXPECT_EQ(rows[2].delta_deg, 130);
    EXPECT_EQ(std::count(head_.messages.begin(), head_.messages.end(), "SOUR:ANG 72.5\n"), 1);
    for (const double angle : {0.0, 90.0, -70.0, std::nan("")}) {
        EXPECT_THROW(head->measure(angle), Error);
    }
}

TEST_F(ScpiHeadTest, ItsErrorQueueIsReadToTheEnd) {
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port);
    errors_ = {"-222,\"Data out of range\"\n", "+31,\"Arm blocked\"\n"};
    std::string message;
    EXPECT_EQ(fault_of([&] { head->measure(70); }, &message), Fault::refused);
    EXPECT_NE(message.find("'SOUR:ANG 70' with error -222, Data out of range; 31, Arm blocked"),
              std::string::npos)
        << message;
    EXPECT_EQ(head->measure(70).size(), 3u);
}

TEST_F(ScpiHeadTest, AQueueThatNeverEmptiesIsLeft) {
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port);
    head_.answers["SYST:ERR?"] = "-350,\"Queue overflow\"\n";
    EXPECT_EQ(fault_of([&] { head->measure(70); }), Fault::refused);
}

TEST_F(ScpiHeadTest, AHungQuestionThenTheRightAnswer) {
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port);
    head_.hang = head_.questions + 3;  // *OPC?, SYST:ERR?, then MEAS:PSID?
    std::string message;
    EXPECT_EQ(fault_of([&] { head->measure(70); }, &message), Fault::timeout);
    EXPECT_NE(message.find("MEAS:PSID?"), std::string::npos) << message;
    EXPECT_EQ(head_.aborted, 1);
    head->recover();
    EXPECT_EQ(head->measure(70).size(), 3u);
}

// What an instrument does with a question that it does not know: nothing but a note in its queue.
TEST_F(ScpiHeadTest, AnUnknownQuestionIsExplainedByTheQueue) {
    ScpiCommands commands;
    commands.psi_delta = "READ:PSI?";
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port, commands);
    const auto queue = head_.otherwise;
    head_.otherwise = [&](const std::string& question) {
        if (question == "READ:PSI?") errors_.push_back("-113,\"Undefined header\"\n");
        return queue(question);
    };
    std::string message;
    EXPECT_EQ(fault_of([&] { head->measure(70); }, &message), Fault::timeout);
    EXPECT_NE(message.find("'READ:PSI?' within 300 s; it reports error -113, Undefined header"),
              std::string::npos)
        << message;
}

TEST_F(ScpiHeadTest, FloatsInBlocks) {
    ScpiCommands commands;
    commands.format = ScpiFormat::real64;
    commands.setup = {"FORM REAL,64"};
    commands.psi_delta = "READ:ELL?";
    const auto doubles = [](const std::vector<double>& values) {
        std::string bytes;
        for (const double value : values) bytes += big_endian(std::bit_cast<uint64_t>(value));
        return block(bytes) + "\n";
    };
    head_.answers["SENS:WAV?"] = doubles({400, 500});
    head_.answers["READ:ELL?"] = doubles({400, 43, 110, 0.01, 0.02, 500, 44, 120, 0.01, 0.02});
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port, commands);
    EXPECT_EQ(std::count(head_.messages.begin(), head_.messages.end(), "FORM REAL,64\n"), 1);
    const std::vector<MeasurementRow> rows = head->measure(70);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].sigma_delta_deg, 0.02);
}

TEST_F(ScpiHeadTest, WavelengthsMustAscend) {
    for (const char* answer : {"400,400", "500,400", "-1,400", "400,9.91E37", ""}) {
        head_.answers["SENS:WAV?"] = answer;
        EXPECT_NE(fault_of([&] { open_scpi_head(head_.port); }), Fault::refused) << answer;
    }
}

TEST_F(ScpiHeadTest, AnotherInstrumentInItsPlace) {
    const std::shared_ptr<PsiDeltaHead> head = open_scpi_head(head_.port);
    head_.port->unplug();
    EXPECT_EQ(fault_of([&] { head->measure(70); }), Fault::unplugged);
    EXPECT_FALSE(head->reconnect(0.01));
    head_.port->on_reopen = [](double) { return true; };
    EXPECT_TRUE(head->reconnect(0.01));
    EXPECT_EQ(head->measure(70).size(), 3u);
    head_.answers["*IDN?"] = "drude,HEAD-1,8,0.1\n";
    EXPECT_EQ(fault_of([&] { head->reconnect(0.01); }), Fault::refused);
}

TEST_F(ScpiHeadTest, AsASpectrometer) {
    ScpiCommands commands;
    commands.lamp = "SOUR:LAMP {}";
    commands.max_counts = 4095;
    const std::shared_ptr<Spectrometer> head = open_scpi_spectrometer(head_.port, commands);
    EXPECT_EQ(head->info().uri, "usbtmc:1209:5e11:H1");
    EXPECT_EQ(head->info().model, "HEAD-1");
    EXPECT_EQ(head->info().serial, "7");
    EXPECT_EQ(head->info().wavelength_nm, (std::vector<double>{400, 500, 600}));
    EXPECT_TRUE(head->info().has_lamp_control);
    head->set_integration_time(0.025);
    EXPECT_EQ(head->integration_time(), 0.025);
    const Frame frame = head->acquire();
    EXPECT_EQ(frame.counts, (std::vector<uint32_t>{100, 200, 4095}));
    EXPECT_GE(frame.arrived_s, frame.requested_s);
    head->set_lamp(false);
    for (const double seconds : {0.0, 61.0, std::nan("")}) {
        EXPECT_THROW(head->set_integration_time(seconds), Error);
    }
    EXPECT_EQ(head->integration_time(), 0.025);
    // Set up as it was.
    head_.messages.clear();
    head->recover();
    EXPECT_EQ(std::count(head_.messages.begin(), head_.messages.end(), "SENS:INT 0.025\n"), 1);
    EXPECT_EQ(std::count(head_.messages.begin(), head_.messages.end(), "SOUR:LAMP 0\n"), 1);
    head_.answers["MEAS:SPEC?"] = "100,200\n";
    EXPECT_EQ(fault_of([&] { head->acquire(); }), Fault::bad_frame);
}

}  // namespace
}  // namespace drude
