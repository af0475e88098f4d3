// drude capture and drude reduce as people and scripts call them, on the virtual bench.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.h"

namespace drude {
namespace {

using nlohmann::json;

constexpr const char* bench =
    R"({"format": "drude-bench/1", "virtual": {"material": "Cu-McPeak", "settings":
    {"pixels": 64, "electrons_per_count": 2, "read_noise_counts": 15, "dark_counts": 1500}}})";
const std::string quick =
    "capture --instrument b.json --angles 70 --steps 9 --averages 2 --darks 4 "
    "--wavelengths 500:700:50 ";

void expect_words(const ProgramRun& run, int status, std::initializer_list<const char*> words) {
    EXPECT_EQ(run.status, status) << run.err;
    for (const char* word : words) EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
}

TEST(Capture, MeasuresTheVirtualBenchAndSaysHow) {
    const TemporaryFolder folder;
    const ProgramRun run = run_drude(folder,
                                     "capture --instrument virtual:Cu-McPeak --angles 70 --steps 9 "
                                     "--wavelengths 500:700:50 -q -o m.csv --json");
    ASSERT_EQ(run.status, 0) << run.err;
    const json document = json::parse(run.out);
    EXPECT_EQ(document["rows"], 5);
    EXPECT_EQ(document["retries"], 0);
    EXPECT_EQ(document["resumed"], false);
    EXPECT_TRUE(document["warnings"].is_array());
    EXPECT_EQ(document["points"], 36);
    EXPECT_EQ(document["complete"], true);
    EXPECT_EQ(document["virtual"], true);
    EXPECT_GT(document["times"]["integration_s"], 0);
    const std::string text = read_text(folder.file("m.csv"));
    for (const char* key : {"# sample: Cu-McPeak\n", "no hardware was used", "# journal_sha256: ",
                            "# recipe_sha256: ", "# sigma_common_deg: ", "# quality: "}) {
        EXPECT_NE(text.find(key), std::string::npos) << key;
    }
    EXPECT_EQ(text.find("# date"), std::string::npos);
    // What it writes is what fits read.
    const ProgramRun fit = run_drude(folder, "fit m.csv -q --json -o m.json");
    ASSERT_EQ(fit.status, 0) << fit.err;
    const json fitted = json::parse(fit.out);
    EXPECT_EQ(fitted["common_errors"][0]["angle_deg"], 70);
    EXPECT_EQ(fitted["common_errors"][0]["sigma_psi_deg"], document["sigma_common_psi_deg"][0]);
    EXPECT_EQ(fitted["common_errors"][0]["sigma_delta_deg"], document["sigma_common_delta_deg"][0]);
    EXPECT_NE(fit.err.find("without a calibration of the bench"), std::string::npos) << fit.err;
    const std::string material = read_text(folder.file("m.json"));
    for (const char* said : {"sigma_common_deg", "without a calibration"}) {
        EXPECT_NE(material.find(said), std::string::npos) << said;
    }
}

TEST(Capture, TheSameSeedGivesTheSameBytes) {
    const TemporaryFolder folder;
    write_text(folder.file("b.json"), bench);
    ASSERT_EQ(run_drude(folder, quick + "-q -o m.csv").status, 0);
    const std::string first = read_text(folder.file("m.csv"));
    const std::string journal = read_text(folder.file("m.journal"));
    std::filesystem::remove(folder.file("m.journal"));
    ASSERT_EQ(run_drude(folder, quick + "-q -o m.csv").status, 0);
    EXPECT_EQ(read_text(folder.file("m.csv")), first);
    EXPECT_EQ(read_text(folder.file("m.journal")), journal);
    // And the journal alone gives them again.
    ASSERT_EQ(run_drude(folder, "reduce m.journal -o again.csv").status, 0);
    EXPECT_EQ(read_text(folder.file("again.csv")), first);
}

