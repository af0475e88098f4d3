#include "base/text_table.h"

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/files.h"
#include "temporary_folder.h"

namespace drude {
namespace {

TEST(TextTable, ReadsHeaderColumnsAndRows) {
    const TextTable table = parse_text_table(
        "# sample: copper, polished: twice\n# no key here\n\nwavelength_nm,n,k\n550, 1.04 ,2.59\n"
        "  # date: 2024\n560,1,+2.6\n",
        "cu.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"wavelength_nm", "n", "k"}));
    EXPECT_EQ(table.header_value("sample"), "copper, polished: twice");
    EXPECT_EQ(table.header_value("date"), "2024");
    EXPECT_EQ(table.header_value("absent"), "");
    EXPECT_EQ(table.column("k"), 2);
    EXPECT_EQ(table.column("K"), -1);
    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.rows[0].values, (std::vector<double>{550, 1.04, 2.59}));
    EXPECT_EQ(table.rows[1].values, (std::vector<double>{560, 1, 2.6}));
    EXPECT_EQ(table.place(table.rows[1]).str(), "cu.csv:7");
}

TEST(TextTable, TakesEveryKindOfLineEnd) {
    const TextTable unix_lines = parse_text_table("a,b\n1,2\n3,4\n", "t");
    const TextTable dos_lines = parse_text_table(
        "\xEF\xBB\xBF"
        "a,b\r\n1,2\r\n\r\n3,4",
        "t");
    EXPECT_EQ(unix_lines.columns, dos_lines.columns);
    ASSERT_EQ(dos_lines.rows.size(), 2U);
    EXPECT_EQ(dos_lines.rows[1].values, unix_lines.rows[1].values);
    EXPECT_EQ(dos_lines.rows[1].line, 4);
}

TEST(TextTable, NamesThePlaceOfEveryError) {
    const auto refuses = [](const std::string& text, std::initializer_list<const char*> words) {
        expect_error(Cause::user, words, [&] { parse_text_table(text, "t.csv"); });
    };
    refuses("a,b\n1,2\n3,x4\n", {"t.csv:3:3: ", "'x4'", " b,"});
    refuses("a,b\n1,  nan\n", {"t.csv:2:5: ", "'nan'"});
    refuses("a,b\ninf,1\n", {"t.csv:2:1: ", "'inf'"});
    refuses("a,b\n1,\n", {"t.csv:2:3: ", "''"});
    refuses("# x: y\na,b\n1,2,3\n", {"t.csv:3: ", "found 3", "expected 2", "a,b"});
    refuses("a,b,a\n", {"t.csv:1:5: ", "'a'"});
    refuses("a,,b\n", {"t.csv:1:3: ", "without a name"});
    refuses("", {"t.csv: ", "column names"});
    refuses("# only: comments\n", {"t.csv: ", "column names"});
    refuses("a,b\n1,1e999\n", {"t.csv:2:3: ", "'1e999'"});
}

TEST(TextTable, PrintsNothingOfTheTerminalsConcern) {
    try {
        parse_text_table("a\n\x1b[2J" + std::string(10000, 'x') + "\n", "t.csv");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.message().find('\x1b'), std::string::npos);
        EXPECT_LT(error.message().size(), 300U);
    }
}

TEST(TextTable, ReadsFiles) {
    const TemporaryFolder folder;
    write_file(folder.file("t.csv"), "a\n1\n");
    EXPECT_EQ(read_text_table(folder.file("t.csv")).rows.size(), 1U);
    expect_error(Cause::user, {"absent.csv"}, [&] { read_text_table(folder.file("absent.csv")); });
}

}  // namespace
}  // namespace drude
