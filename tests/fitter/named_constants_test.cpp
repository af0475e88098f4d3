#include "fitter/named_constants.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace drude {
namespace {

TEST(NamedConstants, AreSetsNumbersAndFormulas) {
    EXPECT_EQ(find_constants("Al-Rakic", "--substrate").name, "Al-Rakic");
    const Index flat = find_constants("1.46,0.5", "--substrate").at(633);
    EXPECT_EQ(flat.n, 1.46);
    EXPECT_EQ(flat.k, 0.5);
    for (const double nm : {200.1, 333.3, 632.8, 1550.3}) {
        const double um = nm / 1000;
        EXPECT_NEAR(find_constants("cauchy:1.452,0.0036,1e-5", "").at(nm).n,
                    1.452 + 0.0036 / (um * um) + 1e-5 / (um * um * um * um), 1e-6);
    }
    const FilmLayer layer = find_layer("cauchy:1.452,0.0036,12.5", "--overlayer");
    EXPECT_EQ(layer.thickness_nm, 12.5);
    EXPECT_NEAR(layer.constants.at(1000).n, 1.4556, 1e-6);
    EXPECT_EQ(find_layer("Al2O3-Malitson-o,3", "").constants.name, "Al2O3-Malitson-o");
    EXPECT_EQ(find_layer("1.77,0,3", "").constants.at(400).n, 1.77);
}

TEST(NamedConstants, RefuseTheRestByName) {
    const auto expect = [](const std::string& text, bool layer, const std::string& part) {
        try {
            if (layer) {
                find_layer(text, "--overlayer");
            } else {
                find_constants(text, "--overlayer");
            }
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            EXPECT_EQ(error.message().rfind("--overlayer", 0), 0u) << error.message();
            EXPECT_NE(error.message().find(part), std::string::npos) << error.message();
        }
    };
    expect("Al-Raki", false, "Al-Rakic");
    expect("0,1", false, "n above 0");
    expect("cauchy:1.4", false, "coefficients");
    expect("cauchy:x,1", false, "coefficients");
    expect("Al2O3", true, "thickness");
    expect("Al2O3,", true, "thickness");
    expect("Al2O3,-1", true, "-1");
    expect("Al2O3,nan", true, "nan");
    expect(",3", true, "thickness");
    expect("", true, "thickness");
}

TEST(NamedConstants, ACauchyThatFallsBelowZeroIsAnError) {
    EXPECT_THROW(cauchy_constants({1, -1, 0}), Error);
}

}  // namespace
}  // namespace drude
