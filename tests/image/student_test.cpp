#include "image/student.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace drude {
namespace {

TEST(IncompleteBeta, KnownClosedForms) {
    for (const double x : {0.0, 1e-8, 0.1, 0.5, 0.7, 0.999, 1.0}) {
        EXPECT_NEAR(incomplete_beta(1, 1, x), x, 1e-14);
        EXPECT_NEAR(incomplete_beta(3, 1, x), x * x * x, 1e-14);
        EXPECT_NEAR(incomplete_beta(1, 4, x), 1 - std::pow(1 - x, 4), 1e-14);
        EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2 / std::numbers::pi * std::asin(std::sqrt(x)),
                    1e-13);
        EXPECT_NEAR(incomplete_beta(2.5, 7, x) + incomplete_beta(7, 2.5, 1 - x), 1, 1e-13);
    }
    EXPECT_TRUE(std::isnan(incomplete_beta(-1, 1, 0.5)));
    EXPECT_TRUE(std::isnan(incomplete_beta(1, 1, 1.5)));
}

// One, two and four degrees of freedom have elementary distribution functions.
TEST(Student, ElementaryCases) {
    for (const double t : {0.0, 0.3, 1.0, 2.5, 10.0, 100.0}) {
        EXPECT_NEAR(student_two_sided(t, 1), 1 - 2 / std::numbers::pi * std::atan(t), 1e-13);
        EXPECT_NEAR(student_two_sided(t, 2), 1 - t / std::sqrt(2 + t * t), 1e-13);
        const double s = t / std::sqrt(4 + t * t);
        EXPECT_NEAR(student_two_sided(t, 4), 1 - s * (1.5 - 0.5 * s * s), 1e-13);
        EXPECT_DOUBLE_EQ(student_two_sided(-t, 4), student_two_sided(t, 4));
    }
}

// Critical values as printed in every table of the distribution (two-sided).
TEST(Student, TableOfCriticalValues) {
    struct Entry {
        double p, degrees, t;
    };
    for (const Entry& entry :
         {Entry{0.05, 10, 2.228139}, Entry{0.01, 10, 3.169273}, Entry{0.05, 30, 2.042272},
          Entry{0.001, 15, 4.072765}, Entry{0.10, 5, 2.015048}, Entry{0.05, 1, 12.706205}}) {
        EXPECT_NEAR(student_quantile(entry.p, entry.degrees), entry.t, 1e-5);
        EXPECT_NEAR(student_two_sided(entry.t, entry.degrees), entry.p, 1e-6);
    }
}

TEST(Student, FarTailKeepsItsDigits) {
    // Cauchy tail: 2/(pi t) (1 - 1/(3 t^2) + ...).
    const double t = 1e9;
    EXPECT_NEAR(student_two_sided(t, 1) / (2 / (std::numbers::pi * t)), 1, 1e-12);
    // 2 degrees: 1 - t/sqrt(2 + t^2) = 1/t^2 (1 - 3/(2 t^2) + ...).
    EXPECT_NEAR(student_two_sided(1e7, 2) * 1e14, 1, 1e-12);
    EXPECT_GT(student_two_sided(60, 30), 0);
    EXPECT_LT(student_two_sided(60, 30), 1e-30);
}

TEST(Student, LimitIsTheNormalDistribution) {
    for (const double t : {0.1, 1.0, 3.0, 6.0}) {
        const double normal = std::erfc(t / std::numbers::sqrt2);
        EXPECT_NEAR(student_two_sided(t, 1e9) / normal, 1, 1e-14);
        // Across the switch from one formula to the other there is no jump.
        EXPECT_NEAR(student_two_sided(t, 99999) / student_two_sided(t, 100001), 1, 1e-2);
        EXPECT_NEAR(student_two_sided(t, 99999) / normal, 1, 5e-3);
    }
    EXPECT_TRUE(std::isnan(student_two_sided(1, 0)));
    EXPECT_TRUE(std::isnan(student_two_sided(std::nan(""), 3)));
    EXPECT_EQ(student_two_sided(std::numeric_limits<double>::infinity(), 3), 0);
}

TEST(Student, QuantileInvertsTheTail) {
    for (const double degrees : {1.0, 2.7, 15.0, 400.0, 1e8}) {
        for (const double p : {1e-12, 1e-6, 0.01, 0.5, 0.99}) {
            const double t = student_quantile(p, degrees);
            EXPECT_NEAR(student_two_sided(t, degrees) / p, 1, 1e-9) << p << " " << degrees;
        }
    }
}

TEST(Sidak, FamilyAndEachAreInverse) {
    EXPECT_NEAR(sidak_family(0.05, 2), 0.0975, 1e-15);
    EXPECT_NEAR(sidak_each(0.0975, 2), 0.05, 1e-15);
    // Many tests: 1 - (1-p)^m computed naively would lose every digit here.
    EXPECT_NEAR(sidak_family(1e-18, 1e6) / 1e-12, 1, 1e-9);
    EXPECT_NEAR(sidak_family(sidak_each(1e-3, 786432), 786432), 1e-3, 1e-15);
    EXPECT_EQ(sidak_family(1, 5), 1);
    EXPECT_EQ(sidak_family(0, 5), 0);
}

}  // namespace
}  // namespace drude
