#include "device/instruments/scpi_head.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "device/fake_tmc.h"
#include "device/scpi_bytes.h"

namespace drude {
namespace {

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
        return scpi_block(bytes) + "\n";
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
