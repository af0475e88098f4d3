// What the fit chart measures: pictures with known answers, and errors that follow the noise.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/charts/fit_experiment.h"

namespace drude {
namespace {

TEST(FitChart, PicturesOfAPerfectMirror) {
    // |N| so large that Rs = Rp = 1 and Delta = 180 degrees but for the last place.
    const DenseIndex mirror{constant_spectrum(1), constant_spectrum(1e9)};
    const SpherePicture sky = fit_picture(FitScene::sky, mirror);
    const SpherePicture bounces = fit_picture(FitScene::bounces, mirror);
    const SpherePicture crossed = fit_picture(FitScene::crossed, mirror);
    for (int ring = 0; ring < sphere_rings; ++ring) {
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(sky[ring][c], 1, 1e-6);
            EXPECT_NEAR(bounces[ring][c], 1, 1e-6);
            EXPECT_NEAR(crossed[ring][c], 0, 1e-6);
        }
    }
}

// r_s + r_p = 0 at normal incidence, and (1 + 1)/2 of the light passes at grazing, where both
// amplitudes are -1.
TEST(FitChart, CrossedPolarisersAreDarkInTheMiddleAndBrightAtTheLimb) {
    const SpherePicture picture = fit_picture(FitScene::crossed, dense(published_set("Cu-McPeak")));
    EXPECT_LT(picture.front()[1], 1e-4);
    EXPECT_GT(picture.back()[1], 0.3);
    EXPECT_DOUBLE_EQ(brightest(picture), rgb_to_xyz(picture.back())[1]);
}

TEST(FitChart, ErrorsFollowTheNoise) {
    FitSetting low, high;
    low.noise = 0.1;
    high.noise = 1;
    const OpticalConstants& copper = published_set("Cu-McPeak");
    const FitOutcome a = fit_outcome(copper, low, 1), b = fit_outcome(copper, high, 1);
    ASSERT_EQ(a.refused, "");
    ASSERT_EQ(b.refused, "");
    EXPECT_EQ(b.refused_share, 0);
    EXPECT_NEAR(b.constants_error / a.constants_error, 10, 0.5);
    for (size_t s = 0; s < fit_scenes.size(); ++s) {
        EXPECT_NEAR(b.pictures[s].mean_delta_e / a.pictures[s].mean_delta_e, 10, 0.8);
        EXPECT_NEAR(b.pictures[s].log10_difference - a.pictures[s].log10_difference, 1, 0.05);
    }
}

TEST(FitChart, PsiAtOneAngleIsRefused) {
    FitSetting setting;
    setting.estimator = "rho2";
    setting.angles_deg = {70};
    EXPECT_NE(fit_outcome(published_set("Cu-McPeak"), setting, 1).refused, "");
    EXPECT_EQ(setting.data(), 41);
    setting.estimator = "psi-delta";
    EXPECT_EQ(fit_outcome(published_set("Cu-McPeak"), setting, 1).refused, "");
    EXPECT_EQ(setting.data(), 82);
}

// Between crossed polarisers the picture is Delta's: without it silver's is far worse, under a sky
// it is not.
TEST(FitChart, WithoutDeltaThePictureBetweenPolarisersIsLost) {
    FitSetting with, without;
    without.estimator = "rho2";
    const OpticalConstants& silver = published_set("Ag-McPeak");
    const FitOutcome a = fit_outcome(silver, with, 1), b = fit_outcome(silver, without, 1);
    ASSERT_EQ(b.refused, "");
    EXPECT_GT(b.pictures[2].mean_delta_e, 20 * a.pictures[2].mean_delta_e);
    EXPECT_LT(b.pictures[0].mean_delta_e, 1);
}

}  // namespace
}  // namespace drude
