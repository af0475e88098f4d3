#include "base/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>

#include "base/executor.h"

namespace drude {
namespace {

TEST(FormatDuration, ReadsLikeAClock) {
    EXPECT_EQ(format_duration(0), "0 s");
    EXPECT_EQ(format_duration(4.4), "4 s");
    EXPECT_EQ(format_duration(59.6), "1:00");
    EXPECT_EQ(format_duration(123), "2:03");
    EXPECT_EQ(format_duration(3723), "1:02:03");
}

// The tests' standard error is a file here, never a terminal.
std::string printed(const std::function<void()>& action) {
    testing::internal::CaptureStderr();
    action();
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, ShortJobsOffATerminalSayNothing) {
    EXPECT_EQ(printed([] {
                  Progress progress("rendering", 10, false);
                  parallel_for(10, 2, [&](size_t) { progress.step(); });
              }),
              "");
}

TEST(Progress, LongJobsOffATerminalPrintWholeLines) {
    const std::string text = printed([] {
        Progress progress("rendering", 100, false, std::chrono::milliseconds(1));
        for (int i = 0; i < 20; ++i) {
            usleep(2000);
            progress.step();
        }
    });
    EXPECT_NE(text.find("rendering: "), std::string::npos) << text;
    EXPECT_NE(text.find(" left\n"), std::string::npos) << text;
    EXPECT_EQ(text.find('\r'), std::string::npos) << "a bar was drawn into a file";
    EXPECT_EQ(text.find('\033'), std::string::npos) << "control characters in a file";
    // A job that ended early says what it took, not what is left.
    EXPECT_EQ(text.substr(text.rfind("rendering")).substr(0, 17), "rendering: 20 %, ");
    EXPECT_NE(text.rfind(" taken\n"), std::string::npos) << text;
}

TEST(Progress, QuietIsQuiet) {
    EXPECT_EQ(printed([] {
                  Progress progress("rendering", 3, true, std::chrono::milliseconds(0));
                  progress.step(3);
              }),
              "");
}

TEST(Progress, TooManyStepsAndNoneAreNoError) {
    const std::string text = printed([] {
        Progress more("more", 2, false, std::chrono::milliseconds(0));
        more.step(5);
        Progress none("none", 0, false, std::chrono::milliseconds(0));
        none.step(0);
    });
    EXPECT_NE(text.find("more: 100 %"), std::string::npos) << text;
    EXPECT_NE(text.find("none: 100 %"), std::string::npos) << text;
}

TEST(Progress, GoesOnWhereNobodyCanRead) {
    const int saved = dup(STDERR_FILENO);
    const int full = open("/dev/full", O_WRONLY);
    dup2(full, STDERR_FILENO);
    EXPECT_NO_THROW({
        Progress progress("rendering", 2, false, std::chrono::milliseconds(0));
        progress.step();
        progress.step();
    });
    dup2(saved, STDERR_FILENO);
    close(saved);
    close(full);
}

}  // namespace
}  // namespace drude
