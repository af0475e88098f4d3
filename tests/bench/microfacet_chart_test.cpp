// Lobes under either masking: closed forms, and what materials/microfacet.h says of the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/counter_random.h"
#include "bench/charts/microfacet_picture.h"

namespace drude {
namespace {

constexpr std::array<Lobe, 4> lobes = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                                       Lobe::trowbridge_reitz};

TEST(ShadowedLobe, HalfHeightIsHalfTheHeight) {
    for (const Lobe lobe : lobes) {
        for (const double h : {0.02, 0.3, 0.8}) {
            const LobeDensity<double> D(lobe, beta_at_half_height(lobe, h));
            EXPECT_NEAR(D(std::tan(h) * std::tan(h)) / D(0), 0.5, 1e-9) << lobe_name(lobe) << h;
        }
    }
}

TEST(ShadowedLobe, QuadratureFindsTheNorm) {
    for (const Lobe lobe : lobes) {
        for (const double beta : {0.02, 0.3, 1.0}) {
            EXPECT_NEAR(ShadowedLobe(lobe, Masking::smith, beta).norm(), 1, 1e-6)
                << lobe_name(lobe) << " " << beta;
        }
    }
}

TEST(ShadowedLobe, SmithIsTheClosedFormOfTheLobesThatHaveOne) {
    for (const Lobe lobe : {Lobe::beckmann, Lobe::trowbridge_reitz}) {
        for (const double beta : {0.05, 0.4, 1.0}) {
            const ShadowedLobe numeric(lobe, Masking::smith, beta);
            const Microfacets<double> closed(lobe, Masking::smith, beta);
            for (int angle = 0; angle < 90; ++angle) {
                const double c = std::cos(angle * degree), s = std::sin(angle * degree);
                EXPECT_NEAR(numeric.smith_G1(c), closed.G1({s, 0, c}, {0, 0, 1}), 2e-5)
                    << lobe_name(lobe) << " " << beta << " at " << angle;
            }
        }
    }
}

TEST(ShadowedLobe, MaskingIsThatOfTheRenderer) {
    const auto direction = [](double u, double v) {
        const double s = std::sqrt(u), phi = 2 * pi * v;
        return Vec3<double>(s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - u));
    };
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            if (masking == Masking::smith && lobe != Lobe::beckmann &&
                lobe != Lobe::trowbridge_reitz) {
                continue;
            }
            const ShadowedLobe numeric(lobe, masking, 0.3);
            const Microfacets<double> own(lobe, masking, 0.3);
            for (uint32_t j = 0; j < 100; ++j) {
                const PhiloxBlock bits = philox({j, 0, 0, 0}, {7, 7});
                const Vec3<double> o = direction(bits[0] * 0x1p-32, bits[1] * 0x1p-32);
                const Vec3<double> i = direction(bits[2] * 0x1p-32, bits[3] * 0x1p-32);
                const Vec3<double> m = glm::normalize(o + i);
                EXPECT_NEAR(numeric.G2(o, i, m), own.G2(o, i, m), 5e-5);
            }
        }
    }
}

TEST(ShadowedLobe, BothMaskingsAgreeAtNormalIncidence) {
    for (const Lobe lobe : lobes) {
        for (const double beta : {0.05, 0.4, 1.0}) {
            EXPECT_NEAR(ShadowedLobe(lobe, Masking::smith, beta).smith_G1(1), 1, 1e-6);
            const Microfacets<double> groove(lobe, Masking::v_groove, beta);
            // Every facet that is met from above is seen whole.
            for (const double tilt : {0.1, 0.7, 1.4}) {
                EXPECT_EQ(groove.G1({0, 0, 1}, {std::sin(tilt), 0, std::cos(tilt)}), 1);
            }
        }
    }
    // Narrow lobes keep all light of either masking there.
    for (const Masking masking : {Masking::v_groove, Masking::smith}) {
        EXPECT_NEAR(ShadowedLobe(Lobe::beckmann, masking, 0.02).albedo(1), 1, 1e-6);
    }
}

