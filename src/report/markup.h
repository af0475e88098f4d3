// Text and bytes made safe for SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace drude {

// `text` for element content and quoted attributes of XML and HTML: & < > " ' become references;
// what neither may hold (control characters, bytes that are not UTF-8) becomes U+FFFD.
std::string escape_markup(std::string_view text);

// RFC 4648 base64 with padding, no line breaks.
std::string base64(std::string_view bytes);

// "a-z0-9-" only, for ids: "Cu, 45°" becomes "cu-45"; never empty.
std::string identifier(std::string_view text);

inline constexpr int svg_font_size = 13;  // pixels

// The opening tag of a plot with its title and description for those who do not see it; the caller
// closes it. `id` is one of identifier()'s; the texts are escaped here.
std::string svg_head(const std::string& id, double width, double height, std::string_view title,
                     std::string_view description);

}  // namespace drude
