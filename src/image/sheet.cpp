#include "image/sheet.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "image/font.h"

namespace drude {

namespace {

struct CellSize {
    int width = 0, height = 0;
};

CellSize cell_size(const Sheet& sheet) {
    if (sheet.cells.empty() || sheet.cells.size() != sheet.row_captions.size()) {
        throw std::logic_error("compose_sheet: as many rows of cells as row captions are needed");
    }
    CellSize size;
    for (const std::vector<Picture>& row : sheet.cells) {
        if (row.size() != sheet.column_captions.size()) {
            throw std::logic_error("compose_sheet: a row is not as long as the column captions");
        }
        for (const Picture& cell : row) {
            if (cell.width == 0) continue;
            if (size.width == 0) size = {cell.width, cell.height};
            if (cell.width != size.width || cell.height != size.height) {
                throw std::logic_error("compose_sheet: pictures of different sizes");
            }
        }
    }
    if (size.width == 0) throw std::logic_error("compose_sheet: no picture");
    for (const auto& bar : sheet.bars) {
        if (bar.first >= sheet.cells.size()) {
            throw std::logic_error("compose_sheet: a colour bar beside no row");
        }
    }
    return size;
}

// Lines of at most `most` letters where blanks allow.
std::vector<std::string> break_lines(const std::string& text, int most) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const int letters =
            static_cast<int>(lines.empty() ? 0 : code_points(lines.back() + ' ' + word).size());
        if (lines.empty() || letters > most) {
            lines.push_back(word);
        } else {
            lines.back() += ' ' + word;
        }
    }
    return lines;
}

}  // namespace

Picture compose_sheet(const Sheet& sheet) {
    const CellSize cell = cell_size(sheet);
    constexpr int letters_in_row_caption = 14;
    const int scale = std::max(1, std::min(cell.width, cell.height) / 120);
    const int gap = 6 * scale, line = (glyph_height + 2) * scale;
    const Colour paper = {1.0F, 1.0F, 1.0F}, ink = srgb_colour(30, 30, 30);

    std::vector<std::vector<std::string>> row_lines;
    int caption_width = 0;
    for (const std::string& caption : sheet.row_captions) {
        row_lines.push_back(break_lines(caption, letters_in_row_caption));
        for (const std::string& text : row_lines.back()) {
            caption_width = std::max(caption_width, text_width(text) * scale);
        }
    }
    int bar_width = 0;
    for (const auto& entry : sheet.bars) {
        const ColourBar& bar = entry.second;
        bar_width = std::max(
            {bar_width, colour_bar_width(bar, scale) + gap, text_width(bar.label) * scale + gap});
    }

    const int columns = static_cast<int>(sheet.column_captions.size());
    const int rows = static_cast<int>(sheet.cells.size());
    const int left = 2 * gap + caption_width + (caption_width > 0 ? gap : 0);
    const int title_height = sheet.title.empty() ? 0 : line + gap;
    const int top = gap + title_height + line;
    const int title_width = text_width(sheet.title) * scale;
    const int width =
        std::max(left + columns * (cell.width + gap) + bar_width, title_width + 2 * gap) + gap;
    const int height = top + rows * (cell.height + gap) + gap;
    Picture picture(width, height, paper);

    draw_text(picture, (width - title_width) / 2, gap, sheet.title, ink, scale);
    for (int column = 0; column < columns; ++column) {
        const std::string& caption = sheet.column_captions[static_cast<size_t>(column)];
        const int x = left + column * (cell.width + gap);
        draw_text(picture, x + (cell.width - text_width(caption) * scale) / 2, gap + title_height,
                  caption, ink, scale);
    }
    for (int row = 0; row < rows; ++row) {
        const size_t r = static_cast<size_t>(row);
        const int y = top + row * (cell.height + gap);
        int text_y = y + (cell.height - static_cast<int>(row_lines[r].size()) * line) / 2;
        for (const std::string& text : row_lines[r]) {
            draw_text(picture, 2 * gap, text_y, text, ink, scale);
            text_y += line;
        }
        for (int column = 0; column < columns; ++column) {
            draw_picture(picture, left + column * (cell.width + gap), y,
                         sheet.cells[r][static_cast<size_t>(column)]);
        }
        const auto bar = sheet.bars.find(r);
        if (bar == sheet.bars.end()) continue;
        const int x = left + columns * (cell.width + gap) + gap / 2;
        const int label_height = bar->second.label.empty() ? 0 : line;
        draw_text(picture, x, y, bar->second.label, ink, scale);
        draw_colour_bar(picture, x, y + label_height, cell.height - label_height, bar->second, ink,
                        scale);
    }
    return picture;
}

}  // namespace drude
