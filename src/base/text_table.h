// Text tables: "# key: value" lines, a line of column names, rows of numbers, separated by commas.
// The shape of every text file that the project itself defines.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace drude {

// One row of a text table, as many finite values as there are columns, with the line it stood on.
struct TableRow {
    std::vector<double> values;
    int line = 0;
};

struct TextTable {
    std::string file;
    std::vector<std::pair<std::string, std::string>> header;  // in the file's order
    std::vector<std::string> columns;
    std::vector<TableRow> rows;

    // The value of a header key, or an empty string.
    std::string header_value(std::string_view key) const;
    // The index of a column, or -1.
    int column(std::string_view name) const;
    Place place(const TableRow& row) const { return {file, row.line, 0}; }
};

// Parses `text`; `file` names it in errors. Accepts LF and CRLF, a UTF-8 byte order mark, blank
// lines. Throws Error (user) with file:line:column for a row of the wrong length, a field that is
// empty, no number, NaN or an infinity, and for a column without a name or with one used before;
// also where there is no line of column names at all.
TextTable parse_text_table(const std::string& text, const std::string& file);

// "# KEY: VALUE\n". Line breaks become blanks: inside a value one would turn the rest of it into a
// row of data.
std::string format_header_line(std::string_view key, std::string_view value);

// Where a row of a record stands: its line, or, where it was made in memory (line 0), its number.
// `index` from 0.
Place row_place(const std::string& file, int line, size_t index);
// "line 7" or "row 3", likewise.
std::string row_name(int line, size_t index);

// read_file and parse_text_table.
TextTable read_text_table(const std::string& path);

}  // namespace drude
