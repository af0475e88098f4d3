// The tokens of pbrt's scene language, each with the place it stood at.
//
// Any bytes may come in; what is no token is an Error (user) at its place. Time is linear in the
// length of the text and nothing is allocated for a token.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"

namespace drude {

// A scene file in memory. Tokens and parameters refer to its text, so it lives as long as they do.
struct Source {
    std::string path;  // as errors name it
    std::string text;
};

struct Token {
    enum class Kind { word, string, open, close, end };
    Kind kind = Kind::end;
    std::string_view text;  // a string without its quotes, escapes still in place
    int line = 1, column = 1;
};

class Lexer {
  public:
    explicit Lexer(std::shared_ptr<const Source> source);

    // The next token, left where it is or taken. Comments ('#' up to the end of the line) and white
    // space are passed over. Kind::end repeats for ever.
    const Token& peek();
    Token take();

    Place place(const Token& token) const { return {source_->path, token.line, token.column}; }
    const std::shared_ptr<const Source>& source() const { return source_; }

  private:
    Token scan();
    Token scan_string();
    void advance();
    [[noreturn]] void fail(int line, int column, const std::string& message) const;

    std::shared_ptr<const Source> source_;
    size_t position_ = 0;
    int line_ = 1, column_ = 1;  // columns count characters of UTF-8, not bytes
    bool peeked_ = false;
    Token token_;
};

// The characters that a string token stands for: \b \f \n \r \t \\ \' \" replaced.
std::string string_value(const Token& token);

// Text for an error message: bytes that do not print are escaped, long text is cut.
std::string shown(std::string_view text, size_t longest = 60);

}  // namespace drude
