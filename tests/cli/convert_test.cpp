// `drude convert` from outside: what other programs write, and what they are given.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace drude {
namespace {

constexpr const char* wvase =
    "tape\nVASEmethod[Revs=50]\nnm\n300.0\t65\t12.5\t1.5\t0.25\t3.5\ndpolE\t300\t55\t1\t1\n";

TEST(Convert, AVendorsExportBecomesAMeasurementWithItsWarnings) {
    const TemporaryFolder folder;
    write_text(folder.file("tape.dat"), wvase);
    const ProgramRun run = run_drude(folder, "convert tape.dat tape.csv");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "tape.csv\n");
    EXPECT_NE(run.err.find("warning: 1 of 1 rows of depolarization"), std::string::npos) << run.err;
    const std::string csv = read_text(folder.file("tape.csv"));
    EXPECT_NE(csv.find("# source_file: tape.dat\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\n300,65,12.5,1.5,0.25,3.5\n"), std::string::npos) << csv;
    const ProgramRun json = run_drude(folder, "convert tape.dat again.csv --format wvase --json");
    EXPECT_EQ(nlohmann::json::parse(json.out)["warnings"].size(), 1u);
}

TEST(Convert, TheDatabasesYamlBecomesAMaterialAndGoesBack) {
    const TemporaryFolder folder;
    write_text(
        folder.file("Xx.yml"),
        "DATA:\n  - type: tabulated nk\n    data: |\n        0.5 1.5 2\n        0.4358 1 3\n");
    ASSERT_EQ(run_drude(folder, "convert Xx.yml xx.json").status, 0);
    const auto material = nlohmann::json::parse(read_text(folder.file("xx.json")));
    EXPECT_EQ(material["name"], "Xx");
    ASSERT_EQ(run_drude(folder, "convert xx.json back.yml").status, 0);
    EXPECT_NE(read_text(folder.file("back.yml")).find("        0.4358 1 3\n        0.5 1.5 2\n"),
              std::string::npos);
    const ProgramRun pbrt = run_drude(folder, "convert Xx.yml xx --to pbrt");
    EXPECT_EQ(pbrt.out.substr(0, 22), "xx.eta.spd\nxx.k.spd\nus") << pbrt.out;
}

TEST(Convert, AnUnknownFormatNamesTheNearest) {
    const TemporaryFolder folder;
    write_text(folder.file("tape.dat"), wvase);
    const ProgramRun run = run_drude(folder, "convert tape.dat tape.csv --format acurion");
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("did you mean 'accurion'"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("spectraray-dielectric"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.file("tape.csv")));
}

}  // namespace
}  // namespace drude
