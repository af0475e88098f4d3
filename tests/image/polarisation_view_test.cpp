#include "image/polarisation_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/expect_error.h"
#include "image/analyser.h"
#include "shared_data.h"

namespace drude {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

// One pixel a Stokes vector, in the layers "S0.<suffix>" to "S3.<suffix>".
void add_layers(Image& image, const std::string& suffix,
                const std::vector<std::array<float, 4>>& pixels) {
    image.width = static_cast<int>(pixels.size());
    image.height = 1;
    for (size_t i = 0; i < 4; ++i) {
        Channel& channel = image.add("S" + std::to_string(i) + "." + suffix);
        for (size_t p = 0; p < pixels.size(); ++p) channel.data[p] = pixels[p][i];
    }
}

Image colours(const std::vector<std::array<float, 4>>& pixels) {
    Image image;
    for (const char* colour : {"R", "G", "B"}) add_layers(image, colour, pixels);
    return image;
}

StokesLayer layer_of(const std::vector<std::array<float, 4>>& pixels) {
    const Image image = colours(pixels);
    return read_stokes_layer(image, "a.exr", choose_layer(image, "a.exr", {}), true);
}

TEST(PolarisationView, FiguresByHand) {
    const StokesLayer layer = layer_of({{2, 0.6F, 0.8F, 0}, {4, 0, -1, 0}, {1, 0.5F, 0, -0.5F}});
    const auto dop = view_values(layer, PolarisationView::dop);
    const auto dolp = view_values(layer, PolarisationView::dolp);
    const auto docp = view_values(layer, PolarisationView::docp);
    const auto aolp = view_values(layer, PolarisationView::aolp);
    EXPECT_NEAR(dop[0], 0.5, 1e-7);
    EXPECT_NEAR(dop[2], std::numbers::sqrt2 / 2, 1e-7);
    EXPECT_NEAR(dolp[0], 0.5, 1e-7);
    EXPECT_NEAR(dolp[1], 0.25, 1e-7);
    EXPECT_NEAR(docp[2], 0.5, 1e-7);
    EXPECT_NEAR(aolp[0], 0.5 * std::atan2(0.8, 0.6) * 180 / std::numbers::pi, 1e-5);
    EXPECT_NEAR(aolp[1], 135.0, 1e-5);  // tangential, up-right of a sphere's centre
    EXPECT_EQ(aolp[2], 0.0);
    EXPECT_NEAR(view_values(layer, PolarisationView::s3)[2], -0.5, 1e-7);
    EXPECT_NEAR(view_values(layer, PolarisationView::s0)[1], 4.0, 1e-6);
}

// The angle closes: just above and just below the horizontal are neighbours of 0 and of 180.
TEST(PolarisationView, AnglesStayBelowAHalfTurn) {
    const StokesLayer layer =
        layer_of({{1, 1, -1e-6F, 0}, {1, 1, 1e-6F, 0}, {1, -1, 0, 0}, {1, 1, -1e-30F, 0}});
    const auto aolp = view_values(layer, PolarisationView::aolp);
    EXPECT_NEAR(aolp[0], 180.0, 1e-3);
    EXPECT_NEAR(aolp[1], 0.0, 1e-3);
    EXPECT_NEAR(aolp[2], 90.0, 1e-12);
    for (const double angle : aolp) EXPECT_TRUE(angle >= 0.0 && angle < 180.0) << angle;
}

TEST(PolarisationView, WithoutLightThereIsNoPolarisationAndNoNaNInThePicture) {
    const StokesLayer layer = layer_of(
        {{0, 0, 0, 0}, {-1, 0.5F, 0, 0}, {nan_value, 0, 0, 0}, {1, nan_value, 0, 0}, {1, 0, 0, 0}});
    const Colour grey = faded_cyclic_colour(0.0, 0.0);
    for (const auto view : {PolarisationView::dop, PolarisationView::dolp, PolarisationView::aolp,
                            PolarisationView::s1}) {
        const auto values = view_values(layer, view);
        const ColourBar bar = view_bar(view, values, {});
        const Picture picture = view_picture(layer, view, values, bar);
        for (const float value : picture.rgb) EXPECT_TRUE(std::isfinite(value));
        const int first = view == PolarisationView::s1 ? 3 : 0;
        for (int x = first; x < 4; ++x) {
            if (view == PolarisationView::s1 && x == 2) continue;
            EXPECT_EQ(picture.at(x, 0), grey) << x;
        }
        const bool angle = view == PolarisationView::aolp;
        EXPECT_EQ(std::isnan(values[4]), angle);  // unpolarised light: a degree of 0, no angle
        EXPECT_EQ(picture.at(4, 0) == grey, angle);
    }
}

TEST(PolarisationView, AnglesFadeToGrey) {
    const StokesLayer layer =
        layer_of({{1, 0.5F, 0, 0}, {1, 0.1001F, 0, 0}, {1, 0.05F, 0, 0}, {1, 1e-4F, 0, 0}});
    const auto values = view_values(layer, PolarisationView::aolp);
    const Picture picture = view_picture(layer, PolarisationView::aolp, values,
                                         view_bar(PolarisationView::aolp, values, {}));
    const Colour full = map_colour(ColourMap::cyclic, 0.0), grey = faded_cyclic_colour(0, 0);
    EXPECT_EQ(picture.at(0, 0), full);
    EXPECT_EQ(picture.at(1, 0), full);
    const auto away = [&](int x) { return std::abs(picture.at(x, 0)[2] - grey[2]); };
    EXPECT_LT(away(2), 0.9F * away(1));
    EXPECT_LT(away(3), 0.01F);
}

TEST(PolarisationView, RangesAreSymmetricAndNotSetByFireflies) {
    std::vector<double> values(1000, 0.0234);
    values[3] = -1e6;
    const ColourBar bar = view_bar(PolarisationView::s2, values, {});
    EXPECT_EQ(bar.low, -0.024);
    EXPECT_EQ(bar.high, 0.024);
    EXPECT_EQ(bar.map, ColourMap::diverging);
    EXPECT_EQ(view_bar(PolarisationView::s0, values, {}).low, 0.0);
    EXPECT_EQ(view_bar(PolarisationView::s0, {4.6, nan_value}, {}).high, 4.6);
    EXPECT_EQ(view_bar(PolarisationView::s0, {123.0}, {}).high, 130.0);
    EXPECT_EQ(view_bar(PolarisationView::s3, {0.0, 0.0}, {}).high, 1.0);
    EXPECT_EQ(view_bar(PolarisationView::s3, {}, {}).high, 1.0);
    EXPECT_EQ(view_bar(PolarisationView::s3, values, 0.5).low, -0.5);
    EXPECT_EQ(view_bar(PolarisationView::dolp, values, {}).high, 1.0);
    EXPECT_EQ(view_bar(PolarisationView::dolp, values, 0.3).high, 0.3);
    EXPECT_THROW(view_bar(PolarisationView::s0, values, -1.0), std::logic_error);
}

TEST(StokesLayer, NearestWavelengthOrLuminance) {
    Image image;
    add_layers(image, "500,000000nm", {{1, 0, 0, 0}});
    add_layers(image, "600,000000nm", {{2, 0, 0, 0.5F}});
    EXPECT_EQ(choose_layer(image, "a", 551.0).suffix, "600,000000nm");
    EXPECT_EQ(choose_layer(image, "a", 550.0).wavelength_nm, 500.0);
    EXPECT_NE(message_of([&] { choose_layer(image, "a", {}); }).find("--wavelength"),
              std::string::npos);
    for (const char* colour : {"R", "G", "B"}) add_layers(image, colour, {{1, 1, 0, 0}});
    EXPECT_EQ(choose_layer(image, "a", {}).suffix, "Y");
    const LayerChoice red = choose_layer(image, "a", 600.0);
    EXPECT_EQ(read_stokes_layer(image, "a", red, true).s[3][0], 0.5);
    image.attributes["polarisationHandedness"] = std::string("left");
    EXPECT_EQ(read_stokes_layer(image, "a", red, true).s[3][0], -0.5);

    const Image rgb = colours({{1, 0, 0, 0}});
    EXPECT_NE(message_of([&] { choose_layer(rgb, "a", 550.0); }).find("--spectral"),
              std::string::npos);
    Image plain;
    plain.width = plain.height = 1;
    for (const char* name : {"R", "G", "B"}) plain.add(name);
    EXPECT_NE(message_of([&] { choose_layer(plain, "a", {}); }).find("--stokes"),
              std::string::npos);
}

TEST(StokesLayer, ReadsArtsSpectralPicture) {
    const std::string path = shared_data("exr/art_polarised.exr");
    DRUDE_NEED_SHARED(path);
    const Image image = read_image(path);
    const LayerChoice choice = choose_layer(image, path, 550.0);
    EXPECT_EQ(choice.wavelength_nm, 560.0);
    const auto dop =
        view_values(read_stokes_layer(image, path, choice, true), PolarisationView::dop);
    for (const double degree : dop) EXPECT_TRUE(std::isnan(degree) || degree <= 1.0 + 1e-3);
}

// Half of what is unpolarised; everything, or nothing, of what is polarised.
TEST(Analyser, PassesWhatMalusSays) {
    const Image image = colours({{2, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1, 0}, {1, 0, 0, 1}});
    const auto passed = [&](const std::string& text) {
        const Analyser analyser = parse_analyser(text, "--show analyser");
        return behind_analyser(image, "a", analysed_layers(image, "a", {}), analyser)
            .at("G", "b")
            .data;
    };
    const auto expect = [&](const std::string& text, const std::vector<float>& expected) {
        const std::vector<float> got = passed(text);
        ASSERT_EQ(got.size(), expected.size());
        for (size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], 1e-6F) << text;
    };
    expect("0", {1, 1, 0.5F, 0.5F});
    expect("45", {1, 0.5F, 1, 0.5F});
    expect("90", {1, 0, 0.5F, 0.5F});
    expect("-45", {1, 0.5F, 0, 0.5F});
    expect("60", {1, 0.25F, 0.5F * (1 + std::sin(2.0943951F)), 0.5F});
    expect("0,retarder=-45", {1, 0.5F, 0.5F, 1});
    expect("0,retarder=45", {1, 0.5F, 0.5F, 0});
    expect("0,retarder=45:180", {1, 0, 0.5F, 0.5F});
}

