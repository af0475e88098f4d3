#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>

#include "report/markup.h"
#include "report/web.h"

namespace drude {

namespace {

template <class... Args>
void add(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

// An img element; its size comes from the PNG's own header, so that the page does not jump.
std::string image_element(const PagePicture& picture) {
    constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    const std::string_view png = picture.png;
    if (png.size() < 33 || png.substr(0, 8) != signature || png.substr(12, 4) != "IHDR")
        throw std::invalid_argument("page: the picture of \"" + picture.alt + "\" is no PNG");
    const auto big_endian = [&](size_t at) {
        uint32_t value = 0;
        for (size_t i = at; i < at + 4; ++i)
            value = value << 8 | static_cast<unsigned char>(png[i]);
        return value;
    };
    return fmt::format(R"(<img src="data:image/png;base64,{}" width="{}" height="{}" alt="{}">)",
                       base64(png), big_endian(16), big_endian(20), escape_markup(picture.alt));
}

std::string caption_element(const std::string& caption) {
    return caption.empty() ? "" : "<figcaption>" + escape_markup(caption) + "</figcaption>";
}

}  // namespace

Page::Page(std::string title, std::string language)
    : title_(std::move(title)), language_(std::move(language)) {}

void Page::banner(const std::string& eyebrow, const std::string& lead) {
    banner_ = fmt::format("<p class=\"eyebrow\">{}</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n",
                          escape_markup(eyebrow), escape_markup(title_), escape_markup(lead));
}

void Page::section(const std::string& heading, const std::string& id) {
    close_grid();
    if (in_section_) body_ += "</section>\n";
    in_section_ = true;
    const std::string safe = identifier(id);
    sections_.emplace_back(safe, heading);
    add(body_, "<section id=\"{}\">\n<h2>{}</h2>\n", safe, escape_markup(heading));
}

void Page::heading(const std::string& text) {
    add(body_, "<h3>{}</h3>\n", escape_markup(text));
}

void Page::paragraph(const std::string& text) {
    add(body_, "<p>{}</p>\n", escape_markup(text));
}

void Page::note(const std::string& text) {
    add(body_, "<p class=\"note\">{}</p>\n", escape_markup(text));
}

void Page::list(const std::vector<std::string>& items) {
    if (items.empty()) return;
    body_ += "<ul class=\"items\">\n";
    for (const std::string& item : items) add(body_, "<li>{}</li>\n", escape_markup(item));
    body_ += "</ul>\n";
}

void Page::facts(const std::vector<std::pair<std::string, std::string>>& items) {
    if (items.empty()) return;
    body_ += "<dl class=\"facts\">\n";
    for (const auto& item : items)
        add(body_, "<dt>{}</dt><dd>{}</dd>\n", escape_markup(item.first),
            escape_markup(item.second));
    body_ += "</dl>\n";
}

void Page::table(const PageTable& table) {
    const auto style = [&](size_t column) {
        const bool number = column < table.numeric.size() && table.numeric[column];
        return number ? " class=\"number\"" : "";
    };
    const std::string caption = escape_markup(table.caption);
    // Wide tables scroll within their own region, by keyboard too.
    add(body_, "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{}\"><table>\n",
        caption.empty() ? "Table" : caption);
    if (!caption.empty()) add(body_, "<caption>{}</caption>\n", caption);
    body_ += "<thead><tr>";
    for (size_t i = 0; i < table.columns.size(); ++i)
        add(body_, "<th scope=\"col\"{}>{}</th>", style(i), escape_markup(table.columns[i]));
    body_ += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        body_ += "<tr>";
        for (size_t i = 0; i < std::max(row.size(), table.columns.size()); ++i) {
            const std::string cell = i < row.size() ? escape_markup(row[i]) : "";
            if (i == 0) {
                add(body_, "<th scope=\"row\"{}>{}</th>", style(i), cell);
            } else {
                add(body_, "<td{}>{}</td>", style(i), cell);
            }
        }
        body_ += "</tr>\n";
    }
    body_ += "</tbody>\n</table></div>\n";
}

void Page::details(const std::string& summary, const PageTable& table_inside) {
    add(body_, "<details><summary>{}</summary>\n", escape_markup(summary));
    table(table_inside);
    body_ += "</details>\n";
}

void Page::code(const std::string& text) {
    add(body_, "<pre><code>{}</code></pre>\n", escape_markup(text));
}

void Page::svg(const std::string& svg, const std::string& caption) {
    add(body_, "<figure>{}{}</figure>\n", svg, caption_element(caption));
}

void Page::markup(const std::string& html) {
    body_ += html;
}

void Page::style(const std::string& css) {
    style_ += css;
}

void Page::script(const std::string& js) {
    script_ += js;
}

void Page::picture(const PagePicture& picture, const std::string& caption) {
    add(body_, "<figure>{}{}</figure>\n", image_element(picture), caption_element(caption));
}

void Page::comparison(const PagePicture& left, const std::string& left_label,
                      const PagePicture& right, const std::string& right_label,
                      const std::string& caption) {
    const std::string left_text = escape_markup(left_label);
    const std::string right_text = escape_markup(right_label);
    add(body_,
        "<figure><div class=\"compare\"><div class=\"bottom\">{}<span class=\"tag right\">{}</span>"
        "</div>\n<div class=\"top\">{}<span class=\"tag left\">{}</span></div>\n"
        "<div class=\"bar\"></div><input type=\"range\" min=\"0\" max=\"100\" step=\"any\" "
        "value=\"50\" id=\"compare-{}\" data-left=\"{}\" data-right=\"{}\" "
        "aria-label=\"Divider between {} (left) and {} (right)\"></div>{}</figure>\n",
        image_element(right), right_text, image_element(left), left_text, ++comparisons_, left_text,
        right_text, left_text, right_text, caption_element(caption));
}

void Page::swap(const PagePicture& shown, const PagePicture& beneath, const std::string& caption) {
    add(body_,
        "<figure><div class=\"swap\" tabindex=\"0\" role=\"group\" "
        "aria-label=\"Two pictures in one place: the second shows with the focus\">{}"
        "<div class=\"over\">{}</div></div>{}</figure>\n",
        image_element(beneath), image_element(shown), caption_element(caption));
}

void Page::begin_grid() {
    close_grid();
    body_ += "<div class=\"grid\">\n";
    in_grid_ = true;
}

void Page::end_grid() {
    close_grid();
}

void Page::close_grid() {
    if (in_grid_) body_ += "</div>\n";
    in_grid_ = false;
}

std::string Page::html() const {
    std::string out;
    out.reserve(body_.size() + 16384);
    // The policy forbids every fetch, so that "self-contained" is not a promise but a fact.
    add(out,
        "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{}</title>\n<style>{}{}</style>\n</head>\n<body>\n<header>\n",
        escape_markup(language_), escape_markup(title_), web_style("page"), style_);
    if (banner_.empty()) {
        add(out, "<h1>{}</h1>\n", escape_markup(title_));
    } else {
        out += banner_;
    }
    out += "</header>\n";
    if (!sections_.empty()) {
        out += "<nav aria-label=\"Sections\"><ul>\n";
        for (const auto& entry : sections_)
            add(out, "<li><a href=\"#{}\">{}</a></li>\n", entry.first, escape_markup(entry.second));
        out += "</ul></nav>\n";
    }
    out += "<main>\n" + body_;
    if (in_grid_) out += "</div>\n";
    if (in_section_) out += "</section>\n";
    add(out, "</main>\n<script>{}{}</script>\n</body>\n</html>\n", web_script("page"), script_);
    return out;
}

}  // namespace drude
