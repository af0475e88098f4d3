#include "scene/lexer.h"

#include <gtest/gtest.h>

#include <chrono>

namespace drude {
namespace {

Lexer lexer_of(const std::string& text) {
    return Lexer(std::make_shared<const Source>(Source{"t.pbrt", text}));
}

TEST(Lexer, GivesTokensWithTheirPlaces) {
    Lexer lexer = lexer_of("Shape \"sphere\"# end\n\t[ 1 -2.5e3]\r\n# all\n  X");
    struct Expected {
        Token::Kind kind;
        const char* text;
        int line, column;
    };
    const Expected expected[] = {
        {Token::Kind::word, "Shape", 1, 1},  {Token::Kind::string, "sphere", 1, 7},
        {Token::Kind::open, "[", 2, 2},      {Token::Kind::word, "1", 2, 4},
        {Token::Kind::word, "-2.5e3", 2, 6}, {Token::Kind::close, "]", 2, 12},
        {Token::Kind::word, "X", 4, 3},      {Token::Kind::end, "", 4, 4},
        {Token::Kind::end, "", 4, 4},
    };
    for (const Expected& e : expected) {
        const Token token = lexer.take();
        EXPECT_EQ(static_cast<int>(token.kind), static_cast<int>(e.kind)) << e.text;
        EXPECT_EQ(token.text, e.text);
        EXPECT_EQ(token.line, e.line) << e.text;
        EXPECT_EQ(token.column, e.column) << e.text;
    }
}

TEST(Lexer, CountsCharactersNotBytes) {
    Lexer lexer = lexer_of("\xef\xbb\xbf\"\xc3\xa4\xe2\x82\xac\" X");
    EXPECT_EQ(lexer.take().column, 1);
    EXPECT_EQ(lexer.take().column, 6);
}

TEST(Lexer, ReplacesEscapes) {
    Lexer lexer = lexer_of(R"("a\"b\\c\n\t\'")");
    EXPECT_EQ(string_value(lexer.take()), "a\"b\\c\n\t'");
}

void expect_failure(const std::string& text, const std::string& place, const std::string& part) {
    try {
        Lexer lexer = lexer_of(text);
        while (lexer.take().kind != Token::Kind::end) {
        }
        ADD_FAILURE() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.message().rfind(place + ": ", 0), 0u) << error.message();
        EXPECT_NE(error.message().find(part), std::string::npos) << error.message();
    }
}

TEST(Lexer, RefusesWhatIsNoToken) {
    expect_failure("a\n  \"open\nb\"", "t.pbrt:2:3", "not closed on its line");
    expect_failure("\"open", "t.pbrt:1:1", "ends before it is closed");
    expect_failure("\"open\\", "t.pbrt:1:1", "ends before it is closed");
    expect_failure("\"a\\q\"", "t.pbrt:1:3", "unknown escape '\\q'");
    expect_failure(std::string("\xff\xfeW\0", 4), "t.pbrt:1:1", "UTF-16");
}

TEST(Lexer, IsLinearInTheText) {
    // A million tokens in one line and a comment of a megabyte: quadratic time would be hours.
    std::string text;
    for (int i = 0; i < 1000000; ++i) text += "1 ";
    text += "#" + std::string(1000000, '#');
    Lexer lexer = lexer_of(text);
    int count = 0;
    while (lexer.take().kind != Token::Kind::end) ++count;
    EXPECT_EQ(count, 1000000);
}

TEST(Shown, EscapesAndCuts) {
    EXPECT_EQ(shown(std::string_view("a\0\xff", 3)), "a\\x00\\xff");
    EXPECT_EQ(shown(std::string(100, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace drude