// What comes out is light again: behind a second, crossed polariser there is nothing.
TEST(Analyser, WritesTheWholeStokesVectorOfEveryLayer) {
    Image image = colours({{2, 0.5F, 0.3F, 0.1F}});
    add_layers(image, "500,000000nm", {{3, 0.5F, -0.3F, 0.1F}});
    image.attributes["emissiveUnits"] = std::string("W.m^-2.sr^-1");
    const auto behind = [](const Image& from, const std::string& angle) {
        return behind_analyser(from, "a", analysed_layers(from, "a", {}),
                               parse_analyser(angle, "a"));
    };
    const Image once = behind(image, "30");
    EXPECT_EQ(once.channels.size(), 3U + 4U * 4U);
    EXPECT_EQ(once.text("analyser"), "30");
    EXPECT_EQ(once.text("emissiveUnits"), "W.m^-2.sr^-1");
    const double c = std::cos(std::numbers::pi / 3), s = std::sin(std::numbers::pi / 3);
    EXPECT_NEAR(once.at("S0.500,000000nm", "").data[0], 0.5 * (3 + 0.5 * c - 0.3 * s), 1e-6);
    EXPECT_NEAR(once.at("S2.500,000000nm", "").data[0], s * 0.5 * (3 + 0.5 * c - 0.3 * s), 1e-6);
    const Image twice = behind(once, "120");
    for (const Channel& channel : twice.channels) EXPECT_NEAR(channel.data[0], 0.0, 1e-6);
    const Image one = behind_analyser(image, "a", analysed_layers(image, "a", 510.0), {});
    EXPECT_EQ(one.channels.size(), 5U);
    EXPECT_EQ(one.at("Y", "").data, one.at("S0.500,000000nm", "").data);
}

TEST(Analyser, WordsAreReadStrictly) {
    const Analyser analyser = parse_analyser("12.5,retarder=-45:120", "x");
    EXPECT_EQ(analyser.axis_deg, 12.5);
    EXPECT_EQ(analyser.retarder->fast_axis_deg, -45.0);
    EXPECT_EQ(analyser.retarder->retardance_deg, 120.0);
    EXPECT_EQ(format_analyser(analyser), "12.5,retarder=-45:120");
    EXPECT_EQ(parse_analyser("0,retarder=45", "x").retarder->retardance_deg, 90.0);
    for (const char* text : {"", "x", "nan", "inf", "361", "45,", "45,retarder",
                             "45,retarder=", "45,retarder=4:", "45,retarder=4:x", "45,quarter=4",
                             "45 ", ",", "45,retarder=4,5"}) {
        EXPECT_NE(message_of([&] { parse_analyser(text, "--show analyser"); }), "") << text;
    }
    EXPECT_NE(message_of([] { parse_analyser("1,retader=4", "x"); }).find("'retarder'?"),
              std::string::npos);
}

}  // namespace
}  // namespace drude
