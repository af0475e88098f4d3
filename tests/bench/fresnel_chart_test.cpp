// What the Fresnel chart says of its methods, where it can be said exactly.
#include "bench/charts/fresnel_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/charts/sphere_picture.h"

namespace drude {
namespace {

FresnelMethod method_of(const DenseIndex& metal, const std::string& name,
                        const std::string& setting = "") {
    for (FresnelMethod& method : fresnel_methods(metal)) {
        if (method.name == name && (setting.empty() || method.setting == setting)) {
            return std::move(method);
        }
    }
    ADD_FAILURE() << "no method " << name << " " << setting;
    return {};
}

TEST(SpherePicture, SkyItselfAndItsMean) {
    for (const double reflectance : {1.0, 0.5}) {
        for (const RGB& rgb : sphere_picture([&](int, int) { return reflectance; })) {
            for (const double channel : rgb) EXPECT_NEAR(channel, reflectance, 1e-12);
        }
    }
    // cos^2 has the mean 1/2 over the disk, which the middles of even steps give exactly.
    double mean = 0;
    for (int ring = 0; ring < sphere_rings; ++ring) {
        mean += ring_cosine(ring) * ring_cosine(ring) / sphere_rings;
    }
    EXPECT_NEAR(mean, 0.5, 1e-7);
}

TEST(SpherePicture, ErrorOfAKnownDifference) {
    const SpherePicture truth = sphere_picture([](int, int) { return 0.5; });
    const SpherePicture darker = sphere_picture([](int, int) { return 0.45; });
    const PictureError none = picture_error(truth, truth), error = picture_error(darker, truth);
    EXPECT_NEAR(none.mean_delta_e, 0, 1e-9);
    EXPECT_TRUE(std::isinf(none.log10_difference));
    EXPECT_NEAR(error.relative_rmse, 0.1, 1e-12);
    EXPECT_NEAR(error.log10_difference, std::log10(0.05), 1e-12);
    EXPECT_NEAR(error.mean_delta_e, error.worst_delta_e, 1e-9);
    // Two greys differ in lightness alone: dL / S_L.
    const double light = 116 * std::cbrt(0.5), dark = 116 * std::cbrt(0.45);
    const double off = std::pow((light + dark) / 2 - 66, 2);
    EXPECT_NEAR(error.mean_delta_e, (light - dark) / (1 + 0.015 * off / std::sqrt(20 + off)), 1e-6);
    EXPECT_NEAR(brightest(truth), 0.5 * brightest(sphere_picture([](int, int) { return 1.0; })),
                1e-12);
}

TEST(FresnelChart, ExactPathInFloatStaysWithinTwoMillionthsOfDouble) {
    for (const NamedMetal& named : five_metals()) {
        const DenseIndex metal = dense(published_set(named.set));
        const FresnelError error = fresnel_error(method_of(metal, "exact"), metal);
        EXPECT_LE(error.worst, 2e-6) << named.name;
        EXPECT_LE(error.rms_psi_deg, 1e-4) << named.name;
        EXPECT_LE(error.worst_delta_e, 1e-4) << named.name;
    }
}

TEST(FresnelChart, SchlicksWorstErrorOnAluminiumIsThatOfTheFormula) {
    const DenseIndex metal = dense(published_set("Al-McPeak"));
    double worst = 0;
    for (int ring = 0; ring < sphere_rings; ++ring) {
        const double c = ring_cosine(ring);
        for (int i = 0; i < spectrum_integral_size; ++i) {
            const double n = metal.n[i], k = metal.k[i];
            const double at_normal = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
            const double approximate = at_normal + (1 - at_normal) * std::pow(1 - c, 5);
            worst =
                std::max(worst, std::abs(approximate - reflect(ComplexIndex<double>{n, k}, c).A()));
        }
    }
    const FresnelError error = fresnel_error(method_of(metal, "Schlick"), metal);
    EXPECT_NEAR(error.worst, worst, 1e-6);
    EXPECT_GT(worst, 0.1);  // of aluminium near 85 degrees, where Rp has its dip
    EXPECT_GT(error.worst_angle_deg, 80);
}

TEST(FresnelChart, SchlickIsExactAtBothEnds) {
    const ComplexIndex<double> index{1.04, 2.59};
    const double at_normal = reflect(index, 1.0).A();
    EXPECT_NEAR(normal_reflectance(index), at_normal, 1e-15);
    EXPECT_DOUBLE_EQ(schlick(at_normal, 1.0), at_normal);
    EXPECT_DOUBLE_EQ(schlick(at_normal, 0.0), 1);
}

TEST(FresnelChart, LazanyisTermIsExactInTheMiddleToo) {
    for (const ComplexIndex<double> index : {ComplexIndex<double>{1.04, 2.59}, {0.96, 6.69}}) {
        const double at_normal = normal_reflectance(index), a = lazanyi_amplitude(index);
        for (const double cosine : {0.0, 1.0 / 7, 1.0}) {
            EXPECT_NEAR(lazanyi(at_normal, a, cosine), reflect(index, cosine).A(), 1e-14);
        }
    }
}

TEST(FresnelChart, LargeIndexIsExactAtNormalIncidenceAndImprovesWithTheSquareOfTheIndex) {
    const auto worst = [](double scale) {
        const ComplexIndex<double> index{1.3 * scale, 4.2 * scale};
        double error = 0;
        // Even in the logarithm of the cosine: the dip of Rp is where it is about 1/|N|.
        for (int i = 0; i <= 1000; ++i) {
            const double c = std::pow(10.0, -0.005 * i);
            const Reflection<double> exact = reflect(index, c);
            const ReflectancePair<double> pair = large_index_reflect(index, c);
            error = std::max({error, std::abs(pair.Rs - exact.Rs), std::abs(pair.Rp - exact.Rp)});
            if (i == 0) {
                EXPECT_NEAR(pair.Rs, exact.Rs, 1e-14);
                EXPECT_NEAR(pair.Rp, exact.Rp, 1e-14);
            }
        }
        return error;
    };
    EXPECT_NEAR(std::log10(worst(10) / worst(100)), 2, 0.15);
}

// Linear interpolation errs by the square of the step.
TEST(FresnelChart, TablesImproveWithTheSquareOfTheirSize) {
    const DenseIndex metal = dense(published_set("Cu-McPeak"));
    const double coarse =
        fresnel_error(method_of(metal, "table over cos", "16 intervals"), metal).rms;
    const double fine =
        fresnel_error(method_of(metal, "table over cos", "64 intervals"), metal).rms;
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2, 0.25);
}

TEST(FresnelChart, TablesHoldTheEnds) {
    const DenseIndex metal = dense(published_set("Cu-McPeak"));
    const FresnelMethod table = method_of(metal, "table over cos", "4 intervals");
    for (const float cosine : {0.0f, 0.25f, 1.0f}) {
        const ReflectancePair<FresnelPacket> pair = table.pair(cosine, 3);
        const FresnelPacket mean = table.reflectance(cosine, 3);
        for (int lane = 0; lane < 8; ++lane) {
            const int i = 3 + lane * FresnelWavelengths::spacing;
            const Reflection<double> r = reflect(index_at(metal, i), static_cast<double>(cosine));
            EXPECT_NEAR(static_cast<double>(pair.Rs[lane]), r.Rs, 1e-6);
            EXPECT_NEAR(static_cast<double>(pair.Rp[lane]), r.Rp, 1e-6);
            EXPECT_NEAR(static_cast<double>(mean[lane]), r.A(), 1e-6);
        }
    }
}

}  // namespace
}  // namespace drude
