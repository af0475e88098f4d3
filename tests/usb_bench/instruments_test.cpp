// The project's drivers, through libusb, against the virtual devices one at a time.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "device/virtual/ellipsometer_simulation.h"
#include "device/virtual/virtual_optics.h"
#include "usb_bench/bench_options.h"
#include "usb_bench/bench_runs.h"

namespace drude {
namespace {

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// What a bench of these options shows with every mount at 0 and the arms at 70 degrees.
std::vector<uint32_t> true_frame(const std::vector<std::string>& device, double seconds) {
    std::vector<std::string> words = device;
    words.insert(words.end(), {"--", "true"});
    const VirtualOptics optics(find_material("Cu-McPeak"),
                               usb_bench::parse_bench_options(words).settings);
    OpticalState state;
    state.polariser_deg = state.analyser_deg = 0;
    state.retarder_in = true;
    return optics.frame(state, seconds, 0, 0);
}

void expect_frame(const std::string& scheme, size_t pixels) {
    const TemporaryFolder folder;
    const std::string device = scheme + ":SN0042";
    const BenchRun run =
        run_on_bench(folder, "--device " + device, "{client} spectrometer " + device + " 0.002");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.report["troubles"].size(), 0U);
    const std::vector<std::string> printed = lines(run.out);
    ASSERT_EQ(printed.size(), pixels + 1);
    EXPECT_EQ(printed[0].substr(0, 12), "SN0042 " + std::to_string(pixels) + " ");
    const std::vector<uint32_t> truth = true_frame({"--device", device}, 0.002);
    ASSERT_EQ(truth.size(), pixels);
    uint32_t brightest = 0;
    for (size_t i = 0; i < pixels; ++i) {
        EXPECT_EQ(printed[i + 1], std::to_string(truth[i])) << "pixel " << i;
        brightest = std::max(brightest, truth[i]);
    }
    EXPECT_GT(brightest, 1000U);  // a dark frame would prove little
}

TEST(Instruments, Usb4000GivesTheFrameOfTheBench) {
    expect_frame("ooi", 3840);
}

TEST(Instruments, StsGivesTheFrameOfTheBench) {
    expect_frame("obp", 1024);
}

TEST(Instruments, ElliptecMountsTurnAndReport) {
    const TemporaryFolder folder;
    for (const char* address : {"0", "1", "2"}) {
        const BenchRun run =
            run_on_bench(folder, "--device ell:DK0AELL1",
                         std::string("{client} rotator ell:DK0AELL1/") + address + " 45 -30 400");
        ASSERT_EQ(run.status, 0) << run.err;
        const std::vector<std::string> printed = lines(run.out);
        ASSERT_EQ(printed.size(), 3U) << run.out;
        // A pulse is 0.0025 degrees.
        EXPECT_NEAR(std::stod(printed[0]), 45, 0.002);
        EXPECT_NEAR(std::stod(printed[1]), -30, 0.002);
        EXPECT_NEAR(std::stod(printed[2]), 400, 0.002);
        // The kernel's driver for the chip was taken off, and put back (or it were a trouble).
        EXPECT_EQ(run.report["drivers_detached"], 1);
        EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
    }
}

TEST(Instruments, K10cr1TurnsAndReports) {
    const TemporaryFolder folder;
    const BenchRun run = run_on_bench(folder, "--device apt-sample:55000001 --device ooi:SN1",
                                      "{client} rotator apt:55000001 70 -12.5");
    ASSERT_EQ(run.status, 0) << run.err;
    const std::vector<std::string> printed = lines(run.out);
    ASSERT_EQ(printed.size(), 2U) << run.out;
    EXPECT_NEAR(std::stod(printed[0]), 70, 1e-5);
    EXPECT_NEAR(std::stod(printed[1]), -12.5, 1e-5);
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
}

TEST(Instruments, HeadGivesPsiAndDeltaOfTheSample) {
    const TemporaryFolder folder;
    const BenchRun run = run_on_bench(folder, "--device usbtmc:TMC0001 --material Au-McPeak",
                                      "{client} head usbtmc:1209:5e11:TMC0001 65");
    ASSERT_EQ(run.status, 0) << run.err;
    const std::vector<std::string> printed = lines(run.out);
    const Measurement truth =
        simulate_ellipsometer(find_material("Au-McPeak"), {{65}, {380, 390, 780}, 0, 0, 1});
    ASSERT_EQ(printed.size(), 42U);
    std::istringstream last(printed.back());
    double nm = 0, psi = 0, delta = 0;
    last >> nm >> psi >> delta;
    EXPECT_EQ(nm, 780);
    EXPECT_NEAR(psi, truth.rows[2].psi_deg, 1e-12);
    EXPECT_NEAR(delta, truth.rows[2].delta_deg, 1e-12);
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
}

TEST(Instruments, ALostSyncByteIsNotAFrame) {
    const TemporaryFolder folder;
    // The other part of the last frame that the client asks for.
    const BenchRun clean = run_on_bench(folder, "--device ooi:SN1 --answers answers.txt",
                                        "{client} spectrometer ooi:SN1 0.002");
    ASSERT_EQ(clean.status, 0) << clean.err;
    const int last = clean.report["answers"].get<int>() - 1;
    ASSERT_NE(lines(read_text(folder.file("answers.txt"))).back().find("other part"),
              std::string::npos);
    const BenchRun run =
        run_on_bench(folder, "--device ooi:SN1 --fault sync@" + std::to_string(last),
                     "{client} spectrometer ooi:SN1 0.002");
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.report["faults_applied"], 1);
    EXPECT_NE(run.err.find("ooi:SN1"), std::string::npos) << run.err;
}

// Whether the device leaves while it is written to or while it is read from, it is said to be gone.
TEST(Instruments, UnpluggedDuringAnyTransferIsSaidToBe) {
    const TemporaryFolder folder;
    const std::string device = "--device ell:DK0AELL1 --answers answers.txt ";
    const std::string client = "{client} rotator ell:DK0AELL1/0 45 -30";
    ASSERT_EQ(run_on_bench(folder, device, client).status, 0);
    int bulk = 0;
    for (const std::string& answer : lines(read_text(folder.file("answers.txt")))) {
        if (answer.find("\tcommand") == std::string::npos &&
            answer.find("\tanswer") == std::string::npos) {
            continue;
        }
        const BenchRun run = run_on_bench(
            folder, device + "--fault unplug@" + answer.substr(0, answer.find('\t')), client);
        EXPECT_EQ(run.status, 3) << answer;
        EXPECT_NE(run.err.find("it was unplugged"), std::string::npos) << answer << run.err;
        EXPECT_EQ(run.report["troubles"].size(), 0U) << answer << run.err;
        ++bulk;
    }
    EXPECT_GE(bulk, 8);
}

TEST(Instruments, ASerialNumberThatCannotBeReadIsNotTakenForAnother) {
    const TemporaryFolder folder;
    const std::string client = "{client} rotator apt:55000001 70";
    // Asked again after one failure.
    BenchRun run = run_on_bench(folder, "--device apt-sample:55000001 --fault stall@0", client);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.report["faults_applied"], 1);
    run = run_on_bench(folder, "--device apt-sample:55000001 --fault stall@0 --fault stall@1",
                       client);
    EXPECT_EQ(run.status, 3);
    EXPECT_NE(run.err.find("could not be read (Pipe error)"), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("no Thorlabs"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace drude
