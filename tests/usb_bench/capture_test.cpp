// `drude devices` and `drude capture`, the programs themselves, on the virtual USB bench.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "device/virtual/ellipsometer_simulation.h"
#include "materials/measurement.h"
#include "usb_bench/bench_runs.h"
#include "usb_bench/capture_runs.h"

namespace drude {
namespace {

const std::string mounts =
    "--device ell:DK0AELL1 --device apt-sample:55000001 --device apt-arm:55000002 ";
const std::string capture = "{drude} capture recipe.json --instrument bench.json --wait 0.3 -o ";

// With recipe and bench file, written by a bench that has everything.
void prepare(const TemporaryFolder& folder, const std::string& recipe = short_recipe) {
    write_text(folder.file("recipe.json"), recipe);
    const BenchRun run =
        run_on_bench(folder, mounts + "--device ooi:USB4C00001 --bench-out bench.json", "true");
    ASSERT_EQ(run.status, 0) << run.err;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in: " << text;
    }
}

TEST(UsbBench, DevicesAreListedWithTheirSerials) {
    const TemporaryFolder folder;
    const BenchRun run = run_on_bench(folder, "", "{drude} devices");
    EXPECT_EQ(run.status, 0) << run.err;
    expect_words(run.out, {"USB4C00001", "USB4000", "DK0AELL1", "55000001", "55000002", "TMC0001"});
}

TEST(UsbBench, AShortSweepGivesTheTruth) {
    const TemporaryFolder folder;
    // Two cycles: Delta with its sign, by way of the retarder's calibration.
    std::string recipe = short_recipe;
    recipe.replace(recipe.find("\"steps\": 3, \"cycles\": 1"), 23, "\"steps\": 5, \"cycles\": 2");
    prepare(folder, recipe);
    const BenchRun run = run_on_bench(folder, mounts + "--device ooi:USB4C00001",
                                      capture + "m.csv --integration 4 --wavelengths 400:780:5");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
    // The chips of all three lines had the kernel's driver.
    EXPECT_GE(run.report["drivers_detached"].get<int>(), 3);
    const Measurement measured = read_measurement(folder.file("m.csv"));
    const Measurement truth =
        simulate_ellipsometer(find_material("Cu-McPeak"), {{70}, measured.wavelengths(), 0, 0, 1});
    ASSERT_EQ(measured.rows.size(), 77U);
    for (size_t i = 0; i < truth.rows.size(); ++i) {
        // Bins of 5 nm, and counts that are whole numbers.
        EXPECT_NEAR(measured.rows[i].psi_deg, truth.rows[i].psi_deg, 0.05);
        EXPECT_NEAR(measured.rows[i].delta_deg, truth.rows[i].delta_deg, 0.1);
    }
}

TEST(UsbBench, NoSpectrometerSaysWhatIsThere) {
    const TemporaryFolder folder;
    prepare(folder);
    const BenchRun run = run_on_bench(folder, mounts, capture + "m.csv");
    EXPECT_EQ(run.status, 3);
    expect_words(run.err, {"USB4C00001", "plugged in", "drude devices"});
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
}

TEST(UsbBench, TwoSpectrometersWithoutANameAreAmbiguous) {
    const TemporaryFolder folder;
    prepare(folder);
    std::string bench = read_text(folder.file("bench.json"));
    bench.replace(bench.find("ooi:USB4C00001"), 14, "ooi:");
    write_text(folder.file("bench.json"), bench);
    BenchRun run =
        run_on_bench(folder, mounts + "--device ooi:SN1 --device ooi:SN2", capture + "m.csv");
    EXPECT_EQ(run.status, 2);
    expect_words(run.err, {"say which one", "ooi:SN1", "ooi:SN2"});
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
    // Identical ones that have no serial number at all cannot be told apart either.
    run = run_on_bench(folder, mounts + "--device ooi: --device ooi:", capture + "m.csv");
    EXPECT_EQ(run.status, 2);
    expect_words(run.err, {"2 devices fit", "no serial number tells them apart", "unplug",
                           "on bus 001, device 005", "on bus 001, device 006"});
    EXPECT_EQ(run.err.find("say which one"), std::string::npos) << run.err;
    // One that can be named beside one that cannot.
    run = run_on_bench(folder, mounts + "--device ooi:SN1 --device ooi:", capture + "m.csv");
    EXPECT_EQ(run.status, 2);
    expect_words(run.err, {"say which one: ooi:SN1;", "unplug all of these but", "device 006"});
    // Named, it is opened though another one like it is there: never by its place in a list.
    prepare(folder);
    run = run_on_bench(folder, mounts + "--device ooi:SN2 --device ooi:USB4C00001",
                       capture + "m.csv");
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(UsbBench, WrongPermissionGetsTheUdevRule) {
    const TemporaryFolder folder;
    prepare(folder);
    const BenchRun run =
        run_on_bench(folder, mounts + "--device ooi:USB4C00001,refused", capture + "m.csv");
    EXPECT_EQ(run.report["status"], 3);
    expect_words(run.err, {"may not open it", "/etc/udev/rules.d/",
                           "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"2457\""});
}

TEST(UsbBench, ABusyDeviceIsNotTakenAway) {
    const TemporaryFolder folder;
    prepare(folder);
    const BenchRun run =
        run_on_bench(folder, mounts + "--device ooi:USB4C00001,busy", capture + "m.csv");
    EXPECT_EQ(run.status, 3);
    expect_words(run.err, {"ooi:USB4C00001", "another program has it open"});
    EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
}

TEST(UsbBench, UnpluggedBetweenSweepsIsSaid) {
    const TemporaryFolder folder;
    prepare(folder);
    const std::string devices = mounts + "--device ooi:USB4C00001 --answers answers.txt ";
    const BenchRun first = run_on_bench(folder, devices, capture + "m.csv");
    ASSERT_EQ(first.status, 0) << first.err;
    // The first question of the second sweep.
    const std::string fault =
        "--fault unplug@" + std::to_string(first.report["answers"].get<int>());
    const std::string one = capture + "a.csv", other = capture + "b.csv";
    const BenchRun second =
        run_on_bench(folder, devices + fault, "sh -c '" + one + " && " + other + "'");
    EXPECT_EQ(second.report["faults_applied"], 1);
    EXPECT_EQ(second.status, 3) << second.err;
    expect_words(second.err, {"plugged in"});
    EXPECT_TRUE(std::filesystem::exists(folder.file("a.csv")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.csv")));
}

TEST(UsbBench, AHeadSweepGivesItsPsiAndDeltaAndGoesOn) {
    const TemporaryFolder folder;
    const std::string device = "--device usbtmc:TMC0001 --answers answers.txt ";
    const std::string head =
        "{drude} capture --instrument usbtmc:1209:5e11:TMC0001 --angles 60,70 --sample Cu-McPeak "
        "--json --wait 0.3 -o ";
    const BenchRun whole = run_on_bench(folder, device, head + "m.csv");
    ASSERT_EQ(whole.status, 0) << whole.err;
    const nlohmann::json document = nlohmann::json::parse(whole.out);
    EXPECT_EQ(document["rows"], 82);
    EXPECT_EQ(document["retries"], 0);
    EXPECT_EQ(document["resumed"], false);
    EXPECT_TRUE(document["warnings"].is_array());
    const Measurement measured = read_measurement(folder.file("m.csv"));
    const Measurement truth = simulate_ellipsometer(find_material("Cu-McPeak"),
                                                    {{60, 70}, measured.wavelengths(), 0, 0, 1});
    ASSERT_EQ(measured.rows.size(), truth.rows.size());
    for (size_t i = 0; i < truth.rows.size(); ++i) {
        EXPECT_NEAR(measured.rows[i].psi_deg, truth.rows[i].psi_deg, 1e-9);
        EXPECT_NEAR(measured.rows[i].delta_deg, truth.rows[i].delta_deg, 1e-9);
    }
    // Unplugged for good at the last answer, which is of the second angle.
    const int last = whole.report["answers"].get<int>() - 1;
    const std::string fault = "--fault unplug@" + std::to_string(last) + " ";
    BenchRun run = run_on_bench(folder, device + fault, head + "n.csv");
    EXPECT_EQ(run.status, 3);
    expect_words(run.err, {"usbtmc:1209:5e11:TMC0001", "unplugged", "1 of 2 angles", "--resume"});
    EXPECT_EQ(run.out, "");
    run = run_on_bench(folder, device, head + "n.csv --resume");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["resumed"], true);
    const Measurement resumed = read_measurement(folder.file("n.csv"));
    ASSERT_EQ(resumed.rows.size(), truth.rows.size());
    for (size_t i = 0; i < truth.rows.size(); ++i) {
        EXPECT_EQ(resumed.rows[i].psi_deg, measured.rows[i].psi_deg);
    }
}

// Several faults in one sweep, as they come: the right measurement, or an error and the rest of it.
TEST(UsbBench, RandomFaultsEndInTheMeasurementOrAResumableJournal) {
    const TemporaryFolder folder;
    write_text(folder.file("recipe.json"), short_recipe);
    const std::string devices =
        "--device obp:STS1 --device ell:D1 --fixed-analyser 45 --bench-out bench.json ";
    const std::string whole = capture + "m.csv";
    const BenchRun clean = run_on_bench(folder, devices, whole);
    ASSERT_EQ(clean.status, 0) << clean.err;
    const std::string range = std::to_string(clean.report["answers"].get<int>());
    int applied = 0;
    for (const char* seed : {"1", "2", "3"}) {
        const std::string file = std::string("r") + seed + ".csv";
        const BenchRun run =
            run_on_bench(folder, devices + "--random-faults " + seed + ":4:" + range,
                         capture + file + " --on-failure " + capture + file + " --resume");
        applied += run.report["faults_applied"].get<int>();
        EXPECT_EQ(run.report["troubles"].size(), 0U) << run.err;
        EXPECT_EQ(run.status, 0) << seed << run.err;
        EXPECT_TRUE(std::filesystem::exists(folder.file(file))) << seed;
    }
    EXPECT_GE(applied, 3);
}

}  // namespace
}  // namespace drude
