// The command `drude bench`, as people and scripts run it.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "program.h"
#include "temporary_folder.h"

namespace drude {
namespace {

TEST(BenchCommand, NamesItsItems) {
    const TemporaryFolder folder;
    const ProgramRun run = run_drude(folder, "bench --list --json");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto items = nlohmann::json::parse(run.out);
    EXPECT_GE(items.size(), 17U);
    EXPECT_EQ(items.at(0).at("item"), "transport");
}

TEST(BenchCommand, SaysWhatIsWrongWithTheCommandLine) {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& arguments) {
        const ProgramRun run = run_drude(folder, "bench " + arguments);
        EXPECT_EQ(run.status, 2) << arguments;
        return run.err;
    };
    EXPECT_NE(refusal("fresnel").find("--output"), std::string::npos);
    EXPECT_NE(refusal("fresnle -o out").find("'fresnle'"), std::string::npos);
    EXPECT_NE(refusal("fresnel -o out --seeds -1").find("--seeds"), std::string::npos);
    EXPECT_NE(refusal("fresnel -o out --with none.csv").find("none.csv"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder.file("out"))) << "refused before measuring";
}

// One item of charts and one of maps; points of other programs join a chart or make one.
TEST(BenchCommand, WritesPointsPlotsAndAPage) {
    const TemporaryFolder folder;
    write_file(folder.file("peers.csv"),
               "chart,method,setting,cost,error,error_sigma,automatic,pareto,note\n"
               "fresnel-reflectance,another program,1,5,0.25,0,0,0,\n"
               "of-its-own,another program,1,5,0.25,0,0,0,\n");
    const ProgramRun run = run_drude(
        folder, "bench fresnel stability-frames --quick -q -o out --with peers.csv --json");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    ASSERT_EQ(json.at("items").size(), 3U);
    for (const auto& item : json.at("items")) {
        for (const auto& file : item.at("files")) {
            EXPECT_TRUE(std::filesystem::exists(folder.file("out/" + file.get<std::string>())));
        }
    }
    for (const auto& map : json.at("items").at(1).at("maps")) {
        EXPECT_TRUE(map.at("holds").get<bool>()) << map;
    }
    const std::string points = read_file(folder.file("out/fresnel-reflectance.csv"));
    EXPECT_NE(points.find("another program,1,5,0.25"), std::string::npos);
    const std::string page = read_file(folder.file("out/index.html"));
    EXPECT_NE(page.find("of-its-own"), std::string::npos);
    EXPECT_NE(page.find("Processor"), std::string::npos);
}

}  // namespace
}  // namespace drude
