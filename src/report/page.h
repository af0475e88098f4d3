// A self-contained HTML page: pictures as data URIs, style and script inline, nothing fetched.
//
// Light and dark by the reader's preference, narrow screens and print included. Every text is
// escaped; SVG and markup() alone are taken as they are.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drude {

struct PageTable {
    std::string caption;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  // short rows are filled with empty cells
    // One a column: numbers align to the right with figures of one width. Missing means text.
    std::vector<bool> numeric;
};

// PNG bytes and what a reader who does not see them should know.
struct PagePicture {
    std::string png;
    std::string alt;
};

class Page {
  public:
    // `language` as in BCP 47.
    explicit Page(std::string title, std::string language = "en");

    // The title shown at the top and the sentence beneath it.
    void banner(const std::string& eyebrow, const std::string& lead);
    // Ends the section before it and is listed in the navigation; `id` from identifier().
    void section(const std::string& heading, const std::string& id);
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    // A paragraph set apart, for what a reader must not miss.
    void note(const std::string& text);
    void list(const std::vector<std::string>& items);
    // Terms and what they are, in two columns.
    void facts(const std::vector<std::pair<std::string, std::string>>& items);
    void table(const PageTable& table);
    // The same, folded away under `summary` until the reader opens it; open in print.
    void details(const std::string& summary, const PageTable& table);
    // Text in a typewriter face, line breaks kept.
    void code(const std::string& text);
    void svg(const std::string& svg, const std::string& caption);
    // HTML of the caller's making, taken as it is: nothing of it is escaped.
    void markup(const std::string& html);
    // What such markup needs beside what every page has.
    void style(const std::string& css);
    void script(const std::string& js);
    // Throws std::invalid_argument where `png` is no PNG, as does comparison().
    void picture(const PagePicture& picture, const std::string& caption);
    // Two pictures of one size, one over the other, and a divider to drag or to move with the arrow
    // keys. Side by side in print and without script.
    void comparison(const PagePicture& left, const std::string& left_label,
                    const PagePicture& right, const std::string& right_label,
                    const std::string& caption);
    // One picture in whose place the other, of the same size, is seen while the pointer or the
    // focus is on it. Both, one below the other, in print.
    void swap(const PagePicture& shown, const PagePicture& beneath, const std::string& caption);
    // What follows until the matching end stands side by side where there is room for it.
    void begin_grid();
    void end_grid();

    // The finished document.
    std::string html() const;

  private:
    void close_grid();

    std::string title_, language_, banner_, body_, style_, script_;
    std::vector<std::pair<std::string, std::string>> sections_;  // id, heading
    bool in_section_ = false, in_grid_ = false;
    int comparisons_ = 0;
};

}  // namespace drude
