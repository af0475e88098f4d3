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
        for (const char* file :
             {"sample.json", "bench.json", "measurement.csv", "measurement.journal",
              "lobe-scan.csv", "lobe-scan.journal", "fitted.json", "literature.json",
              "fitted-rough.json", "literature-rough.json", "fitted.png", "literature.png",
              "difference.png", "fitted-rough.png", "literature-rough.png", "difference-rough.png",
              "nk.csv"}) {
            EXPECT_TRUE(std::filesystem::exists(folder + "/" + metal + "/" + file))
                << metal << file;
        }
        // Without --spectral the layers are in smaller pictures.
        const std::string beside = folder + "/" + metal + "/";
        const bool small = std::filesystem::exists(beside + "fitted-spectral.exr");
        for (const char* picture : {"fitted", "literature", "fitted-rough", "literature-rough"}) {
            expect_physical(beside + picture + (small ? "-spectral.exr" : ".exr"));
        }
    }
    for (const char* file :
         {"study.json", "bench/calibration.json", "bench/psi-delta.json", "bench/lobe.json",
          "bench/azimuth.journal", "bench/straight-through.journal", "figure-5.svg", "figure-6.svg",
          "figure-7.svg", "figure-8.svg", "anodised-aluminium/measurement.csv",
          "anodised-aluminium/fitted.json"}) {
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + file)) << file;
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
        // Noise and the common error together leave a chi-square of 1; the common error is named,
        // and the noise alone would not do.
        const double slack = material.at("chi2_slack").get<double>();
        EXPECT_LT(slack, 1.5);
        EXPECT_LT(std::abs(material.at("chi2_reduced").get<double>() - 1), slack);
        EXPECT_GT(material.at("chi2_noise_alone").get<double>(),
                  material.at("chi2_reduced").get<double>());
        EXPECT_EQ(material.at("capture").at("common_errors").size(), 6u);
        EXPECT_EQ(material.at("capture").at("rows").get<int>(), 6 * 81);
        EXPECT_EQ(material.at("capture").at("retries").get<int>(), 0);
        const nlohmann::json& rough = material.at("rough");
        const double beta = rough.at("beta_of_true_lobe").get<double>();
        EXPECT_NEAR(beta, rough.at("true_beta").get<double>(),
                    4 * rough.at("sigma_of_true_lobe").get<double>());
        EXPECT_LT(rough.at("sigma_of_true_lobe").get<double>(), 1e-3);
        const std::string verdict = rough.at("verdict");
        EXPECT_TRUE(verdict == "recovered" || verdict == "tie") << material.dump();
        EXPECT_LT(rough.at("log10_difference").at("mean").get<double>(), 0);
        EXPECT_LT(material.at("log10_difference").at("mean").get<double>(), 0);
    }
    EXPECT_GE(json.at("claims").size(), 12u);
}

// The page comes from the folder alone: the same bytes again, and one figure by itself.
TEST(Study, IsReportedAgainWithoutRendering) {
    const TemporaryFolder folder;
    const ProgramRun study = run_drude(folder, "reproduce -o study --resolution 24 --spp 16 -q");
    ASSERT_EQ(study.status, 0) << study.err;
    expect_study(folder.file("study"));
    const std::string page = read_text(folder.file("study/index.html"));
    const std::string figure = read_text(folder.file("study/figure-6.svg"));
    std::filesystem::remove(folder.file("study/index.html"));
    std::filesystem::remove(folder.file("study/figure-6.svg"));
    const ProgramRun one = run_drude(folder, "report study --figure 6");
    ASSERT_EQ(one.status, 0) << one.err;
    EXPECT_EQ(read_text(folder.file("study/figure-6.svg")), figure);
    EXPECT_FALSE(std::filesystem::exists(folder.file("study/index.html")));
    const ProgramRun again = run_drude(folder, "report study --json");
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(read_text(folder.file("study/index.html")), page);
    const nlohmann::json json = nlohmann::json::parse(again.out);
    EXPECT_EQ(json.at("page_bytes").get<size_t>(), page.size());

    // What is wrong with a folder is said with its place.
    const auto refuse = [&](const std::string& arguments, const char* part) {
        const ProgramRun run = run_drude(folder, arguments);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    };
    refuse("report study/copper", "holds no study");
    refuse("report study --figure 3", "expected one of 5 to 9");
    refuse("report study --figure 0", "expected 5 to 9");
    std::string record = read_text(folder.file("study/study.json"));
    const size_t at = record.find("Cu-Hagemann");
    ASSERT_NE(at, std::string::npos);
    write_text(folder.file("study/study.json"), std::string(record).replace(at, 11, "Cu-Hageman"));
    refuse("report study", "Cu-Hagemann");
    write_text(folder.file("study/study.json"),
               std::string(record).replace(record.find("\"copper\""), 8, "\"../etc\""));
    refuse("report study", "study.json:");
    write_text(folder.file("study/study.json"), record.substr(0, record.size() / 2));
    refuse("report study", "study.json:");
    write_text(folder.file("study/study.json"), record);
    std::filesystem::remove(folder.file("study/gold/literature.exr"));
    refuse("report study", "gold/literature.exr");
}

// What the study captured is what `drude capture` captures with the bench, the recipe and the
// calibration that lie beside it; and what its journal is reduced to.
TEST(Study, ItsCapturesAreRepeatedByHand) {
    const TemporaryFolder folder;
    const ProgramRun study = run_drude(folder, "reproduce -o study --resolution 8 --spp 1 -q");
    ASSERT_EQ(study.status, 0) << study.err;
    const auto rows = [&](const std::string& file) {
        const std::string text = read_text(folder.file(file));
        return text.substr(text.find("wavelength_nm,"));
    };
    const auto run = [&](const std::string& arguments) {
        const ProgramRun result = run_drude(folder, arguments);
        EXPECT_EQ(result.status, 0) << result.err;
    };
    run("capture study/bench/psi-delta.json --instrument study/gold/bench.json -o gold.csv -q");
    EXPECT_EQ(rows("gold.csv"), rows("study/gold/measurement.csv"));
    run("capture study/bench/lobe.json --instrument study/gold/bench.json -o lobe.csv -q");
    EXPECT_EQ(rows("lobe.csv"), rows("study/gold/lobe-scan.csv"));
    run("reduce study/gold/measurement.journal --calibration study/bench/calibration.json -o "
        "again.csv");
    EXPECT_EQ(rows("again.csv"), rows("study/gold/measurement.csv"));
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
