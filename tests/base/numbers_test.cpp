#include "base/numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>

#include "base/expect_error.h"

namespace drude {
namespace {

TEST(ParseDouble, ReadsWhatPeopleWrite) {
    EXPECT_EQ(parse_double("0.5"), 0.5);
    EXPECT_EQ(parse_double("+0.5"), 0.5);
    EXPECT_EQ(parse_double("-12e3"), -12000.0);
    EXPECT_EQ(parse_double(".25"), 0.25);
    EXPECT_EQ(parse_double("5."), 5.0);
    EXPECT_TRUE(std::isnan(parse_double("nan").value()));
    EXPECT_EQ(parse_double("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(ParseDouble, RefusesTheRest) {
    for (const char* text : {"", " 1", "1 ", "1,5", "0x10", "--1", "+-1", "+", "-", ".", "e5", "1e",
                             "12abc", "1e999", "1 2", "one"}) {
        EXPECT_FALSE(parse_double(text)) << "'" << text << "'";
    }
}

TEST(ParseInteger, KnowsItsRange) {
    EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<long long>::max());
    EXPECT_EQ(parse_integer("-7"), -7);
    EXPECT_EQ(parse_integer("+7"), 7);
    EXPECT_FALSE(parse_integer("9223372036854775808"));
    EXPECT_FALSE(parse_integer("1.0"));
    EXPECT_FALSE(parse_integer(""));
}

TEST(ParseUnsigned, TakesEverySeed) {
    EXPECT_EQ(parse_unsigned("18446744073709551615"), std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(parse_unsigned("0"), 0U);
    EXPECT_FALSE(parse_unsigned("18446744073709551616"));
    EXPECT_FALSE(parse_unsigned("-1"));
    EXPECT_FALSE(parse_unsigned("+-1"));
    EXPECT_FALSE(parse_unsigned(""));
}

TEST(FormatDouble, ReadsBackWithTheSameBits) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 100000; ++i) {
        const auto value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) continue;
        const auto back = parse_double(format_double(value));
        ASSERT_TRUE(back) << format_double(value);
        ASSERT_EQ(std::bit_cast<uint64_t>(*back), std::bit_cast<uint64_t>(value))
            << format_double(value);
    }
    EXPECT_EQ(format_double(0.1), "0.1");
    EXPECT_EQ(format_double(550), "550");
}

TEST(FormatDouble, NamesWhatIsNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(format_double(nan), "nan");
    EXPECT_EQ(format_double(-nan), "nan");
    EXPECT_EQ(format_double(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(json_number(nan), "null");
    EXPECT_EQ(json_number(0.25), "0.25");
}

TEST(ParseGrid, TakesRangesListsAndBoth) {
    EXPECT_EQ(parse_grid("550", "g"), (std::vector<double>{550}));
    EXPECT_EQ(parse_grid("45,60,75.5", "g"), (std::vector<double>{45, 60, 75.5}));
    EXPECT_EQ(parse_grid("380:400:5", "g"), (std::vector<double>{380, 385, 390, 395, 400}));
    EXPECT_EQ(parse_grid("380:399:5", "g"), (std::vector<double>{380, 385, 390, 395}));
    EXPECT_EQ(parse_grid("1:2:1,9", "g"), (std::vector<double>{1, 2, 9}));
    EXPECT_EQ(parse_grid("5:5:1", "g"), (std::vector<double>{5}));
}

TEST(ParseGrid, EndsExactlyWhereItWasTold) {
    // 3 * 0.1 is not 0.3 in binary, and 3 * 0.1 > 0.3.
    EXPECT_EQ(parse_grid("0:0.3:0.1", "g").back(), 0.3);
    EXPECT_EQ(parse_grid("0:0.3:0.1", "g").size(), 4U);
    EXPECT_EQ(parse_grid("380:780:0.1", "g").size(), 4001U);
    EXPECT_EQ(parse_grid("380:780:0.1", "g").back(), 780);
}

TEST(ParseGrid, SaysWhatIsWrong) {
    const auto refuses = [](const char* text, std::initializer_list<const char*> words) {
        expect_error(Cause::user, words, [&] { parse_grid(text, "--wavelengths"); });
    };
    refuses("", {"--wavelengths", "''"});
    refuses("380:abc:5", {"--wavelengths", "'abc'"});
    refuses("380:780", {"'380:780'", "FIRST:LAST:STEP"});
    refuses("780:380:5", {"780:380:5", "empty"});
    refuses("380:780:0", {"positive"});
    refuses("380:780:-5", {"positive"});
    refuses("nan", {"'nan'"});
    refuses("1:inf:1", {"'inf'"});
    refuses("1,,2", {"''"});
    refuses("0:1:1e-9", {"100000"});
    refuses("0:1e308:1e-300", {"100000"});
    // Parts that fit one by one must not add up beyond the limit.
    std::string many = "0:99999:1";
    for (int i = 0; i < 20; ++i) many += ",0:99999:1";
    refuses(many.c_str(), {"100000"});
}

}  // namespace
}  // namespace drude
