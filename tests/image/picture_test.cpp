#include "image/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "image/colour_map.h"
#include "image/difference.h"
#include "image/font.h"
#include "image/sheet.h"
#include "image/srgb.h"

namespace drude {
namespace {

const Colour white = {1.0F, 1.0F, 1.0F}, black = {0.0F, 0.0F, 0.0F}, red = {1.0F, 0.0F, 0.0F};

double luminance(const Colour& c) {
    return 0.2126 * static_cast<double>(c[0]) + 0.7152 * static_cast<double>(c[1]) +
           0.0722 * static_cast<double>(c[2]);
}

double lightness(double y) {
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

// What a person without one kind of red-green cone sees, in linear RGB (rows of F. Vienot,
// H. Brettel & J. Mollon, Color Res. Appl. 24, 243, 1999; both collapse red and green alike).
Colour without_red_green(const Colour& c, bool deuteranope) {
    const float r = c[0], g = c[1], b = c[2];
    if (deuteranope) {
        const float rg = 0.29275F * r + 0.70725F * g;
        return {rg, rg, -0.02234F * r + 0.02234F * g + b};
    }
    const float rg = 0.11238F * r + 0.88762F * g;
    return {rg, rg, 0.00401F * r - 0.00401F * g + b};
}

TEST(Font, EveryPrintableLetterHasItsOwnShape) {
    std::set<Glyph> shapes;
    for (char32_t letter = 0x20; letter < 0x7f; ++letter) shapes.insert(glyph(letter));
    EXPECT_EQ(shapes.size(), 95U);
    for (const char32_t letter : {0xb0, 0xb1, 0xd7, 0x394, 0x3a8, 0x3b2, 0x3bb, 0x3c8}) {
        EXPECT_TRUE(shapes.insert(glyph(letter)).second) << static_cast<unsigned>(letter);
        EXPECT_NE(glyph(letter), glyph(0xfffd));
    }
    EXPECT_EQ(glyph(U' '), Glyph{});
    EXPECT_EQ(glyph(U'T')[0], 0x1f);
    EXPECT_EQ(glyph(U'T')[3], 0x04);
    EXPECT_EQ(glyph(U'p')[8], 0x10);
    EXPECT_EQ(glyph(0x4e2d), glyph(0xfffd));
}

TEST(Font, TextIsUtf8AndBrokenTextIsSurvived) {
    EXPECT_EQ(code_points("a\xce\xb2\xe4\xb8\xad\xf0\x9f\x98\x80"),
              (std::vector<char32_t>{U'a', 0x3b2, 0x4e2d, 0x1f600}));
    EXPECT_EQ(code_points("\xce"), std::vector<char32_t>{0xfffd});
    EXPECT_EQ(code_points("\xce(\xff"), (std::vector<char32_t>{0xfffd, U'(', 0xfffd}));
    EXPECT_EQ(text_width(""), 0);
    EXPECT_EQ(text_width("l"), 5);
    EXPECT_EQ(text_width("\xce\xb2\xce\xb2"), 11);
}

TEST(Picture, TextIsDrawnDotByDotAndClipped) {
    Picture picture(20, 20, white);
    draw_text(picture, 2, 1, "T", black, 2);
    // The top bar of the T: five dots of two pixels from (2, 1).
    for (int x = 0; x < 20; ++x) {
        EXPECT_EQ(picture.at(x, 1), x >= 2 && x < 12 ? black : white) << x;
    }
    EXPECT_EQ(picture.at(6, 14), black);  // the foot of its stem
    EXPECT_EQ(picture.at(6, 15), white);
    draw_text(picture, -3, -3, "WWWW", black, 9);
    draw_text(picture, 1000, 1000, "W", black, 3);
    EXPECT_THROW(Picture(0, 3, white), std::logic_error);
}

TEST(Picture, PicturesAndRectanglesAreCopiedAndClipped) {
    Picture small(2, 2, red), large(5, 4, white);
    draw_picture(large, 4, 3, small);
    EXPECT_EQ(large.at(4, 3), red);
    EXPECT_EQ(large.at(3, 3), white);
    draw_frame(large, 0, 0, 3, 3, black);
    EXPECT_EQ(large.at(1, 1), white);
    EXPECT_EQ(large.at(2, 1), black);
    EXPECT_EQ(large.at(1, 2), black);
}

TEST(ColourMap, SequentialGetsLighterForEveryEye) {
    const auto lightness_of = [](const Colour& c) { return lightness(luminance(c)); };
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const Colour a = map_colour(ColourMap::sequential, static_cast<double>(i) / steps);
        const Colour b = map_colour(ColourMap::sequential, (i + 1.0) / steps);
        EXPECT_GT(lightness_of(b) - lightness_of(a), 0.4) << i;
        EXPECT_LT(lightness_of(b) - lightness_of(a), 3.5) << i;
        for (const bool deuteranope : {false, true}) {
            EXPECT_GT(lightness_of(without_red_green(b, deuteranope)),
                      lightness_of(without_red_green(a, deuteranope)))
                << i;
        }
        for (const float value : a) EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
    }
    EXPECT_LT(lightness_of(map_colour(ColourMap::sequential, 0)), 8);
    EXPECT_GT(lightness_of(map_colour(ColourMap::sequential, 1)), 92);
}

TEST(ColourMap, DivergingIsWhiteInTheMiddleAndEvenTowardsBothEnds) {
    EXPECT_EQ(map_colour(ColourMap::diverging, 0.5), white);
    double last = 101.0;
    for (int i = 0; i <= 32; ++i) {
        const double distance = i / 64.0;
        const Colour low = map_colour(ColourMap::diverging, 0.5 - distance);
        const Colour high = map_colour(ColourMap::diverging, 0.5 + distance);
        EXPECT_NEAR(lightness(luminance(low)), lightness(luminance(high)), 2.5) << i;
        EXPECT_LT(lightness(luminance(low)), last);
        last = lightness(luminance(low));
        if (i < 8) continue;
        // Blue against yellow is what red-green blindness leaves.
        for (const bool deuteranope : {false, true}) {
            const Colour seen_low = without_red_green(low, deuteranope);
            const Colour seen_high = without_red_green(high, deuteranope);
            EXPECT_GT(seen_low[2], seen_low[0]);
            EXPECT_LT(seen_high[2], seen_high[0]);
        }
    }
}

// A full turn comes back, no step of it looks grey, and what is a sixth of a turn or more apart
// stays apart for every eye: distances of the cube roots of R, G, B, which follow lightness.
TEST(ColourMap, CyclicClosesAndKeepsDirectionsApartForEveryEye) {
    const auto distance = [](const Colour& a, const Colour& b) {
        double sum = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            const double d =
                std::cbrt(static_cast<double>(a[c])) - std::cbrt(static_cast<double>(b[c]));
            sum += d * d;
        }
        return std::sqrt(sum);
    };
    const Colour first = map_colour(ColourMap::cyclic, 0.0),
                 last = map_colour(ColourMap::cyclic, 1.0);
    EXPECT_LT(distance(first, last), 1e-5);
    const Colour grey = faded_cyclic_colour(0.3, 0.0);
    EXPECT_NEAR(grey[0], grey[1], 1e-5F);
    EXPECT_NEAR(grey[1], grey[2], 1e-5F);
    EXPECT_EQ(grey, faded_cyclic_colour(0.9, -1.0));
    constexpr int steps = 36;
    for (int i = 0; i < steps; ++i) {
        const Colour a = map_colour(ColourMap::cyclic, static_cast<double>(i) / steps);
        EXPECT_EQ(a, faded_cyclic_colour(static_cast<double>(i) / steps, 7.0));
        for (const float value : a) EXPECT_TRUE(value >= 0.0F && value <= 1.0F) << i;
        for (const bool deuteranope : {false, true}) {
            const Colour seen = without_red_green(a, deuteranope);
            EXPECT_GT(distance(seen, without_red_green(grey, deuteranope)), 0.12) << i;
            for (int k = steps / 6; k <= steps / 2; ++k) {
                const Colour b =
                    map_colour(ColourMap::cyclic, static_cast<double>((i + k) % steps) / steps);
                EXPECT_GT(distance(seen, without_red_green(b, deuteranope)), 0.12) << i << ' ' << k;
            }
        }
    }
}

TEST(ColourMap, ClampsAndMarksWhatIsNoNumber) {
    const double infinite = std::numeric_limits<double>::infinity();
    for (const ColourMap map : {ColourMap::sequential, ColourMap::diverging}) {
        EXPECT_EQ(map_colour(map, -infinite), map_colour(map, 0.0));
        EXPECT_EQ(map_colour(map, 7.0), map_colour(map, 1.0));
        EXPECT_EQ(map_colour(map, std::nan("")), (Colour{1.0F, 0.0F, 1.0F}));
    }
}

TEST(ColourBar, TicksAreRoundAndWithin) {
    using Ticks = std::vector<double>;
    EXPECT_EQ(bar_ticks(-5, 0), (Ticks{-5, -4, -3, -2, -1, 0}));
    EXPECT_EQ(bar_ticks(-0.1, 0.1), (Ticks{-0.1, -0.05, 0, 0.05, 0.1}));
    EXPECT_EQ(bar_ticks(0, 1), (Ticks{0, 0.2, 0.4, 0.6, 0.8, 1}));
    EXPECT_EQ(bar_ticks(0.1, 3.2), (Ticks{0.5, 1, 1.5, 2, 2.5, 3}));
    EXPECT_EQ(bar_ticks(0, 1e6).size(), 6U);
    EXPECT_EQ(bar_ticks(-3e-5, 2e-5), (Ticks{-3e-5, -2e-5, -1e-5, 0, 1e-5, 2e-5}));
}

TEST(ColourBar, NumbersGoWhereTheBarWantsThem) {
    const ColourBar bar = {ColourMap::cyclic, 0, 180, "", {0, 45, 90, 135, 180}};
    Picture picture(colour_bar_width(bar, 1) + 2, 120, white);
    draw_colour_bar(picture, 1, 10, 100, bar, red, 1);
    EXPECT_EQ(picture.at(14, 10 + 74), red);  // 45: a quarter up, 0.75 x 99 rows down
    EXPECT_EQ(picture.at(14, 10 + 80), white);
}

TEST(ColourBar, RunsFromLowAtTheBottomToHighAtTheTop) {
    const ColourBar bar = {ColourMap::sequential, -5, 0, ""};
    Picture picture(colour_bar_width(bar, 1) + 2, 120, white);
    draw_colour_bar(picture, 1, 10, 100, bar, red, 1);
    EXPECT_EQ(picture.at(5, 9), white);
    EXPECT_EQ(picture.at(5, 10), red);  // the frame
    const Colour expected = map_colour(ColourMap::sequential, 1.0 - 50.0 / 99.0);
    for (size_t c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(picture.at(5, 60)[c], expected[c]);
    EXPECT_GT(luminance(picture.at(5, 12)), luminance(picture.at(5, 107)));
    // Ticks right of the frame at both ends and at -1, four fifths up; nothing at other rows.
    EXPECT_EQ(picture.at(14, 10), red);
    EXPECT_EQ(picture.at(14, 109), red);
    EXPECT_EQ(picture.at(14, 10 + 20), red);
    EXPECT_EQ(picture.at(14, 10 + 25), white);
}

Image flat(int width, int height, float r, float g, float b) {
    Image image;
    image.width = width;
    image.height = height;
    const float values[] = {r, g, b};
    const char* names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        std::vector<float>& data = image.add(names[c]).data;
        data.assign(data.size(), values[c]);
    }
    return image;
}

TEST(Difference, LogIsOfTheMeanAbsoluteDifferenceSignedOfTheMean) {
    const Image a = flat(2, 1, 0.5F, 0.25F, 0.0F);
    Image b = flat(2, 1, 0.25F, 0.75F, 0.0F);
    for (Channel& channel : b.channels) channel.data[1] = a.find(channel.name)->data[1];
    const std::vector<std::string> rgb = {"R", "G", "B"};
    const std::vector<double> log = log_difference(a, b, rgb);
    EXPECT_NEAR(log[0], std::log10(0.75 / 3), 1e-12);
    EXPECT_TRUE(std::isinf(log[1]) && log[1] < 0);
    EXPECT_NEAR(signed_difference(a, b, rgb)[0], -0.25 / 3, 1e-12);
    b.find("G")->data[0] = std::nanf("");
    EXPECT_TRUE(std::isnan(log_difference(a, b, rgb)[0]));
    b.find("G")->data[0] = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(std::isnan(log_difference(a, b, rgb)[0]));
}

TEST(Difference, PictureUsesTheFixedRangeWhateverTheValues) {
    const ColourBar bar = log_difference_bar();
    EXPECT_EQ(bar.low, -5.0);
    EXPECT_EQ(bar.high, 0.0);
    const double infinite = std::numeric_limits<double>::infinity();
    const Picture picture = map_values(2, 2, {-2.5, -infinite, 3.0, std::nan("")}, bar);
    EXPECT_EQ(picture.at(0, 0), map_colour(bar.map, 0.5));
    EXPECT_EQ(picture.at(1, 0), map_colour(bar.map, 0.0));
    EXPECT_EQ(picture.at(0, 1), map_colour(bar.map, 1.0));
    EXPECT_EQ(picture.at(1, 1), (Colour{1.0F, 0.0F, 1.0F}));
    EXPECT_THROW(map_values(3, 2, {0.0}, bar), std::logic_error);
}

TEST(Difference, BarStandsBesideThePicture) {
    const Picture picture(200, 150, red);
    const Picture whole = with_colour_bar(picture, log_difference_bar());
    EXPECT_GT(whole.width, picture.width + colour_bar_width(log_difference_bar(), 1));
    EXPECT_EQ(whole.at(6, 6), red);
    EXPECT_EQ(whole.at(205, 155), red);
    EXPECT_EQ(whole.at(206, 155), white);
    // A tiny picture still gets a bar whose labels do not overlap.
    EXPECT_GE(with_colour_bar(Picture(4, 4, red), log_difference_bar()).height, 50);
}

TEST(Sheet, CellsStandInRowsAndColumnsWithCaptions) {
    Sheet sheet;
    sheet.title = "T";
    sheet.row_captions = {"first row", ""};
    sheet.column_captions = {"Cu", "Ag", "Au"};
    const Colour colours[] = {red, black, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    sheet.cells.resize(2);
    for (size_t r = 0; r < 2; ++r) {
        for (size_t c = 0; c < 3; ++c) {
            sheet.cells[r].push_back(c < 2 ? Picture(30, 20, colours[2 * r + c]) : Picture());
        }
    }
    sheet.bars[1] = {ColourMap::sequential, -5, 0, ""};
    const Picture picture = compose_sheet(sheet);
    int count[4] = {};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            for (int k = 0; k < 4; ++k) count[k] += picture.at(x, y) == colours[k] ? 1 : 0;
        }
    }
    for (const int k : {0, 1, 2, 3}) EXPECT_EQ(count[k], 600) << k;
    // Ink of captions: something dark above the first cell and left of it.
    bool above = false, beside = false;
    int first_x = picture.width, first_y = picture.height;
    for (int y = picture.height - 1; y >= 0; --y) {
        for (int x = picture.width - 1; x >= 0; --x) {
            if (picture.at(x, y) == red) {
                first_x = x;
                first_y = y;
            }
        }
    }
    for (int y = 0; y < first_y; ++y) {
        for (int x = first_x; x < first_x + 30; ++x) above |= luminance(picture.at(x, y)) < 0.1;
    }
    for (int y = first_y; y < first_y + 20; ++y) {
        for (int x = 0; x < first_x; ++x) beside |= luminance(picture.at(x, y)) < 0.1;
    }
    EXPECT_TRUE(above);
    EXPECT_TRUE(beside);
}

TEST(Sheet, RefusesShapesThatDoNotAgree) {
    Sheet sheet;
    EXPECT_THROW(compose_sheet(sheet), std::logic_error);
    sheet.row_captions = {"r"};
    sheet.column_captions = {"c"};
    sheet.cells = {{Picture()}};
    EXPECT_THROW(compose_sheet(sheet), std::logic_error);
    sheet.cells = {{Picture(2, 2, white), Picture(2, 2, white)}};
    EXPECT_THROW(compose_sheet(sheet), std::logic_error);
    sheet.column_captions = {"c", "d"};
    EXPECT_NO_THROW(compose_sheet(sheet));
    sheet.cells[0][1] = Picture(3, 2, white);
    EXPECT_THROW(compose_sheet(sheet), std::logic_error);
    sheet.cells[0][1] = Picture();
    sheet.bars[1] = {};
    EXPECT_THROW(compose_sheet(sheet), std::logic_error);
}

}  // namespace
}  // namespace drude
