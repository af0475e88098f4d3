// The scatter of beta where a position of the detector errs for all wavelengths together.
#include "fitter/lobe_scatter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "lobe_cases.h"

namespace drude {
namespace {

// `scan` with one more error for each position, the same relative change at every wavelength.
LobeScan with_position_errors(LobeScan scan, double sigma, uint64_t seed) {
    for (LobeScanRow& row : scan.rows) {
        const auto position = static_cast<uint64_t>(row.offset_deg + 100);
        const double factor = 1 + sigma * normal_pair(seed, position)[0];
        row.reflectance_s *= factor;
        row.reflectance_p *= factor;
    }
    return scan;
}

// Over draws beta scatters as it says, where its sigma_beta is several times too small.
TEST(LobeScatter, CoversErrorsThatWavelengthsShare) {
    const Material metal = find_material("Cu-McPeak");
    const std::vector<double> wavelengths = {450, 500, 550, 600, 650};
    const LobeScan clean = scan_of(Lobe::beckmann, 0.2, wavelengths, 1);
    constexpr int draws = 60;
    double squares = 0, stated = 0, noise = 0;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        const LobeScan scan = with_position_errors(clean, 0.05, seed);
        const FittedLobe own = result_for(fit_lobes(scan, metal), Lobe::beckmann);
        squares += std::pow(own.beta - 0.2, 2) / draws;
        stated += std::pow(scatter_of_beta(scan, metal, own), 2) / draws;
        noise += std::pow(own.sigma_beta, 2) / draws;
    }
    // A variance of 60 draws is known to sqrt(2/60) = 18 %; three of these, and what the stated
    // one, of 56 positions of unequal weight, is off itself.
    EXPECT_NEAR(std::sqrt(squares / stated), 1, 0.35);
    EXPECT_GT(stated, 10 * noise);
}

// Independent errors: on average what the noise says.
TEST(LobeScatter, IsThatOfTheNoiseWhereNothingIsShared) {
    const Material metal = find_material("Cu-McPeak");
    double stated = 0, noise = 0;
    constexpr int draws = 30;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        const LobeScan scan = scan_of(Lobe::gaussian, 0.15, {500, 600}, seed);
        const FittedLobe own = result_for(fit_lobes(scan, metal), Lobe::gaussian);
        stated += std::pow(scatter_of_beta(scan, metal, own), 2) / draws;
        noise += std::pow(own.sigma_beta, 2) / draws;
    }
    EXPECT_NEAR(std::sqrt(stated / noise), 1, 0.15);
}

TEST(LobeScatter, OnePositionScattersNothing) {
    const Material metal = find_material("Cu-McPeak");
    LobeScan scan = scan_of(Lobe::gaussian, 0.15, {500}, 0);
    const FittedLobe own = result_for(fit_lobes(scan, metal), Lobe::gaussian);
    scan.rows.resize(1);
    EXPECT_THROW(scatter_of_beta(scan, metal, own), Error);
}

}  // namespace
}  // namespace drude
