// Catalogue glasses by the numbers that name them: n_d and the Abbe number, from their codes.
#include "materials/glasses.h"

#include <gtest/gtest.h>

namespace drude {
namespace {

TEST(Glasses, HaveTheIndexAndDispersionOfTheCatalogue) {
    struct Known {
        const char* name;
        double nd, abbe;
    };
    const Known known[] = {{"BK7", 1.51680, 64.17},   {"BAF10", 1.67003, 47.11},
                           {"FK51A", 1.48656, 84.47}, {"LASF9", 1.85025, 32.17},
                           {"SF5", 1.67270, 32.21},   {"SF10", 1.72825, 28.41},
                           {"SF11", 1.78472, 25.76}};
    ASSERT_EQ(glasses().size(), std::size(known));
    for (const Known& k : known) {
        const Glass* glass = find_glass(k.name);
        ASSERT_NE(glass, nullptr) << k.name;
        // Fraunhofer's d, F and C.
        const double nd = glass->n(587.5618), nF = glass->n(486.1327), nC = glass->n(656.2725);
        EXPECT_NEAR(nd, k.nd, 1e-5) << k.name;
        EXPECT_NEAR((nd - 1) / (nF - nC), k.abbe, 0.01) << k.name;
        const DenseSpectrum n = dense_index(*glass);
        EXPECT_EQ(n.front(), glass->n(380));
        for (size_t i = 1; i < n.size(); ++i) EXPECT_LT(n[i], n[i - 1]);
    }
}

TEST(Glasses, AnswerToTheNamesOfPbrt) {
    EXPECT_EQ(find_glass("F11"), find_glass("SF11"));
    EXPECT_EQ(find_glass("F5"), find_glass("SF5"));
    EXPECT_EQ(find_glass("K7"), nullptr);
    EXPECT_EQ(find_glass(""), nullptr);
}

}  // namespace
}  // namespace drude
