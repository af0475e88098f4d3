// Table 1 of Berger et al. 2012: what comes back, and what never was in the data.
#include "fitter/like_the_paper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "fit_cases.h"

namespace drude {
namespace {

TEST(LikeThePaper, PrintedConstantsComeBackFromTheirOwnRho2) {
    const std::vector<PaperCheck> checks = check_paper_table();
    ASSERT_EQ(checks.size(), 6u);
    for (const PaperCheck& check : checks) {
        EXPECT_LT(check.largest_error, 1e-6) << check.metal->name;
        EXPECT_EQ(check.fit.wavelength_nm, check.metal->wavelength_nm);
        EXPECT_EQ(check.fit.literature, check.metal->literature);
        EXPECT_EQ(check.fit.printed, check.metal);
        ASSERT_EQ(check.fit.blocks.size(), 5u);
        // The starts are none of the answers.
        const PaperFitBlock& block = check.fit.blocks[0];
        EXPECT_GT(std::hypot(check.fit.start_n - block.n, check.fit.start_k - block.k), 0.003)
            << check.metal->name;
    }
}

TEST(LikeThePaper, NoLobeMovesThemAndNoBetaIsFound) {
    for (const PaperCheck& check : check_paper_table()) {
        const PaperFitBlock& fresnel = check.fit.blocks[0];
        EXPECT_TRUE(fresnel.beta_end.empty());
        for (size_t i = 1; i < 5; ++i) {
            const PaperFitBlock& block = check.fit.blocks[i];
            EXPECT_TRUE(block.converged) << block.name;
            EXPECT_NEAR(block.n, fresnel.n, 1e-7) << block.name;
            EXPECT_NEAR(block.k, fresnel.k, 1e-7) << block.name;
            // Rounding is all that is left of the column.
            EXPECT_LT(block.column_beta, 1e-12 * block.column_n) << block.name;
            EXPECT_LT(block.column_beta, 1e-12 * block.column_k) << block.name;
            ASSERT_EQ(block.beta_end.size(), 2u);
            for (size_t j = 0; j < 2; ++j) {
                EXPECT_NEAR(block.beta_end[j], block.beta_start[j], 1e-6)
                    << check.metal->name << " " << block.name;
            }
        }
    }
}

// The notes' figures: copper 1.45 degrees of Psi and chi-square 841 a datum, steel 0.87 and 301.
TEST(LikeThePaper, PrintedPairsContradictEachOther) {
    const std::vector<PaperCheck> checks = check_paper_table();
    EXPECT_NEAR(checks[0].largest_psi_difference_deg, 1.45, 0.005);
    EXPECT_NEAR(checks[0].largest_chi2, 841, 0.5);
    EXPECT_EQ(checks[0].largest_at, "Gaussian");
    EXPECT_NEAR(checks[2].largest_psi_difference_deg, 0.87, 0.005);
    EXPECT_NEAR(checks[2].largest_chi2, 301, 0.5);
    const bool repeated[] = {true, true, false, true, false, true};
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(checks[i].beta_repeated, repeated[i]) << i;
}

// Its standard deviations are at least those of the weighted fit, which is the best there is.
TEST(LikeThePaper, SigmasAreThoseOfTheScatter) {
    const MetalCase metal = {"Cu", 1.030, 2.460};
    const PaperFit exact = fit_like_the_paper(measured(metal, paper_angles(), 0), {});
    EXPECT_GT(exact.sigma_n, 0.0053);
    EXPECT_GT(exact.sigma_k, 0.0127);
    double n = 0, k = 0;
    constexpr int draws = 300;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        const PaperFit fit = fit_like_the_paper(measured(metal, paper_angles(), seed, 9), {});
        n += std::pow(fit.blocks[0].n - metal.n, 2);
        k += std::pow(fit.blocks[0].k - metal.k, 2);
    }
    // Of 300 draws: 4 %; bounds at four times that.
    EXPECT_NEAR(std::sqrt(n / draws), exact.sigma_n, 0.17 * exact.sigma_n);
    EXPECT_NEAR(std::sqrt(k / draws), exact.sigma_k, 0.17 * exact.sigma_k);
    EXPECT_LT(exact.psi_delta.sigma_k, 0.3 * exact.sigma_k);
}

TEST(LikeThePaper, TakesTheMetalThatTheSampleNames) {
    EXPECT_EQ(paper_metal_of("Copper plate 3")->name, "copper");
    EXPECT_EQ(paper_metal_of("Cu-McPeak")->name, "copper");
    EXPECT_EQ(paper_metal_of("Al foil")->wavelength_nm, 516);
    EXPECT_EQ(paper_metal_of("galvanized steel")->name, "galvanised steel");
    EXPECT_EQ(paper_metal_of("Al2O3"), nullptr);
    EXPECT_EQ(paper_metal_of(""), nullptr);
    Measurement data = measured({"Ag", 0.29, 3.04}, paper_angles(), 0);
    Measurement other = data;
    for (MeasurementRow& row : other.rows) row.wavelength_nm = 490;
    data.rows.insert(data.rows.end(), other.rows.begin(), other.rows.end());
    data.header = {{"sample", "silver coin"}};
    const PaperFit silver = fit_like_the_paper(data, {});
    EXPECT_EQ(silver.wavelength_nm, 490);  // nearest to 495
    EXPECT_EQ(silver.literature, "Ag-Rakic-BB");
    EXPECT_FALSE(silver.nearest_literature);
    LikeThePaperOptions options;
    options.wavelength_nm = 600;
    options.literature = published_set("Ag-Johnson");
    const PaperFit chosen = fit_like_the_paper(data, options);
    EXPECT_EQ(chosen.wavelength_nm, 516);
    EXPECT_EQ(chosen.literature, "Ag-Johnson");
    ASSERT_EQ(chosen.warnings.size(), 1u);
    EXPECT_NE(chosen.warnings[0].find("600"), std::string::npos);
    EXPECT_TRUE(silver.warnings.empty());
    data.header.clear();
    const PaperFit unnamed = fit_like_the_paper(data, {});
    EXPECT_TRUE(unnamed.nearest_literature);
    EXPECT_EQ(unnamed.printed, nullptr);
    EXPECT_NEAR(unnamed.blocks[0].n, 0.29, 1e-6);
}

TEST(LikeThePaper, OneAngleIsRefusedWithTheReason) {
    try {
        fit_like_the_paper(measured({"Cu", 1.03, 2.46}, {70}, 0), {});
        FAIL() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no);
        EXPECT_NE(error.message().find("tan^2 Psi"), std::string::npos);
    }
    LikeThePaperOptions options;
    options.wavelength_nm = -1;
    EXPECT_THROW(fit_like_the_paper(measured({"Cu", 1.03, 2.46}, {60, 70}, 0), options), Error);
}

}  // namespace
}  // namespace drude
