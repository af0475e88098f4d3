// `drude reproduce` end to end, small: every file is there, and every picture is physical.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "program.h"
#include "shared_data.h"

namespace drude {
namespace {

// No NaN anywhere; in every spectral layer S0 >= 0 and DoP <= 1 + 1e-5.
void expect_physical(const std::string& path) {
    SCOPED_TRACE(path);
    const Image image = read_exr(path);
    size_t layers = 0;
    for (const Channel& channel : image.channels) {
        size_t bad = 0;
        for (const float value : channel.data) bad += !std::isfinite(value);
        EXPECT_EQ(bad, 0u) << channel.name;
        if (channel.name.rfind("S0.", 0) != 0 || channel.name.find("nm") == std::string::npos) {
            continue;
        }
        ++layers;
        const Channel* s[4];
        for (int i = 0; i < 4; ++i) {
            s[i] = image.find("S" + std::to_string(i) + channel.name.substr(2));
            ASSERT_NE(s[i], nullptr) << channel.name;
        }
        size_t negative = 0, over = 0;
        for (size_t p = 0; p < image.pixels(); ++p) {
            const double s0 = s[0]->data[p], s1 = s[1]->data[p], s2 = s[2]->data[p],
                         s3 = s[3]->data[p];
            negative += s0 < 0;
            over += std::sqrt(s1 * s1 + s2 * s2 + s3 * s3) > s0 * (1 + 1e-5);
        }
        EXPECT_EQ(negative, 0u) << channel.name;
        EXPECT_EQ(over, 0u) << channel.name;
    }
    EXPECT_EQ(layers, 40u);
}

void expect_study(const std::string& folder) {
    for (const char* metal : {"copper", "silver", "gold", "aluminium", "zinc"}) {
        for (const char* file : {"measurement.csv", "fitted.json", "literature.json", "fitted.png",
                                 "literature.png", "difference.png", "nk.csv"}) {
            EXPECT_TRUE(std::filesystem::exists(folder + "/" + metal + "/" + file))
                << metal << file;
        }
        expect_physical(folder + "/" + metal + "/fitted.exr");
        expect_physical(folder + "/" + metal + "/literature.exr");
    }
    const std::string page = read_text(folder + "/index.html");
    EXPECT_NE(page.find("No hardware was used"), std::string::npos);
    EXPECT_NE(page.find("Zn-Werner-DFT"), std::string::npos);
    EXPECT_GT(std::filesystem::file_size(folder + "/comparison.png"), 10000u);
    EXPECT_NE(read_text(folder + "/summary.csv").find("reduced_chi2"), std::string::npos);
}

TEST(Study, IsCompleteAndPhysicalInTheCourtyard) {
    const TemporaryFolder folder;
    const ProgramRun run =
        run_drude(folder, "reproduce -o study --resolution 48 --spp 16 --spectral -q --json");
    ASSERT_EQ(run.status, 0) << run.err;
    expect_study(folder.file("study"));
    const nlohmann::json json = nlohmann::json::parse(run.out);
    ASSERT_EQ(json.at("materials").size(), 5u);
    for (const auto& material : json.at("materials")) {
        EXPECT_GT(material.at("rms_dn").get<double>(), 0);
        EXPECT_GT(material.at("rms_dk").get<double>(), 0);
        EXPECT_LT(std::abs(material.at("chi2_reduced").get<double>() - 1), 0.2);
        EXPECT_LT(material.at("log10_difference").at("mean").get<double>(), 0);
    }
}

TEST(Study, CarriesTheCreditOfTheUffiziProbe) {
    const std::string probe = shared_data("uffizi/uffizi_latlong.exr");
    DRUDE_NEED_SHARED(probe);
    const TemporaryFolder folder;
    const ProgramRun run = run_drude(folder,
                                     "reproduce -o study --resolution 32 --spp 16 --spectral -q "
                                     "--json --environment " +
                                         probe);
    ASSERT_EQ(run.status, 0) << run.err;
    expect_study(folder.file("study"));
    EXPECT_NE(read_text(folder.file("study/index.html")).find("Debevec"), std::string::npos);
    EXPECT_NE(read_exr(folder.file("study/gold/fitted.exr")).text("credit").find("Debevec"),
              std::string::npos);
}

// A study made before at full size: DRUDE_STUDY names its folder (tests/long study sets it).
TEST(Study, IsPhysicalAtFullSize) {
    const char* folder = std::getenv("DRUDE_STUDY");
    if (!folder) GTEST_SKIP() << "DRUDE_STUDY names no folder";
    expect_study(folder);
}

}  // namespace
}  // namespace drude
