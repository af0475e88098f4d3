// Comma-separated values with text in them (RFC 4180), as the bench writes and reads them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drude {

// One line with its "\n"; a field with a comma, a quote or a line break is quoted.
std::string csv_line(const std::vector<std::string>& fields);

// The records of `text`, each with the number of the line it begins in (from 1); a line that is
// empty is none. Throws Error (user), naming `file` and the line, where a quote is not closed.
struct CsvRecord {
    int line = 0;
    std::vector<std::string> fields;
};
std::vector<CsvRecord> csv_records(std::string_view text, const std::string& file);

}  // namespace drude