TEST(Capture, NeverOverwritesAJournalAndGoesOnWithACutOne) {
    const TemporaryFolder folder;
    write_text(folder.file("b.json"), bench);
    ASSERT_EQ(run_drude(folder, quick + "--resume -q -o m.csv").status, 0);
    const std::string journal = read_text(folder.file("m.journal"));
    const std::string whole = read_text(folder.file("m.csv"));
    expect_words(run_drude(folder, quick + "-q -o m.csv"), 2,
                 {"m.journal", "never overwritten", "--resume"});
    // As a crash leaves it: in the middle of a record.
    write_text(folder.file("m.journal"), journal.substr(0, journal.size() * 2 / 3));
    const ProgramRun run = run_drude(folder, quick + "--resume -q -o m.csv --json");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(json::parse(run.out)["resumed"], true);
    EXPECT_EQ(json::parse(run.out)["points"], 36);
    EXPECT_EQ(json::parse(run.out)["rows"], std::count(whole.begin(), whole.end(), '\n') -
                                                std::count(whole.begin(), whole.end(), '#') - 1);
    // A byte that changed is no crash.
    std::string damaged = journal;
    damaged[damaged.size() / 2] ^= 1;
    write_text(folder.file("m.journal"), damaged);
    expect_words(run_drude(folder, quick + "--resume -q -o m.csv"), 2,
                 {"m.journal: byte ", "checksum"});
    expect_words(run_drude(folder, "reduce m.journal -o n.csv"), 2, {"m.journal: byte "});
}

TEST(Capture, CalibratesTheBenchAndUsesIt) {
    const TemporaryFolder folder;
    write_text(folder.file("b.json"), bench);
    const std::string on = "capture --instrument b.json --steps 12 --wavelengths 500:700:50 -q ";
    ASSERT_EQ(run_drude(folder, on + "--kind straight-through -o s.json").status, 0);
    const json straight = json::parse(read_text(folder.file("s.json")));
    EXPECT_EQ(straight["format"], "drude-calibration/1");
    ASSERT_EQ(run_drude(folder, on + "--kind azimuth --calibration s.json -o c.json").status, 0);
    ASSERT_EQ(run_drude(folder, on + "--angles 70 --calibration c.json -o m.csv").status, 0);
    EXPECT_NE(read_text(folder.file("m.csv")).find("# calibration: c.json (SHA-256 "),
              std::string::npos);
    ASSERT_EQ(run_drude(folder, "reduce m.journal --wavelengths 600:700:20 -o n.csv").status, 0);
    EXPECT_NE(read_text(folder.file("n.csv")).find("# calibration: none\n"), std::string::npos);
    EXPECT_NE(read_text(folder.file("n.csv")).find("\n620,70,"), std::string::npos);
}

TEST(Capture, WrongRequestsSayWhatToDo) {
    const TemporaryFolder folder;
    write_text(folder.file("b.json"), bench);
    expect_words(run_drude(folder, "capture -o m.csv"), 2, {"--instrument"});
    expect_words(run_drude(folder, quick), 2, {"-o M.csv"});
    expect_words(run_drude(folder, "capture --instrument virtual:Cuu -o m.csv"), 2, {"Cuu"});
    expect_words(run_drude(folder, "capture --instrument ooi:USB4C00001 -o m.csv"), 2,
                 {"bench file", "drude-bench/1", "ooi:USB4C00001"});
    expect_words(run_drude(folder, "capture --instrument none.json -o m.csv"), 2, {"none.json"});
    expect_words(run_drude(folder, quick + "-o none/m.csv"), 2, {"none"});
    expect_words(run_drude(folder, quick + "--calibration none.json -o m.csv"), 2, {"none.json"});
    write_text(folder.file("r.json"), "{\"format\": \"drude-recipe/1\", \"angels_deg\": [70]}");
    expect_words(run_drude(folder, "capture r.json --instrument b.json -o m.csv"), 2,
                 {"r.json:1:", "'angels_deg'", "'angles_deg'"});
    expect_words(run_drude(folder, "reduce b.json -o m.csv"), 2, {"b.json", "no journal"});
    EXPECT_FALSE(std::filesystem::exists(folder.file("m.journal")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("m.csv")));
}

TEST(Capture, AnInterruptLeavesAJournalToGoOnWith) {
    const TemporaryFolder folder;
    // Far from its end when the first frames are in the journal.
    const int status = run_and_signal(folder,
                                      {"capture", "--instrument", "virtual:Cu-McPeak", "--steps",
                                       "360", "--averages", "64", "-q", "-o", "m.csv"},
                                      SIGTERM, [&] {
                                          EXPECT_TRUE(wait_until([&] {
                                              std::error_code missing;
                                              const auto bytes = std::filesystem::file_size(
                                                  folder.file("m.journal"), missing);
                                              return !missing && bytes > 100000;
                                          }));
                                      });
    const std::string said = read_text(folder.file(".err"));
    EXPECT_EQ(status, 143) << said;
    EXPECT_NE(said.find("--resume goes on"), std::string::npos) << said;
    EXPECT_FALSE(std::filesystem::exists(folder.file("m.csv")));
    expect_words(run_drude(folder, "reduce m.journal -o n.csv"), 2, {"--resume"});
}

}  // namespace
}  // namespace drude
