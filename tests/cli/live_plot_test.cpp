// What a person at a terminal sees of a sweep, and that nobody else sees it.
#include "cli/live_plot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.h"
#include "terminal.h"

namespace drude {
namespace {

TEST(TextPlot, PointsStandWhereTheyBelong) {
    EXPECT_EQ(text_plot({0, 10, 20}, {0, 5, 10}, "a title", 5, 3),
              "a title\n"
              "      10 |    *\n"
              "         |  *  \n"
              "       0 |*    \n");
    // One point, or none above zero, divides by nothing.
    EXPECT_EQ(text_plot({3}, {-1}, "t", 2, 2), "t\n       0 |  \n       0 |* \n");
}

TEST(TextPlot, FitsTheTerminal) {
    EXPECT_EQ(fitted("title\nplot\none\ntwo\n", 3, 3, 2), "tit\nplo\ntwo\n");
    EXPECT_EQ(fitted("title\nplot\none\ntwo\n", 80, 10, 2), "title\nplot\none\ntwo\n");
    EXPECT_EQ(fitted("title\nplot\n", 80, 1, 2), "title\nplot\n");
}

const std::string sweep =
    "capture --instrument virtual:Cu-McPeak --angles 60,70 --steps 9 --averages 1 "
    "--wavelengths 500:700:50 -o m.csv";

TerminalRun on_terminal(const TemporaryFolder& folder, const std::string& environment,
                        unsigned short columns) {
    return run_on_terminal("cd '" + folder.path().string() + "' && " + environment + " exec '" +
                               DRUDE_BINARY_DIR "/drude' " + sweep + " > .out",
                           "", {}, columns);
}

// Rows that the pictures go back over, and lines that they print: equal, or they would walk down.
TEST(LivePlot, IsDrawnInPlaceOnATerminal) {
    const TemporaryFolder folder;
    const TerminalRun run = on_terminal(folder, "TERM=xterm", 80);
    ASSERT_EQ(run.status, 0) << run.screen;
    EXPECT_NE(run.screen.find("60 degrees, analyser 45 degrees: mean counts"), std::string::npos)
        << run.screen;
    EXPECT_NE(run.screen.find("60 degrees: Psi "), std::string::npos) << run.screen;
    EXPECT_NE(run.screen.find("\033[9A"), std::string::npos);
    // No line is wider than the terminal, before the warnings that come at the end.
    size_t column = 0, widest = 0;
    const size_t end = std::min(run.screen.find("drude: "), run.screen.size());
    ASSERT_GT(end, run.screen.find("\033[9A"));
    for (size_t i = 0; i < end; ++i) {
        if (run.screen[i] == '\033') {
            while (i < run.screen.size() &&
                   std::isalpha(static_cast<unsigned char>(run.screen[i])) == 0) {
                ++i;
            }
        } else if (run.screen[i] == '\n' || run.screen[i] == '\r') {
            column = 0;
        } else {
            widest = std::max(widest, ++column);
        }
    }
    EXPECT_LE(widest, 80u);
    EXPECT_GT(widest, 60u);
}

TEST(LivePlot, IsNotForOtherReaders) {
    const TemporaryFolder folder;
    const TerminalRun dumb = on_terminal(folder, "TERM=dumb", 80);
    EXPECT_EQ(dumb.status, 0) << dumb.screen;
    EXPECT_EQ(dumb.screen.find('\033'), std::string::npos) << dumb.screen;
    EXPECT_EQ(dumb.screen.find('*'), std::string::npos) << dumb.screen;
    const ProgramRun piped = run_drude(folder, sweep + " --journal other.journal", "TERM=xterm ");
    EXPECT_EQ(piped.status, 0) << piped.err;
    EXPECT_EQ(piped.err.find('\033'), std::string::npos) << piped.err;
}

}  // namespace
}  // namespace drude
