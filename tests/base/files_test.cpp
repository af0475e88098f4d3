#include "base/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/expect_error.h"
#include "temporary_folder.h"

namespace drude {
namespace {

namespace fs = std::filesystem;

void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string gzipped(const std::string& path, const std::string& bytes) {
    const gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
    return path;
}

// Runs `action` in a process of its own, so that what it does to limits and rights ends with it.
// True where `action` returned true.
template <class Action>
bool true_in_child(const Action& action) {
    const pid_t child = fork();
    if (child == 0) {
        bool good = false;
        try {
            good = action();
        } catch (...) {
        }
        _exit(good ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// True where `action` throws an Error of this cause whose message holds `words`.
template <class Action>
bool fails_with(Cause cause, const std::string& words, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.cause() == cause && error.message().find(words) != std::string::npos;
    }
    return false;
}

TEST(ReadFile, GivesBackEveryByte) {
    const TemporaryFolder folder;
    std::string bytes(300000, '\0');
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 >> 3);
    put(folder.file("plain"), bytes);
    EXPECT_EQ(read_file(folder.file("plain")), bytes);
    EXPECT_EQ(read_file(gzipped(folder.file("packed"), bytes)), bytes);
    put(folder.file("empty"), "");
    EXPECT_EQ(read_file(folder.file("empty")), "");
}

TEST(ReadFile, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const auto read = [](const std::string& path) { return [path] { read_file(path); }; };
    expect_error(Cause::user, {"absent", "No such file"}, read(folder.file("absent")));
    expect_error(Cause::user, {"is a folder"}, read(folder.path().string()));
    put(folder.file("large"), std::string(1001, 'x'));
    expect_error(Cause::user, {"large", "1000 bytes"},
                 [&] { read_file(folder.file("large"), 1000); });
    EXPECT_EQ(read_file(folder.file("large"), 1001).size(), 1001U);
}

TEST(ReadFile, LimitsWhatComesOutNotWhatGoesIn) {
    const TemporaryFolder folder;
    const std::string path = gzipped(folder.file("bomb"), std::string(5000000, 'x'));
    ASSERT_LT(fs::file_size(path), 100000U);
    expect_error(Cause::user, {"bomb"}, [&] { read_file(path, 1000000); });
}

TEST(ReadFile, RefusesDamagedCompression) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 20000; ++i) text += std::to_string(i * 7919 % 10007);
    const std::string path = gzipped(folder.file("packed"), text);
    std::string bytes;
    {
        std::ifstream file(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(file), {});
    }
    put(folder.file("short"), bytes.substr(0, bytes.size() / 2));
    expect_error(Cause::user, {"short", "ends too early"},
                 [&] { read_file(folder.file("short")); });
    std::string damaged = bytes;
    for (size_t i = 100; i < 200; ++i) damaged[i] = static_cast<char>(~damaged[i]);
    put(folder.file("damaged"), damaged);
    expect_error(Cause::user, {"damaged"}, [&] { read_file(folder.file("damaged")); });
}

TEST(AtomicFile, AppearsOnlyWhenComplete) {
    const TemporaryFolder folder;
    const std::string path = folder.file("result.csv");
    put(path, "old");
    {
        AtomicFile file(path);
        file.write("new, ");
        EXPECT_EQ(read_file(path), "old");
        EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".csv");
        file.write("whole");
        file.commit();
    }
    EXPECT_EQ(read_file(path), "new, whole");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"result.csv"});
}

