#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare_cases.h"

namespace drude {
namespace {

// Two values in one channel: differences 0.5 and -1 against references 1 and 2.
TEST(Compare, FiguresByHand) {
    Image a = picture(2, 1, {"Y"}, 0), b = a;
    a.channels[0].data = {1.5F, 1.0F};
    b.channels[0].data = {1.0F, 2.0F};
    const Comparison result = compare(a, b);
    EXPECT_EQ(result.channels, std::vector<std::string>{"Y"});
    EXPECT_NEAR(result.all.mean_error, -0.25, 1e-12);
    EXPECT_NEAR(result.all.mae, 0.75, 1e-12);
    EXPECT_NEAR(result.all.rmse, std::sqrt((0.25 + 1.0) / 2), 1e-12);
    EXPECT_NEAR(result.all.relmse, (0.25 / 1.01 + 1.0 / 4.01) / 2, 1e-12);
    EXPECT_NEAR(result.all.smape, (2 * 0.5 / 2.5 + 2 * 1.0 / 3.0) / 2, 1e-12);
    EXPECT_NEAR(result.all.psnr, 20 * std::log10(2.0 / result.all.rmse), 1e-12);
    EXPECT_NEAR(result.all.max_error, 1.0, 1e-12);
    EXPECT_FALSE(result.same);
    EXPECT_EQ(result.decision, Decision::identical);
    EXPECT_FALSE(result.noise.has_value());
}

TEST(Compare, FiguresOfEachChannelAndOfAll) {
    Image a = picture(4, 4, {"R", "G", "B", "depth"}, 1.0F), b = a;
    for (float& value : b.find("G")->data) value = 0.7F;
    b.find("depth")->data[0] = 99.0F;
    const Comparison result = compare(a, b);
    ASSERT_EQ(result.each.size(), 3U);
    EXPECT_EQ(result.each[0].max_error, 0.0);
    EXPECT_NEAR(result.each[1].mean_error, 0.3, 1e-7);
    EXPECT_NEAR(result.all.mean_error, 0.1, 1e-7);
    EXPECT_NEAR(result.all.rmse, 0.3 / std::sqrt(3.0), 1e-7);
}

TEST(Compare, EqualValuesAreTheSame) {
    const Image a = picture(3, 3, {"R", "G", "B"}, 0.25F);
    const Comparison result = compare(a, a);
    EXPECT_TRUE(result.same);
    EXPECT_EQ(result.all.rmse, 0.0);
    EXPECT_TRUE(std::isinf(result.all.psnr));
}

TEST(Compare, NotANumberIsNeverTheSameButInExact) {
    Image a = picture(3, 3, {"R", "G", "B"}, 0.25F);
    a.channels[1].data[4] = std::numeric_limits<float>::quiet_NaN();
    const Comparison values = compare(a, a);
    EXPECT_FALSE(values.same);
    EXPECT_EQ(values.not_finite, 1U);
    EXPECT_EQ(values.all.rmse, 0.0);
    CompareOptions exact;
    exact.exact = true;
    EXPECT_TRUE(compare(a, a, exact).same);
    CompareOptions tolerance;
    tolerance.tolerance = Tolerance{1e9, 1.0, 0.0};
    EXPECT_FALSE(compare(a, a, tolerance).same);
}

TEST(Compare, ExactLooksAtBitsNamesAndEveryChannelNotAtAttributes) {
    CompareOptions exact;
    exact.exact = true;
    Image a = picture(3, 2, {"R", "G", "B", "S3.R"}, 0.0F), b = a;
    b.attributes["seconds"] = 3.0F;
    EXPECT_TRUE(compare(a, b, exact).same);
    b.find("S3.R")->data[5] = -0.0F;
    EXPECT_FALSE(compare(a, b, exact).same);
    EXPECT_TRUE(compare(a, b).same);
    b.find("S3.R")->name = "S2.R";
    const std::string message = message_of([&] { compare(a, b, exact); });
    EXPECT_NE(message.find("S3.R"), std::string::npos) << message;
    EXPECT_NE(message.find("S2.R"), std::string::npos) << message;
}

TEST(Compare, ExactNeedsNoColour) {
    CompareOptions exact;
    exact.exact = true;
    const Image a = picture(3, 2, {"S0.500,000000nm"}, 1.0F);
    EXPECT_TRUE(compare(a, a, exact).same);
}

TEST(Compare, SizesAndChannelsAreDistinctErrors) {
    const Image a = picture(3, 2, {"R", "G", "B"}, 0.0F);
    const std::string size = message_of([&] { compare(a, picture(2, 3, {"R", "G", "B"}, 0)); });
    EXPECT_NE(size.find("3 x 2"), std::string::npos) << size;
    EXPECT_NE(size.find("2 x 3"), std::string::npos) << size;
    const std::string channel = message_of([&] { compare(a, picture(3, 2, {"R", "G"}, 0)); });
    EXPECT_NE(channel.find("b.exr"), std::string::npos) << channel;
    EXPECT_NE(channel.find("'B'"), std::string::npos) << channel;
}

TEST(Compare, PicturesOfDifferentScenesAreAnErrorUnlessMeant) {
    Image a = picture(2, 2, {"R", "G", "B"}, 0.5F), b = a;
    a.attributes["sceneHash"] = std::string("aaaaaaaaaaaaaaaa");
    EXPECT_TRUE(compare(a, b).same);  // one of them does not say
    b.attributes["sceneHash"] = std::string("bbbbbbbbbbbbbbbb");
    const std::string message = message_of([&] { compare(a, b); });
    EXPECT_NE(message.find("different scenes"), std::string::npos) << message;
    EXPECT_NE(message.find("--any-scene"), std::string::npos) << message;
    CompareOptions any;
    any.any_scene = true;
    EXPECT_TRUE(compare(a, b, any).same);
}

TEST(Compare, LayersOfDifferentWavelengthsAreAnErrorOfTheirOwn) {
    const Image a = picture(2, 2, {"R", "G", "B", "S0.400,000000nm", "S0.500,000000nm"}, 0.5F);
    const Image b = picture(2, 2, {"R", "G", "B", "S0.400,000000nm", "S0.600,000000nm"}, 0.5F);
    EXPECT_TRUE(compare(a, b).same);  // in their colours
    CompareOptions layers, exact;
    layers.channels = {"S0.400,000000nm"};
    exact.exact = true;
    for (const CompareOptions& options : {layers, exact}) {
        const std::string message = message_of([&] { compare(a, b, options); });
        EXPECT_NE(message.find("wavelengths"), std::string::npos) << message;
        EXPECT_NE(message.find("2 from 400 to 600 nm"), std::string::npos) << message;
    }
}

std::vector<std::string> stokes_names() {
    std::vector<std::string> names;
    for (const char* layer : {"S0.", "S1.", "S2.", "S3."}) {
        for (const char* colour : {"R", "G", "B"}) names.push_back(std::string(layer) + colour);
    }
    return names;
}

TEST(Compare, EachStokesComponentHasItsErrors) {
    std::vector<std::string> names = stokes_names();
    names.insert(names.end(), {"R", "G", "B"});
    const Image a = picture(3, 2, names, 0.5F);
    Image b = a;
    for (float& value : b.find("S2.G")->data) value = 0.2F;
    const Comparison result = compare(a, b);
    ASSERT_EQ(result.stokes.size(), 4U);
    EXPECT_EQ(result.stokes[1].rmse, 0.0);
    EXPECT_NEAR(result.stokes[2].rmse, 0.3 / std::sqrt(3.0), 1e-7);
    EXPECT_NEAR(result.stokes[2].mean_error, 0.1, 1e-7);
    EXPECT_TRUE(compare(picture(2, 2, {"R", "G", "B"}, 0), picture(2, 2, {"R", "G", "B"}, 0))
                    .stokes.empty());
}

TEST(Compare, ToleranceIsTheLargerOfAbsoluteAndRelative) {
    Image a = picture(10, 10, {"Y"}, 100.0F), b = a;
    b.channels[0].data[0] = 100.5F;
    b.channels[0].data[1] = 101.5F;
    const auto same = [&](double absolute, double relative, double percent) {
        CompareOptions options;
        options.tolerance = Tolerance{absolute, relative, percent};
        return compare(a, b, options).same;
    };
    EXPECT_FALSE(same(0, 0, 0));
    EXPECT_FALSE(same(1.0, 0, 0));
    EXPECT_TRUE(same(1.5, 0, 0));
    EXPECT_TRUE(same(1.0, 0, 1.0));
    EXPECT_FALSE(same(0.1, 0, 1.0));
    EXPECT_TRUE(same(0, 0.015, 0));
    EXPECT_FALSE(same(0, 0.004, 1.0));
}

TEST(Compare, ToleranceText) {
    const Tolerance all = parse_tolerance("1e-4,1e-3,0.5");
    EXPECT_EQ(all.absolute, 1e-4);
    EXPECT_EQ(all.relative, 1e-3);
    EXPECT_EQ(all.percent, 0.5);
    EXPECT_EQ(parse_tolerance("2").absolute, 2.0);
    EXPECT_EQ(parse_tolerance("2").percent, 0.0);
    for (const char* bad : {"", "x", "1,", "-1", "1,2,3,4", "nan", "1, 2", "0,0,101", "inf"}) {
        EXPECT_NE(message_of([&] { parse_tolerance(bad); }), "") << bad;
    }
}

TEST(Compare, ChannelLists) {
    const Image image = picture(
        1, 1, {"B", "G", "R", "S0.500,000000nm", "S0.505,000000nm", "S1.R", "variance.R"}, 0);
    using Names = std::vector<std::string>;
    const auto parse = [&](const std::string& list) { return parse_channels(list, image, "f"); };
    EXPECT_EQ(parse("R,G"), (Names{"R", "G"}));
    EXPECT_EQ(parse("S0.500,000000nm,R"), (Names{"S0.500,000000nm", "R"}));
    EXPECT_EQ(parse("R,S0.505,000000nm"), (Names{"R", "S0.505,000000nm"}));
    EXPECT_EQ(parse("S0,R,R"), (Names{"S0.500,000000nm", "S0.505,000000nm", "R"}));
    EXPECT_EQ(parse("all").size(), 6U);
    EXPECT_NE(message_of([&] { parse("S1.G"); }).find("S1.R"), std::string::npos);
    EXPECT_NE(message_of([&] { parse(""); }), "");
    EXPECT_NE(message_of([&] { parse("R,,G"); }), "");
}

// Pictures of drude hold their polarisation and its variances.
Image polarised(float sign) {
    Image image = picture(8, 8, {"R", "G", "B"}, 0.5F);
    for (const char* layer : {"S1", "S2", "S3"}) {
        for (const char* colour : {".R", ".G", ".B"}) {
            std::vector<float>& data = image.add(std::string(layer) + colour).data;
            data.assign(data.size(), layer[1] == '1' ? 0.1F : sign * 0.1F);
        }
    }
    return image;
}

TEST(Compare, PolarisationOfTheOtherSignIsADifference) {
    Image a = polarised(1.0F), b = polarised(-1.0F);
    EXPECT_TRUE(compare(a, a).same);
    EXPECT_FALSE(compare(a, b).same);
    // The figures are of R, G, B, as for a file without S1 to S3.
    EXPECT_EQ(compare(a, b).all.rmse, 0.0);
    EXPECT_EQ(compare(a, b).channels.size(), 12U);
    for (Image* image : {&a, &b}) {
        image->attributes["batches"] = 16;
        for (const Channel& channel : std::vector<Channel>(image->channels)) {
            std::vector<float>& variance = image->add(variance_name(channel.name)).data;
            variance.assign(variance.size(), 1e-6F);
        }
    }
    const Comparison noisy = compare(a, b);
    EXPECT_EQ(noisy.decision, Decision::noise);
    EXPECT_FALSE(noisy.same);
    EXPECT_EQ(noisy.noise->worst.channel[0], 'S');
    CompareOptions colours;
    colours.channels = {"R", "G", "B"};
    EXPECT_TRUE(compare(a, b, colours).same);
    // A picture without them is compared by what both have.
    b.channels.erase(b.channels.begin() + 3);
    EXPECT_EQ(compare(a, b).channels.size(), 3U);
}

TEST(Compare, APassSaysWhatItCouldNotHaveSeen) {
    Image a = picture(1, 1, {"Y", "variance.Y"}, 0.5F);
    a.attributes["batches"] = 16;
    const Comparison result = compare(a, a);
    ASSERT_TRUE(result.same);
    // A variance of 0.5 a picture: the two means of 0.5 could be some units apart.
    EXPECT_NE(result.reason.find("a difference of the means below"), std::string::npos)
        << result.reason;
    EXPECT_NE(result.reason.find("% of B's) would not show"), std::string::npos) << result.reason;
    a.find("variance.Y")->data[0] = 1e-8F;
    EXPECT_NE(compare(a, a).reason, result.reason);
}

TEST(Compare, FiguresOfNoValueAreNoNumbers) {
    const Image none = picture(2, 2, {"Y"}, std::numeric_limits<float>::quiet_NaN());
    const Comparison result = compare(none, picture(2, 2, {"Y"}, 1.0F));
    EXPECT_FALSE(result.same);
    EXPECT_EQ(result.not_finite, 4U);
    EXPECT_TRUE(std::isnan(result.all.rmse));
    EXPECT_TRUE(std::isnan(result.all.psnr));
    EXPECT_TRUE(std::isnan(result.each[0].max_error));
}

}  // namespace
}  // namespace drude
