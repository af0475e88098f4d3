// `drude fit --like-the-paper` from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace drude {
namespace {

TEST(LikeThePaperCommand, WithoutAMeasurementThePrintedTableIsPutToTheTest) {
    const TemporaryFolder folder;
    const ProgramRun text = run_drude(folder, "fit --like-the-paper");
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("none of the 24 printed values carries information"),
              std::string::npos);
    EXPECT_NE(text.out.find("copper: the Gaussian pair is 1.45 degrees"), std::string::npos);
    const auto json = nlohmann::json::parse(run_drude(folder, "fit --like-the-paper --json").out);
    EXPECT_TRUE(json["all_return"]);
    ASSERT_EQ(json["metals"].size(), 6u);
    for (const auto& metal : json["metals"]) {
        EXPECT_LT(metal["largest_error"], 1e-6) << metal["metal"];
        EXPECT_EQ(metal["fit"]["blocks"].size(), 5u);
        EXPECT_TRUE(metal["fit"]["psi_delta"]["beta"].is_null());
        EXPECT_TRUE(metal["fit"]["blocks"][0]["printed"]["beta"].is_null());
    }
}

TEST(LikeThePaperCommand, AMeasurementIsTabulatedBesideOurs) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_drude(folder,
                        "simulate Ag-Johnson --angles 45,60,75,80 --wavelengths 480:510:5 "
                        "--noise 0.05,0.1 --seed 3 -o ag.csv")
                  .status,
              0);
    const auto json =
        nlohmann::json::parse(run_drude(folder, "fit ag.csv --like-the-paper --json").out);
    EXPECT_EQ(json["wavelength_nm"], 495);
    EXPECT_EQ(json["printed_metal"], "silver");
    EXPECT_EQ(json["literature"], "Ag-Rakic-BB");
    EXPECT_FALSE(json["beta_identifiable"]);
    // The sample is Johnson's; tan^2 Psi alone is worse at it.
    EXPECT_NEAR(json["psi_delta"]["k"], 3.085, 0.03);
    EXPECT_GT(json["sigma_k"], 10 * json["psi_delta"]["sigma_k"].get<double>());
    const ProgramRun other =
        run_drude(folder, "fit ag.csv --like-the-paper --wavelength 485 --paper-start Ag-Yang");
    EXPECT_EQ(other.status, 0) << other.err;
    EXPECT_NE(other.out.find("at 485 nm, 4 angles of incidence, started from Ag-Yang"),
              std::string::npos)
        << other.out;
}

TEST(LikeThePaperCommand, WhatItHasNoUseForIsRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_drude(folder, "fit --like-the-paper -o cu.json").status, 2);
    EXPECT_EQ(run_drude(folder, "fit --like-the-paper --model film").status, 2);
    EXPECT_EQ(run_drude(folder, "fit x.csv --wavelength 500").status, 2);
    ASSERT_EQ(run_drude(folder,
                        "simulate Cu --angles 70 --wavelengths 500:520:10 --noise 0.05,0.1 -o "
                        "one.csv")
                  .status,
              0);
    const ProgramRun one = run_drude(folder, "fit one.csv --like-the-paper");
    EXPECT_EQ(one.status, 1);
    EXPECT_NE(one.err.find("one angle of incidence"), std::string::npos) << one.err;
    EXPECT_EQ(run_drude(folder, "fit one.csv --like-the-paper --wavelength -3").status, 2);
    EXPECT_EQ(run_drude(folder, "fit one.csv --like-the-paper --wavelength 0").status, 2);
    EXPECT_EQ(run_drude(folder, "fit one.csv --like-the-paper --paper-start Cuu").status, 2);
}

}  // namespace
}  // namespace drude