TEST(AtomicFile, LeavesNothingWhenGivenUp) {
    const TemporaryFolder folder;
    put(folder.file("a"), "old");
    { AtomicFile(folder.file("a")).write("half"); }
    { AtomicFile(folder.file("b")).write("half"); }
    EXPECT_EQ(read_file(folder.file("a")), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(AtomicFile, TakesWhatLibrariesWriteByName) {
    const TemporaryFolder folder;
    AtomicFile file(folder.file("picture.exr"));
    put(file.temporary_path(), "pixels");
    file.commit();
    EXPECT_EQ(read_file(folder.file("picture.exr")), "pixels");
}

TEST(AtomicFile, SurvivesWhatACrashLeftBehind) {
    const TemporaryFolder folder;
    const std::string path = folder.file("result.csv");
    // In a container the next run may well have the process number of the one that crashed: its
    // counter starts where this child's starts, in the same process number.
    EXPECT_TRUE(true_in_child([&] {
        const auto* crashed = new AtomicFile(path);
        const std::string left = crashed->temporary_path();
        const size_t dash = left.rfind('-');
        const int number = std::stoi(left.substr(dash + 1));
        for (int next = number + 1; next < number + 5; ++next) {
            put(left.substr(0, dash + 1) + std::to_string(next) + ".tmp.csv", "left behind");
        }
        write_file(path, "whole");
        return read_file(path) == "whole";
    }));
    EXPECT_EQ(read_file(path), "whole");
    EXPECT_EQ(folder.names().size(), 6U);
}

TEST(AtomicFile, KeepsLinksAndPermissions) {
    const TemporaryFolder folder;
    put(folder.file("real"), "old");
    fs::permissions(folder.file("real"), fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("real", folder.file("link"));
    write_file(folder.file("link"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.file("link")));
    EXPECT_EQ(read_file(folder.file("real")), "new");
    EXPECT_EQ(fs::status(folder.file("real")).permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST(AtomicFile, DoesNotReplaceDevices) {
    write_file("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    expect_error(Cause::outside, {"/dev/full", "No space left"},
                 [] { write_file("/dev/full", "something"); });
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, TakesLongNames) {
    const TemporaryFolder folder;
    const std::string longest = std::string(251, 'n') + ".csv";
    write_file(folder.file(longest), "x");
    EXPECT_EQ(folder.names(), std::vector<std::string>{longest});
    expect_error(Cause::user, {"too long"}, [&] { AtomicFile(folder.file(longest + "s")); });
}

TEST(AtomicFile, SaysWhatIsWrongBeforeTheWork) {
    const TemporaryFolder folder;
    put(folder.file("file"), "");
    const auto open = [](const std::string& path) { return [path] { AtomicFile file(path); }; };
    expect_error(Cause::user, {"is a folder"}, open(folder.path().string()));
    expect_error(Cause::user, {"is a folder"}, open(folder.file("new/")));
    expect_error(Cause::user, {"is a folder"}, open(""));
    expect_error(Cause::user, {"there is no folder", "absent"}, open(folder.file("absent/a.csv")));
    expect_error(Cause::user, {"there is no folder"}, open(folder.file("file/a.csv")));
}

TEST(AtomicFile, FullDiskIsAnErrorAndLeavesTheOldFile) {
    const TemporaryFolder folder;
    const std::string path = folder.file("result.csv");
    put(path, "old");
    EXPECT_TRUE(true_in_child([&] {
        // A file-size limit answers like a full disk, once its signal is out of the way.
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
        return fails_with(Cause::outside, "result.csv: cannot write",
                          [&] { write_file(path, std::string(100000, 'x')); });
    }));
    EXPECT_EQ(read_file(path), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"result.csv"});
}

TEST(AtomicFile, MissingPermissionIsAnError) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    put(path, "old");
    fs::permissions(folder.path(),
                    fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
    const bool root = geteuid() == 0;
    if (!root) fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_TRUE(true_in_child([&] {
        // Root may write everywhere; nobody may not.
        if (root && setuid(65534) != 0) return false;
        return fails_with(Cause::outside, "Permission denied",
                          [&] { AtomicFile file(folder.file("new.csv")); });
    }));
    EXPECT_TRUE(true_in_child([&] {
        if (root && setuid(65534) != 0) return false;
        return fails_with(Cause::outside, "Permission denied",
                          [&] { make_folder(folder.file("new")); });
    }));
    fs::permissions(folder.path(), fs::perms::owner_all);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.csv"});
}

TEST(AtomicFile, ReadOnlyTargetStays) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    put(path, "old");
    fs::permissions(path, fs::perms::owner_read | fs::perms::others_read);
    fs::permissions(folder.path(), fs::perms::all);
    const bool root = geteuid() == 0;
    EXPECT_TRUE(true_in_child([&] {
        if (root && setuid(65534) != 0) return false;
        return fails_with(Cause::outside, "Permission denied", [&] { write_file(path, "new"); });
    }));
    EXPECT_EQ(read_file(path), "old");
}

TEST(MakeFolder, MakesParentsAndTakesWhatIsThere) {
    const TemporaryFolder folder;
    make_folder(folder.file("a/b/c"));
    EXPECT_TRUE(fs::is_directory(folder.file("a/b/c")));
    make_folder(folder.file("a/b/c"));
    make_folder(folder.file("a/d/"));
    EXPECT_TRUE(fs::is_directory(folder.file("a/d")));
    put(folder.file("file"), "");
    expect_error(Cause::user, {"is a file"}, [&] { make_folder(folder.file("file")); });
    expect_error(Cause::outside, {"file/below"}, [&] { make_folder(folder.file("file/below")); });
    expect_error(Cause::outside, {"cannot create"}, [] { make_folder(""); });
}

// What processes left behind that were killed goes, and nothing else.
TEST(AbandonedFiles, OfDeadProcessesAreRemovedAndNoOthers) {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);  // no process has its number now
    const std::string dead = std::to_string(child), alive = std::to_string(getpid());
    const std::string removed = ".a.checkpoint." + dead + "-3.tmp.exr";
    const std::vector<std::string> kept = {".a.checkpoint." + alive + "-0.tmp.exr",
                                           ".b." + dead + "-0.tmp.exr",
                                           ".a.checkpoint." + dead + ".tmp.exr",
                                           ".a.checkpoint.0-0.tmp.exr",
                                           ".a.checkpoint.-1-0.tmp.exr",
                                           ".a.checkpoint.x-0.tmp.exr",
                                           "a.checkpoint." + dead + "-0.tmp.exr",
                                           ".a.checkpoint." + dead + "-3.tmp.png"};
    for (const std::string& name : kept) write_file(folder.file(name), "x");
    write_file(folder.file(removed), "x");
    // Numbers come again: what was written before this process began is not its own.
    const std::string older = ".a.checkpoint." + alive + "-1.tmp.exr";
    write_file(folder.file(older), "x");
    std::filesystem::last_write_time(
        folder.file(older),
        std::filesystem::last_write_time(folder.file(older)) - std::chrono::hours(24 * 365));
    remove_abandoned_files(folder.file("a.checkpoint.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder.file(removed)));
    EXPECT_FALSE(std::filesystem::exists(folder.file(older)));
    for (const std::string& name : kept) {
        EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
    }
    remove_abandoned_files(folder.file("no-folder/a.exr"));
}

}  // namespace
}  // namespace drude
