#include "scene/lexer.h"

namespace drude {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

bool ends_word(char c) {
    return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#';
}

// What a backslash and this letter stand for, or 0.
char escape_value(char letter) {
    switch (letter) {
        case 'b':
            return '\b';
        case 'f':
            return '\f';
        case 'n':
            return '\n';
        case 'r':
            return '\r';
        case 't':
            return '\t';
        case '\\':
        case '\'':
        case '"':
            return letter;
        default:
            return 0;
    }
}

}  // namespace

Lexer::Lexer(std::shared_ptr<const Source> source) : source_(std::move(source)) {
    const std::string_view text = source_->text;
    if (text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff") {
        fail(1, 1, "the file is UTF-16; expected UTF-8: save it again in that encoding");
    }
    if (text.substr(0, 3) == "\xef\xbb\xbf") position_ = 3;
}

void Lexer::fail(int line, int column, const std::string& message) const {
    throw Error(Cause::user, Place{source_->path, line, column}, message);
}

const Token& Lexer::peek() {
    if (!peeked_) token_ = scan();
    peeked_ = true;
    return token_;
}

Token Lexer::take() {
    peek();
    peeked_ = false;
    return token_;
}

void Lexer::advance() {
    const char c = source_->text[position_++];
    if (c == '\n') {
        ++line_;
        column_ = 1;
    } else if ((static_cast<unsigned char>(c) & 0xc0u) != 0x80u) {
        ++column_;
    }
}

Token Lexer::scan() {
    const std::string& text = source_->text;
    while (position_ < text.size()) {
        const char c = text[position_];
        if (c == '#') {
            while (position_ < text.size() && text[position_] != '\n' && text[position_] != '\r') {
                advance();
            }
        } else if (is_space(c)) {
            advance();
        } else {
            break;
        }
    }
    Token token;
    token.line = line_;
    token.column = column_;
    if (position_ == text.size()) return token;
    const size_t begin = position_;
    if (text[begin] == '"') return scan_string();
    if (text[begin] == '[' || text[begin] == ']') {
        token.kind = text[begin] == '[' ? Token::Kind::open : Token::Kind::close;
        advance();
    } else {
        token.kind = Token::Kind::word;
        while (position_ < text.size() && !ends_word(text[position_])) advance();
    }
    token.text = std::string_view(text).substr(begin, position_ - begin);
    return token;
}

Token Lexer::scan_string() {
    const std::string& text = source_->text;
    Token token;
    token.kind = Token::Kind::string;
    token.line = line_;
    token.column = column_;
    advance();
    const size_t begin = position_;
    while (position_ < text.size() && text[position_] != '"') {
        if (text[position_] == '\n') {
            fail(token.line, token.column,
                 "a string starts here and is not closed on its line; expected '\"'");
        }
        if (text[position_] == '\\') {
            const int line = line_, column = column_;
            advance();
            if (position_ == text.size()) break;
            if (escape_value(text[position_]) == 0) {
                fail(line, column,
                     fmt::format("unknown escape '\\{}' in a string; expected one of \\b \\f \\n "
                                 "\\r \\t \\\\ \\' \\\"",
                                 shown(std::string_view(text).substr(position_, 1))));
            }
        }
        advance();
    }
    if (position_ == text.size()) {
        fail(token.line, token.column,
             "a string starts here and the file ends before it is closed; expected '\"'");
    }
    token.text = std::string_view(text).substr(begin, position_ - begin);
    advance();
    return token;
}

std::string string_value(const Token& token) {
    std::string value;
    value.reserve(token.text.size());
    for (size_t i = 0; i < token.text.size(); ++i) {
        char c = token.text[i];
        if (c == '\\' && i + 1 < token.text.size()) c = escape_value(token.text[++i]);
        value.push_back(c);
    }
    return value;
}

std::string shown(std::string_view text, size_t longest) {
    std::string result;
    for (const char c : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f) {
            result += fmt::format("\\x{:02x}", byte);
        } else {
            result.push_back(c);
        }
    }
    if (text.size() > longest) result += "...";
    return result;
}

}  // namespace drude
