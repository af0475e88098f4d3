#include "report/markup.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

namespace drude {

namespace {

// The length of the UTF-8 sequence at `text[i]` (RFC 3629: no overlong forms, no surrogates, at
// most U+10FFFF), or 0.
size_t sequence_length(std::string_view text, size_t i) {
    const auto byte = [&](size_t j) {
        return j < text.size() ? static_cast<unsigned char>(text[j]) : 0u;
    };
    const unsigned lead = byte(i);
    size_t length = 0;
    uint32_t code = 0, lowest = 0;
    if (lead < 0x80) return 1;
    if ((lead & 0xe0u) == 0xc0) {
        length = 2, code = lead & 0x1fu, lowest = 0x80;
    } else if ((lead & 0xf0u) == 0xe0) {
        length = 3, code = lead & 0x0fu, lowest = 0x800;
    } else if ((lead & 0xf8u) == 0xf0) {
        length = 4, code = lead & 0x07u, lowest = 0x10000;
    } else {
        return 0;
    }
    for (size_t j = 1; j < length; ++j) {
        if ((byte(i + j) & 0xc0u) != 0x80) return 0;
        code = code << 6 | (byte(i + j) & 0x3fu);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    const bool never_a_character = code == 0xfffe || code == 0xffff;
    return code < lowest || code > 0x10ffff || surrogate || never_a_character ? 0 : length;
}

}  // namespace

std::string escape_markup(std::string_view text) {
    std::string out;
    out.reserve(text.size() + text.size() / 8);
    for (size_t i = 0; i < text.size();) {
        const size_t length = sequence_length(text, i);
        const char c = text[i];
        const bool control = length == 1 && (c == 0x7f || (static_cast<unsigned char>(c) < 0x20 &&
                                                           c != '\t' && c != '\n' && c != '\r'));
        if (length == 0 || control) {
            out += "\xef\xbf\xbd";
            ++i;
            continue;
        }
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out.append(text.substr(i, length));
        }
        i += length;
    }
    return out;
}

std::string base64(std::string_view bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group =
                group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        out += digits[group >> 18 & 63];
        out += digits[group >> 12 & 63];
        out += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
        out += i + 2 < bytes.size() ? digits[group & 63] : '=';
    }
    return out;
}

std::string identifier(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            out += upper ? static_cast<char>(c - 'A' + 'a') : c;
        } else if (!out.empty() && out.back() != '-') {
            out += '-';
        }
    }
    while (!out.empty() && out.back() == '-') out.pop_back();
    return out.empty() ? "part" : out;
}

std::string svg_head(const std::string& id, double width, double height, std::string_view title,
                     std::string_view description) {
    return fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" class="plot" viewBox="0 0 {0:.0f} {1:.0f}" )"
        R"(width="{0:.0f}" height="{1:.0f}" role="img" aria-labelledby="{2}-t {2}-d" )"
        R"(font-family="system-ui,sans-serif" font-size="{3}" fill="currentColor">)"
        R"(<title id="{2}-t">{4}</title><desc id="{2}-d">{5}</desc>)",
        width, height, id, svg_font_size, escape_markup(title), escape_markup(description));
}

}  // namespace drude
