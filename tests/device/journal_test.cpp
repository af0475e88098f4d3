// A journal that is cut or changed anywhere: a valid beginning, or an error that says where.
#include "device/sweep/journal.h"

#include <gtest/gtest.h>

#include "base/crc32.h"
#include "base/expect_error.h"
#include "base/files.h"
#include "sweep_cases.h"

namespace drude {
namespace {

JournalHeader small_header() {
    JournalHeader header;
    header.recipe = short_recipe();
    header.bench_name = "test";
    header.bench_description = "{}";
    header.spectrometer.serial = "S1";
    header.spectrometer.wavelength_nm = {400, 500, 600};
    header.spectrometer.max_counts = 65535;
    header.notes = {{"instrument", "none"}};
    header.software = "drude";
    return header;
}

Frame frame(uint32_t base) {
    return {{base, base + 1, 65535}, 1.5, 1.75};
}

std::string small_journal(const TemporaryFolder& folder) {
    const std::string path = folder.file("small.journal");
    {
        JournalWriter writer = JournalWriter::create(path, small_header());
        writer.write(JournalExposure{0, 0.125, 0.8});
        writer.write(JournalDark{0, 0, 0.125, {frame(10), frame(11)}});
        JournalPoint point;
        point.index = 3;
        point.retries = 1;
        point.polariser_deg = -12.5;
        point.polariser_reported_deg = 347.5;
        point.integration_s = 0.125;
        point.settled_s = 7;
        point.frames = {frame(20)};
        writer.write(point);
        writer.write(JournalEvent{"retry", "spectrometer: stall"});
        writer.write(JournalResume{1, 1.01, 0.001, -2});
        writer.write_times({10, 6, 1, 2});
        writer.write_end();
    }
    return read_file(path);
}

TEST(Journal, CrcIsThatOfZip) {
    // Of the nine digits by the standard's check value; of "a" by `gzip -v`'s trailer.
    EXPECT_EQ(crc32("123456789"), 0xCBF43926u);
    EXPECT_EQ(crc32("6789", crc32("12345")), 0xCBF43926u);
    EXPECT_EQ(crc32("a"), 0xE8B7BE43u);
}

TEST(Journal, ReadsWhatWasWritten) {
    const TemporaryFolder folder;
    const Journal journal = parse_journal(small_journal(folder), "j");
    ASSERT_TRUE(journal.header);
    EXPECT_TRUE(journal.complete);
    EXPECT_EQ(journal.torn_bytes, 0u);
    EXPECT_EQ(journal.header->bench_name, "test");
    EXPECT_EQ(journal.header->spectrometer.wavelength_nm,
              small_header().spectrometer.wavelength_nm);
    EXPECT_EQ(format_recipe(journal.header->recipe), format_recipe(short_recipe()));
    EXPECT_EQ(journal.plan.size(), 5u);
    ASSERT_EQ(journal.points.size(), 1u);
    EXPECT_EQ(journal.points[0].index, 3u);
    EXPECT_EQ(journal.points[0].polariser_deg, -12.5);
    EXPECT_EQ(journal.points[0].frames[0].counts, frame(20).counts);
    EXPECT_EQ(journal.points[0].frames[0].arrived_s, 1.75);
    ASSERT_NE(journal.dark(0), nullptr);
    EXPECT_EQ(journal.dark(0)->frames.size(), 2u);
    EXPECT_EQ(journal.dark(1), nullptr);
    EXPECT_EQ(journal.retries(), 1u);
    EXPECT_EQ(journal.resumes[0].scale, 1.01);
    EXPECT_EQ(journal.times.elsewhere(), 1);
}

TEST(Journal, EveryTruncationIsAValidBeginning) {
    const TemporaryFolder folder;
    const std::string bytes = small_journal(folder);
    uint32_t records = 0;
    for (size_t length = 0; length < bytes.size(); ++length) {
        const Journal journal = parse_journal(std::string_view(bytes).substr(0, length), "j");
        EXPECT_EQ(journal.valid_bytes + journal.torn_bytes, length);
        EXPECT_FALSE(journal.complete);
        EXPECT_GE(journal.next_sequence, records);
        EXPECT_LE(journal.next_sequence, records + 1);
        records = journal.next_sequence;
        // What is dropped is what a whole record does not hold.
        const Journal again =
            parse_journal(std::string_view(bytes).substr(0, journal.valid_bytes), "j");
        EXPECT_EQ(again.torn_bytes, 0u);
        EXPECT_EQ(again.next_sequence, records);
    }
    EXPECT_EQ(records, 7u);
}

TEST(Journal, EveryFlippedByteIsFound) {
    const TemporaryFolder folder;
    const std::string bytes = small_journal(folder);
    for (size_t i = 0; i < bytes.size(); ++i) {
        for (const int flip : {1, 0x80, 0xFF}) {
            std::string changed = bytes;
            changed[i] = static_cast<char>(changed[i] ^ flip);
            expect_error(Cause::user, {"j"}, [&] { parse_journal(changed, "j"); });
        }
    }
}

TEST(Journal, SaysAtWhichByteItIsDamaged) {
    const TemporaryFolder folder;
    std::string bytes = small_journal(folder);
    const Journal whole = parse_journal(bytes, "j");
    const Journal cut = parse_journal(std::string_view(bytes).substr(0, bytes.size() - 1), "j");
    ASSERT_LT(cut.valid_bytes, whole.valid_bytes);
    bytes[cut.valid_bytes + 5] ^= 1;
    const std::string at = "byte " + std::to_string(cut.valid_bytes);
    expect_error(Cause::user, {"j", at.c_str(), "checksum", "copy"},
                 [&] { parse_journal(bytes, "j"); });
}

TEST(Journal, ZerosOfAPowerCutAreDropped) {
    const TemporaryFolder folder;
    const std::string bytes = small_journal(folder);
    for (const size_t zeros : {1, 15, 16, 17, 4096}) {
        const Journal journal =
            parse_journal(bytes.substr(0, bytes.size() - 20) + std::string(zeros, '\0'), "j");
        EXPECT_EQ(journal.valid_bytes, bytes.size() - 20);
        EXPECT_EQ(journal.torn_bytes, zeros);
    }
}

TEST(Journal, RecordsLeftOutOrDoubledAreFound) {
    const TemporaryFolder folder;
    const std::string bytes = small_journal(folder);
    const std::string last = bytes.substr(bytes.size() - 20);
    expect_error(Cause::user, {"record number 7, expected 8"},
                 [&] { parse_journal(bytes + last, "j"); });
}

TEST(Journal, IsNeitherOverwrittenNorSharedNorTakenForSomethingElse) {
    const TemporaryFolder folder;
    small_journal(folder);
    const std::string path = folder.file("small.journal");
    expect_error(Cause::user, {"small.journal", "never overwritten", "--resume"},
                 [&] { JournalWriter::create(path, small_header()); });
    expect_error(Cause::user, {"no such folder"},
                 [&] { JournalWriter::create(folder.file("none/a.journal"), small_header()); });
    const Journal journal = read_journal(path);
    const JournalWriter first = JournalWriter::append(path, journal);
    expect_error(Cause::user, {"another process"}, [&] { JournalWriter::append(path, journal); });
    expect_error(Cause::user, {"no journal"},
                 [&] { parse_journal("wavelength_nm,angle_deg\n", "m.csv"); });
}

TEST(Journal, WideCountsKeepTheirBits) {
    const TemporaryFolder folder;
    JournalHeader header = small_header();
    header.spectrometer.max_counts = 262143;
    const std::string path = folder.file("wide.journal");
    {
        JournalWriter writer = JournalWriter::create(path, header);
        JournalDark dark{0, 0, 0.125, {frame(200000)}};
        writer.write(dark);
    }
    EXPECT_EQ(read_journal(path).darks[0].frames[0].counts, frame(200000).counts);
}

}  // namespace
}  // namespace drude
