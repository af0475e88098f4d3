#include "base/text_table.h"

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "base/numbers.h"

namespace drude {

namespace {

constexpr std::string_view white = " \t\r";
constexpr size_t longest_quote = 120;

std::string_view trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(white);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(white) - begin + 1);
}

struct Field {
    std::string_view text;
    int column;
};

std::vector<Field> split_fields(std::string_view line) {
    std::vector<Field> fields;
    size_t begin = 0;
    for (size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] != ',') continue;
        const std::string_view raw = line.substr(begin, i - begin);
        const size_t lead = std::min(raw.find_first_not_of(white), raw.size());
        fields.push_back({trimmed(raw), static_cast<int>(begin + lead + 1)});
        begin = i + 1;
    }
    return fields;
}

// What was found, short enough to print and without control characters.
std::string quoted(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, longest_quote)) {
        shown += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
    }
    return text.size() > longest_quote ? shown + "..." : shown;
}

}  // namespace

std::string TextTable::header_value(std::string_view key) const {
    for (const auto& [name, value] : header) {
        if (name == key) return value;
    }
    return {};
}

int TextTable::column(std::string_view name) const {
    for (size_t i = 0; i < columns.size(); ++i) {
        if (columns[i] == name) return static_cast<int>(i);
    }
    return -1;
}

TextTable parse_text_table(const std::string& text, const std::string& file) {
    TextTable table;
    table.file = file;
    std::string_view rest = text;
    if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
    for (int line_number = 1; !rest.empty(); ++line_number) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        const std::string_view raw_line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.empty()) continue;
        if (line[0] == '#') {
            const std::string_view comment = trimmed(line.substr(1));
            const size_t colon = comment.find(':');
            if (colon != std::string_view::npos) {
                table.header.emplace_back(trimmed(comment.substr(0, colon)),
                                          trimmed(comment.substr(colon + 1)));
            }
            continue;
        }
        const std::vector<Field> fields = split_fields(raw_line);
        if (table.columns.empty()) {
            for (const Field& field : fields) {
                const Place place{file, line_number, field.column};
                if (field.text.empty()) user_error_at(place, "found a column without a name");
                if (table.column(field.text) >= 0) {
                    user_error_at(place, "found the column '{}' a second time", quoted(field.text));
                }
                table.columns.emplace_back(field.text);
            }
            continue;
        }
        if (fields.size() != table.columns.size()) {
            user_error_at({file, line_number, 0}, "found {} fields, expected {} ({})",
                          fields.size(), table.columns.size(),
                          quoted(fmt::format("{}", fmt::join(table.columns, ","))));
        }
        TableRow row;
        row.line = line_number;
        for (size_t i = 0; i < fields.size(); ++i) {
            const std::optional<double> value = parse_double(fields[i].text);
            if (!value || !std::isfinite(*value)) {
                user_error_at({file, line_number, fields[i].column},
                              "found '{}' for {}, expected a finite number", quoted(fields[i].text),
                              quoted(table.columns[i]));
            }
            row.values.push_back(*value);
        }
        table.rows.push_back(std::move(row));
    }
    if (table.columns.empty()) {
        user_error("{}: found no line of column names; is this a table at all?", file);
    }
    return table;
}

std::string format_header_line(std::string_view key, std::string_view value) {
    std::string line = fmt::format("{}: {}", key, value);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return fmt::format("# {}\n", line);
}

Place row_place(const std::string& file, int line, size_t index) {
    return line > 0 ? Place{file, line, 0}
                    : Place{fmt::format("{}, row {}", file, index + 1), 0, 0};
}

std::string row_name(int line, size_t index) {
    return line > 0 ? fmt::format("line {}", line) : fmt::format("row {}", index + 1);
}

TextTable read_text_table(const std::string& path) {
    return parse_text_table(read_file(path), path);
}

}  // namespace drude