// Light from above a v-groove leaves it by 1 up to tilts of 30 degrees, by 2 cos(2 tilt) up to 45:
// with Blinn and Phong's cos^e the integral is elementary.
TEST(ShadowedLobe, AlbedoOfVGroovesAtNormalIncidence) {
    for (const double beta : {0.2, 0.4, 0.8}) {
        const double e = blinn_phong_exponent(beta), c30 = std::sqrt(3.0) / 2, c45 = std::sqrt(0.5);
        const auto inner = [&](double c) {
            return 2 * std::pow(c, e + 4) / (e + 4) - std::pow(c, e + 2) / (e + 2);
        };
        const double expected = 1 - std::pow(c30, e + 2) + 2 * (e + 2) * (inner(c30) - inner(c45));
        EXPECT_NEAR(ShadowedLobe(Lobe::blinn_phong, Masking::v_groove, beta).albedo(1), expected,
                    2e-4)
            << beta;
    }
}

// The weights of the renderer's samples are the albedo on the mean.
TEST(ShadowedLobe, AlbedoIsTheMeanWeightOfTheRenderersSamples) {
    constexpr int side = 64;
    for (const Lobe lobe : lobes) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            if (masking == Masking::smith && lobe != Lobe::beckmann &&
                lobe != Lobe::trowbridge_reitz) {
                continue;
            }
            const double beta = 0.5;
            const Microfacets<double> own(lobe, masking, beta);
            for (const double angle : {0.0, 50.0, 80.0}) {
                const Vec3<double> o(std::sin(angle * degree), 0, std::cos(angle * degree));
                double sum = 0, squares = 0;
                for (int a = 0; a < side; ++a) {
                    for (int b = 0; b < side; ++b) {
                        const PhiloxBlock bits = philox(
                            {static_cast<uint32_t>(a), static_cast<uint32_t>(b), 0, 0}, {11, 5});
                        const double weight =
                            own.sample(o, (a + bits[0] * 0x1p-32) / side,
                                       (b + bits[1] * 0x1p-32) / side, bits[2] * 0x1p-32)
                                .weight;
                        sum += weight;
                        squares += weight * weight;
                    }
                }
                const double count = side * side, mean = sum / count;
                // Strata only lower the variance.
                const double sigma = std::sqrt((squares / count - mean * mean) / count);
                EXPECT_NEAR(ShadowedLobe(lobe, masking, beta).albedo(o.z), mean, 4 * sigma + 3e-4)
                    << lobe_name(lobe) << ", " << masking_name(masking) << " at " << angle;
            }
        }
    }
}

TEST(MicrofacetPicture, PartsSumToTheAlbedoAndPerfectMirrorsGetAllBack) {
    const ShadowedLobe lobe(Lobe::trowbridge_reitz, Masking::smith, 0.6);
    const LobeOnSphere on_sphere(lobe);
    for (const int ring : {0, 30, 63}) {
        EXPECT_NEAR(on_sphere.albedo(ring), lobe.albedo(ring_cosine(ring)), 1e-12);
    }
    EXPECT_GT(on_sphere.energy_lost(), 0.01);
    // n = 1 and k = 1e6 reflect everything.
    DenseIndex mirror{constant_spectrum(1), constant_spectrum(1e6)};
    const FacetReflectance metal(mirror);
    const SpherePicture once = rough_sphere(on_sphere, metal);
    const SpherePicture all = rough_sphere_with_all_bounces(on_sphere, metal);
    // At grazing angles even that index reflects a little less; nodes stand at the horizon too.
    EXPECT_NEAR(mean_Y(all), 1, 1e-3);
    EXPECT_NEAR(1 - mean_Y(once) / mean_Y(all), on_sphere.energy_lost(), 1e-3);
}

}  // namespace
}  // namespace drude
