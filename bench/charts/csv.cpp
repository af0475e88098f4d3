#include "bench/charts/csv.h"

#include "base/error.h"

namespace drude {

std::string csv_line(const std::vector<std::string>& fields) {
    std::string line;
    for (size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) line += ',';
        if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
            line += fields[i];
            continue;
        }
        line += '"';
        for (const char c : fields[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + "\n";
}

std::vector<CsvRecord> csv_records(std::string_view text, const std::string& file) {
    std::vector<CsvRecord> records;
    size_t i = 0;
    int line = 1;
    while (i < text.size()) {
        CsvRecord record{line, {std::string()}};
        bool quoted = false;
        for (; i < text.size(); ++i) {
            const char c = text[i];
            line += c == '\n';
            if (quoted) {
                if (c != '"') {
                    record.fields.back() += c;
                } else if (i + 1 < text.size() && text[i + 1] == '"') {
                    record.fields.back() += c;
                    ++i;
                } else {
                    quoted = false;
                }
            } else if (c == '"') {
                quoted = true;
            } else if (c == ',') {
                record.fields.emplace_back();
            } else if (c == '\n') {
                ++i;
                break;
            } else if (c != '\r') {
                record.fields.back() += c;
            }
        }
        if (quoted) {
            user_error_at({file, record.line, 0}, "a quoted field begins here and never ends");
        }
        if (record.fields.size() > 1 || !record.fields[0].empty()) records.push_back(record);
    }
    return records;
}

}  // namespace drude
