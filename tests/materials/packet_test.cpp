// Packets of floats against double, lane by lane.
#include "materials/packet.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "materials/fresnel.h"
#include "materials/numeric.h"

namespace drude {
namespace {

template <class P>
class PacketTest : public testing::Test {
  public:
    static constexpr int lanes = P::size;

    static P random(numeric::Uniform& u, double low, double high) {
        float values[lanes];
        for (float& v : values) v = static_cast<float>(u.between(low, high));
        return P::load(values);
    }
};

using Packets = testing::Types<Packet<4>, Packet<8>, Packet<16>, Packet<40>>;
TYPED_TEST_SUITE(PacketTest, Packets);

TYPED_TEST(PacketTest, LoadsStoresAndSetsLanes) {
    constexpr int n = TypeParam::size;
    float in[n], out[n];
    for (int i = 0; i < n; ++i) in[i] = 0.5f + static_cast<float>(i);
    TypeParam p = TypeParam::load(in);
    p.store(out);
    for (int i = 0; i < n; ++i) {
        EXPECT_EQ(out[i], in[i]);
        EXPECT_EQ(p[i], in[i]);
    }
    p.set(n - 1, -3.0f);
    for (int i = 0; i < n; ++i) EXPECT_EQ(p[i], i == n - 1 ? -3.0f : in[i]);
    const TypeParam same(1.25f), from_double(1.25), from_int(7);
    for (int i = 0; i < n; ++i) {
        EXPECT_EQ(same[i], 1.25f);
        EXPECT_EQ(from_double[i], 1.25f);
        EXPECT_EQ(from_int[i], 7.0f);
    }
}

// Addition to division and square roots are rounded as those of a float are: the bits agree.
TYPED_TEST(PacketTest, ArithmeticIsThatOfFloat) {
    numeric::Uniform u(1);
    for (int round = 0; round < 200; ++round) {
        const TypeParam a = this->random(u, -10, 10), b = this->random(u, -10, 10);
        TypeParam sum_in_place = a, difference_in_place = a, product_in_place = a;
        sum_in_place += b;
        difference_in_place -= b;
        product_in_place *= b;
        const TypeParam sums = a + b, differences = a - b, products = a * b, ratios = a / b;
        const TypeParam negative = -a, size = abs(a), larger = max(a, b), smaller = min(a, b);
        const TypeParam roots = sqrt(size);
        const TypeParam below = select(a < b, TypeParam(1), TypeParam(0));
        const TypeParam above = select(a > b, TypeParam(1), TypeParam(0));
        const TypeParam not_below = select(a >= b, TypeParam(1), TypeParam(0));
        for (int i = 0; i < TypeParam::size; ++i) {
            EXPECT_EQ(sums[i], a[i] + b[i]);
            EXPECT_EQ(differences[i], a[i] - b[i]);
            EXPECT_EQ(products[i], a[i] * b[i]);
            EXPECT_EQ(ratios[i], a[i] / b[i]);
            EXPECT_EQ(sum_in_place[i], sums[i]);
            EXPECT_EQ(difference_in_place[i], differences[i]);
            EXPECT_EQ(product_in_place[i], products[i]);
            EXPECT_EQ(negative[i], -a[i]);
            EXPECT_EQ(size[i], std::abs(a[i]));
            EXPECT_EQ(larger[i], std::max(a[i], b[i]));
            EXPECT_EQ(smaller[i], std::min(a[i], b[i]));
            EXPECT_EQ(roots[i], std::sqrt(size[i]));
            EXPECT_EQ(below[i], a[i] < b[i] ? 1.0f : 0.0f);
            EXPECT_EQ(above[i], a[i] > b[i] ? 1.0f : 0.0f);
            EXPECT_EQ(not_below[i], a[i] >= b[i] ? 1.0f : 0.0f);
        }
    }
}

TYPED_TEST(PacketTest, ComparesEqualLanes) {
    const TypeParam a(2.0f);
    EXPECT_EQ(select(a < a, TypeParam(1), TypeParam(0))[3], 0.0f);
    EXPECT_EQ(select(a > a, TypeParam(1), TypeParam(0))[3], 0.0f);
    EXPECT_EQ(select(a >= a, TypeParam(1), TypeParam(0))[3], 1.0f);
}

TYPED_TEST(PacketTest, SquareRootOfTheEdges) {
    TypeParam a(0.0f);
    a.set(1, 1e-38f);
    a.set(2, 3e38f);
    a.set(TypeParam::size - 1, 4.0f);
    const TypeParam root = sqrt(a);
    EXPECT_EQ(root[0], 0.0f);
    EXPECT_EQ(root[1], std::sqrt(1e-38f));
    EXPECT_EQ(root[2], std::sqrt(3e38f));
    EXPECT_EQ(root[TypeParam::size - 1], 2.0f);
}

TYPED_TEST(PacketTest, ExpAgreesWithDouble) {
    numeric::Uniform u(2);
    double worst = 0;
    for (int round = 0; round < 4000; ++round) {
        const TypeParam a = this->random(u, round % 2 ? -87 : -2, round % 2 ? 88 : 2);
        const TypeParam e = exp(a);
        for (int i = 0; i < TypeParam::size; ++i) {
            const double exact = std::exp(static_cast<double>(a[i]));
            worst = std::max(worst, std::abs(e[i] / exact - 1));
        }
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_EQ(exp(TypeParam(0.0f))[0], 1.0f);
    EXPECT_LT(exp(TypeParam(-1000.0f))[0], 2e-38f);
    EXPECT_GE(exp(TypeParam(-1000.0f))[0], 0.0f);
    EXPECT_TRUE(std::isfinite(exp(TypeParam(1000.0f))[0]));
}

TYPED_TEST(PacketTest, ExpLessOneKeepsItsDigitsNextToZero) {
    numeric::Uniform u(12);
    double worst = 0;
    for (int round = 0; round < 4000; ++round) {
        const double size = std::pow(10, u.between(-30, 1.9));
        const TypeParam a = this->random(u, -size, size);
        const TypeParam e = expm1(a);
        for (int i = 0; i < TypeParam::size; ++i) {
            if (a[i] == 0) continue;
            const double exact = std::expm1(static_cast<double>(a[i]));
            worst = std::max(worst, std::abs(e[i] / exact - 1));
        }
    }
    EXPECT_LT(worst, 3e-7);
    EXPECT_EQ(expm1(TypeParam(0.0f))[0], 0.0f);
    EXPECT_EQ(expm1(TypeParam(-1000.0f))[0], -1.0f);
}

TYPED_TEST(PacketTest, SinAndCosOfTurnsAgreeWithDouble) {
    numeric::Uniform u(3);
    double worst = 0;
    for (const double range : {0.5, 1.0, 100.0, 1e4, 1048576.0}) {
        for (int round = 0; round < 1000; ++round) {
            const TypeParam turns = this->random(u, -range, range);
            TypeParam sine, cosine;
            sincos_turns(turns, &sine, &cosine);
            for (int i = 0; i < TypeParam::size; ++i) {
                // remainder() is exact.
                const double angle = 2 * pi * std::remainder(static_cast<double>(turns[i]), 1.0);
                worst = std::max({worst, std::abs(sine[i] - std::sin(angle)),
                                  std::abs(cosine[i] - std::cos(angle))});
            }
        }
    }
    EXPECT_LT(worst, 2e-7);
}

// Eighths of a turn are where the series change hands.
TYPED_TEST(PacketTest, SinAndCosAtTheSeams) {
    for (int eighth = -24; eighth <= 24; ++eighth) {
        for (const float shift : {-1e-6f, 0.0f, 1e-6f}) {
            const float turns = static_cast<float>(eighth) / 8 + shift;
            TypeParam sine, cosine;
            sincos_turns(TypeParam(turns), &sine, &cosine);
            const double angle = 2 * pi * static_cast<double>(turns);
            EXPECT_NEAR(sine[0], std::sin(angle), 2e-7) << turns;
            EXPECT_NEAR(cosine[0], std::cos(angle), 2e-7) << turns;
        }
    }
}

TYPED_TEST(PacketTest, RoundsToTheNearest) {
    numeric::Uniform u(4);
    for (int round = 0; round < 500; ++round) {
        const TypeParam a = this->random(u, -4e6, 4e6);
        const TypeParam near = this->random(u, -3, 3);
        for (int i = 0; i < TypeParam::size; ++i) {
            EXPECT_EQ(round_small(a)[i], std::nearbyint(a[i]));
            EXPECT_EQ(round_small(near)[i], std::nearbyint(near[i]));
        }
    }
}

TYPED_TEST(PacketTest, SumsAndFindsTheLargestLane) {
    constexpr int n = TypeParam::size;
    TypeParam a;
    for (int i = 0; i < n; ++i) a.set(i, static_cast<float>((i * 7) % n));
    EXPECT_EQ(sum(a), static_cast<float>(n * (n - 1) / 2));
    EXPECT_EQ(max_lane(a), static_cast<float>(n - 1));
    EXPECT_EQ(max_lane(-a), 0.0f);
}

// Where almost nothing is reflected, rounding must not make a reflectance negative.
TYPED_TEST(PacketTest, ReflectancesStayBetweenZeroAndOne) {
    numeric::Uniform u(5);
    float lowest = 0, highest = 0;
    for (int round = 0; round < 4000; ++round) {
        const bool faint = round % 2 == 0;
        const ComplexIndex<TypeParam> index{this->random(u, faint ? 0.98 : 0.02, faint ? 1.02 : 10),
                                            faint ? TypeParam(0.0f) : this->random(u, 0, 15)};
        const auto r = reflect(index, this->random(u, 0, 1));
        for (int i = 0; i < TypeParam::size; ++i) {
            lowest = std::min({lowest, r.Rs[i], r.Rp[i]});
            highest = std::max({highest, r.Rs[i], r.Rp[i]});
        }
    }
    EXPECT_GE(lowest, 0.0f);
    EXPECT_LE(highest, 1.0f + 3e-7f);
}

}  // namespace
}  // namespace drude
