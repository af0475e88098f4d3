#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "base/error.h"
#include "base/interrupt.h"
#include "cli/completion.h"
#include "cli/help.h"
#include "cli/manual.h"
#include "cli/parser.h"
#include "temporary_folder.h"

namespace drude {
namespace {

// What the commands below were called with.
struct Seen {
    std::string model = "auto", output;
    double angle = 60;
    int count = 3;
    uint64_t seed = 0;
    bool log = false;
    std::vector<std::string> films, parts;
    std::string in;
    CommonOptions common;
    bool given_angle = false, given_in = false;
};

Seen seen;

Command measure_command() {
    Command command;
    command.name = "measure";
    command.summary = "Measure nothing at all.";
    command.description = "A paragraph that is filled.\n\n  kept   as it stands\n\nThe last one.";
    command.example = "drude measure a.csv\n.5 'quoted' \\ back";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        seen = Seen{};
        options.positional("IN", seen.in, "What is read.", true);
        options.positionals("PART", seen.parts, "More of it.", 0);
        options.option("-o,--output", seen.output, "Where it goes.");
        options.option("--angle", seen.angle, "Degrees.");
        options.option("--count", seen.count, "How many.");
        options.option("--seed", seen.seed, "The seed.");
        options.option("--film", seen.films, "A film.");
        options.flag("-l,--log", seen.log, "Logarithms.");
        options.choice("--model", seen.model, {"auto", "bulk", "film"}, "The model.");
        return [&options, &common] {
            seen.common = common;
            seen.given_angle = options.given("--angle");
            seen.given_in = options.given("IN");
            return 0;
        };
    };
    return command;
}

// A command whose run is `action`.
Command command_that(const std::string& name, std::function<int()> action) {
    Command command;
    command.name = name;
    command.summary = "For this test.";
    command.declare = [action = std::move(action)](OptionSet&, const CommonOptions&) {
        return action;
    };
    return command;
}

struct Outcome {
    int status;
    std::string out, err;
};

Outcome run(std::vector<std::string> words, const std::vector<Command>& extra = {}) {
    std::vector<Command> commands = {measure_command()};
    commands.insert(commands.end(), extra.begin(), extra.end());
    words.insert(words.begin(), "/somewhere/bin/drude");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = run_command_line(commands, static_cast<int>(argv.size()), argv.data());
    Outcome outcome{status, testing::internal::GetCapturedStdout(),
                    testing::internal::GetCapturedStderr()};
    return outcome;
}

// The words must be refused with status 2 and one line on stderr that holds all of `expected`.
void refuses(const std::vector<std::string>& words, std::initializer_list<const char*> expected) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.substr(0, 7), "drude: ");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const char* part : expected) {
        EXPECT_NE(outcome.err.find(part), std::string::npos)
            << "'" << part << "' is not in: " << outcome.err;
    }
}

TEST(CommandLine, ReadsEveryKindOfOption) {
    const Outcome outcome = run({"measure",
                                 "a.csv",
                                 "--angle",
                                 "-7.5e1",
                                 "--count=12",
                                 "--seed",
                                 "18446744073709551615",
                                 "--film",
                                 "1,2,3",
                                 "--film=4,5,6",
                                 "-l",
                                 "--model",
                                 "bulk",
                                 "-o",
                                 "out.json",
                                 "--json",
                                 "-q",
                                 "--threads",
                                 "2",
                                 "b",
                                 "c"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(seen.in, "a.csv");
    EXPECT_EQ(seen.parts, (std::vector<std::string>{"b", "c"}));
    EXPECT_EQ(seen.angle, -75);
    EXPECT_EQ(seen.count, 12);
    EXPECT_EQ(seen.seed, 18446744073709551615ULL);
    EXPECT_EQ(seen.films, (std::vector<std::string>{"1,2,3", "4,5,6"}));
    EXPECT_TRUE(seen.log);
    EXPECT_EQ(seen.model, "bulk");
    EXPECT_EQ(seen.output, "out.json");
    EXPECT_TRUE(seen.common.json);
    EXPECT_TRUE(seen.common.quiet);
    EXPECT_EQ(seen.common.threads, 2);
    EXPECT_TRUE(seen.given_angle);
    // The path of the program says where it was installed, which is nobody's business.
    EXPECT_EQ(seen.common.command_line[0], "drude");
    EXPECT_EQ(seen.common.command_line[1], "measure");
    EXPECT_EQ(seen.common.command_line.back(), "c");
}

TEST(CommandLine, KeepsWhatIsNotGiven) {
    ASSERT_EQ(run({"measure", "a.csv"}).status, 0);
    EXPECT_EQ(seen.angle, 60);
    EXPECT_EQ(seen.model, "auto");
    EXPECT_FALSE(seen.given_angle);
    EXPECT_TRUE(seen.given_in);
    EXPECT_FALSE(seen.common.json);
    EXPECT_EQ(seen.common.threads, 0);
}

TEST(CommandLine, OptionsOfOneValueTakeOne) {
    ASSERT_EQ(run({"measure", "a", "--film", "1", "b", "--film", "2", "c"}).status, 0);
    EXPECT_EQ(seen.films, (std::vector<std::string>{"1", "2"}));
    EXPECT_EQ(seen.parts, (std::vector<std::string>{"b", "c"}));
}

TEST(CommandLine, TakesWordsAsTheyAre) {
    // Commands' names, brackets, a lone dash, blanks and, after --, dashes are words like others.
    ASSERT_EQ(run({"measure", "help", "[a,b]", "-", "++", "two words", "--", "--log", "--"}).status,
              0);
    EXPECT_EQ(seen.in, "help");
    EXPECT_EQ(seen.parts,
              (std::vector<std::string>{"[a,b]", "-", "++", "two words", "--log", "--"}));
    EXPECT_FALSE(seen.log);
    ASSERT_EQ(run({"measure", "a", "--film", "[1,2]", "--output", "{}"}).status, 0);
    EXPECT_EQ(seen.films, (std::vector<std::string>{"[1,2]"}));
    EXPECT_EQ(seen.output, "{}");
}

TEST(CommandLine, RefusesWrongWords) {
    refuses({"mesure", "a"}, {"'mesure'", "did you mean 'measure'?", "drude help"});
    refuses({"photograph"}, {"'photograph'", "drude help"});
    refuses({""}, {"''"});
    refuses({"--quiet", "measure"}, {"'--quiet'", "COMMAND --quiet"});
    refuses({"measure"}, {"found no IN", "drude help measure"});
    refuses({"measure", "a", "--angel", "5"}, {"'--angel'", "did you mean '--angle'?"});
    refuses({"measure", "a", "--angel=5"}, {"'--angel'", "did you mean '--angle'?"});
    refuses({"measure", "a", "-z"}, {"'-z'", "no option of 'drude measure'"});
    refuses({"measure", "a", "-5"}, {"'-5'"});
    refuses({"measure", "a", "---log"}, {"'---log'", "'--log'"});
    refuses({"version", "1"}, {"'1'", "drude version"});
}

TEST(CommandLine, RefusesWrongValues) {
    refuses({"measure", "a", "--angle", "6o"}, {"--angle", "'6o'", "number"});
    refuses({"measure", "a", "--angle", "nan"}, {"--angle", "'nan'", "finite"});
    refuses({"measure", "a", "--angle", "1e999"}, {"--angle", "'1e999'"});
    refuses({"measure", "a", "--count", "1.5"}, {"--count", "'1.5'", "whole number"});
    refuses({"measure", "a", "--count", "2147483648"}, {"--count", "'2147483648'", "2147483647"});
    refuses({"measure", "a", "--seed", "-1"}, {"--seed", "'-1'", "from 0"});
    refuses({"measure", "a", "--seed", "18446744073709551616"}, {"--seed", "18446744073709551615"});
    refuses({"measure", "a", "--model", "bluk"},
            {"--model", "'bluk'", "auto, bulk, film", "'bulk'"});
    refuses({"measure", "a", "--threads", "-2"}, {"--threads", "-2", "0"});
    refuses({"measure", "a", "--log=maybe"}, {"--log", "'maybe'", "takes none"});
    refuses({"measure", "a", "--log=false"}, {"--log", "'false'"});
}

TEST(CommandLine, RefusesMissingAndRepeatedValues) {
    refuses({"measure", "a", "--angle"}, {"--angle", "expected a value"});
    refuses({"measure", "a", "-o"}, {"-o", "expected a value"});
    refuses({"measure", "a", "-o", "--json"}, {"--output", "'--json'", "expected a value"});
    refuses({"measure", "a", "-o", "-l"}, {"--output", "'-l'", "expected a value"});
    refuses({"measure", "a", "-o", ""}, {"--output", "nothing"});
    refuses({"measure", "a", "--seed", "1", "--seed", "2"}, {"--seed", "2 times", "once"});
}

TEST(CommandLine, ChecksWordsBeforeRunning) {
    bool ran = false;
    Command command = command_that("two", [&] {
        ran = true;
        return 0;
    });
    std::string first, second;
    std::vector<std::string> rest;
    command.declare = [&](OptionSet& options, const CommonOptions&) {
        rest.clear();
        options.positionals("PART", rest, "Parts.", 2);
        options.positional("LAST", second, "The last.", true);
        return [&] {
            ran = true;
            return 0;
        };
    };
    EXPECT_EQ(run({"two", "a", "b"}, {command}).status, 2);
    EXPECT_FALSE(ran);
    EXPECT_EQ(run({"two", "a", "b", "c", "d"}, {command}).status, 0);
    EXPECT_TRUE(ran);
    EXPECT_EQ(rest, (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(second, "d");
}

TEST(CommandLine, ExitStatusTellsTheCause) {
    const auto status = [](std::function<int()> action) {
        return run({"act"}, {command_that("act", std::move(action))});
    };
    EXPECT_EQ(status([] { return 0; }).status, 0);
    EXPECT_EQ(status([] { return 1; }).status, 1);
    const Outcome user = status([]() -> int { user_error_at({"a.csv", 3, 4}, "found {}", 'x'); });
    EXPECT_EQ(user.status, 2);
    EXPECT_EQ(user.err, "drude: a.csv:3:4: found x\n");
    EXPECT_EQ(status([]() -> int { outside_error("disk"); }).status, 3);
    EXPECT_EQ(status([]() -> int { throw Error(Cause::answer_is_no, "no"); }).status, 1);
    const Outcome memory = status([]() -> int { throw std::bad_alloc(); });
    EXPECT_EQ(memory.status, 3);
    EXPECT_NE(memory.err.find("out of memory"), std::string::npos) << memory.err;
    const Outcome system = status([]() -> int {
        throw std::system_error(std::make_error_code(std::errc::no_space_on_device), "secret");
    });
    EXPECT_EQ(system.status, 3);
    EXPECT_NE(system.err.find("No space left"), std::string::npos) << system.err;
}

TEST(CommandLine, OwnFaultsAreAdmittedWithoutExceptionText) {
    const auto outcome = [] {
        return run({"act"}, {command_that("act", []() -> int {
                       throw std::out_of_range("vector::_M_range_check");
                   })});
    };
    unsetenv("DRUDE_DEBUG");
    const Outcome plain = outcome();
    EXPECT_EQ(plain.status, 3);
    EXPECT_NE(plain.err.find("internal error in 'drude act'"), std::string::npos) << plain.err;
    EXPECT_EQ(plain.err.find("range_check"), std::string::npos) << plain.err;
    setenv("DRUDE_DEBUG", "1", 1);
    EXPECT_NE(outcome().err.find("range_check"), std::string::npos);
    unsetenv("DRUDE_DEBUG");
}

TEST(CommandLine, MistakesInDeclarationsAreFoundAtOnce) {
    const auto status = [](const std::string& spec) {
        Command command = command_that("act", [] { return 0; });
        command.declare = [spec](OptionSet& options, const CommonOptions&) {
            static bool flag;
            options.flag(spec, flag, "A flag.");
            return [] { return 0; };
        };
        return run({"act"}, {command}).status;
    };
    EXPECT_EQ(status("--fine"), 0);
    EXPECT_EQ(status("--json"), 3);  // every command has it already
    EXPECT_EQ(status("-q,--quick"), 3);
    EXPECT_EQ(status("fine"), 3);
    EXPECT_EQ(status("-f"), 3);
}

// Runs the command line in a process of its own with standard output going to `output`.
int status_of_child(const std::vector<Command>& commands, int output) {
    std::fflush(stdout);  // what the child would print a second time
    const pid_t child = fork();
    if (child == 0) {
        dup2(output, STDOUT_FILENO);
        prepare_process();
        std::string name = "drude", word = "act";
        char* argv[] = {name.data(), word.data()};
        _exit(run_command_line(commands, 2, argv));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::vector<Command> printing_command(size_t bytes, bool with_iostream) {
    return {command_that("act", [bytes, with_iostream] {
        const std::string text(bytes, 'x');
        if (with_iostream) {
            std::cout << text;
        } else {
            fmt::print("{}", text);
        }
        return 0;
    })};
}

TEST(CommandLine, OutputThatDoesNotArriveIsAnError) {
    for (const size_t bytes : {size_t{10}, size_t{1000000}}) {
        for (const bool with_iostream : {false, true}) {
            const std::vector<Command> commands = printing_command(bytes, with_iostream);
            testing::internal::CaptureStderr();
            const int full = open("/dev/full", O_WRONLY);
            EXPECT_EQ(status_of_child(commands, full), 3);
            close(full);
            EXPECT_NE(testing::internal::GetCapturedStderr().find("standard output: cannot write"),
                      std::string::npos)
                << bytes << " bytes, iostream " << with_iostream;
            int ends[2];
            ASSERT_EQ(pipe(ends), 0);
            close(ends[0]);
            testing::internal::CaptureStderr();
            EXPECT_EQ(status_of_child(commands, ends[1]), 141);
            EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
            close(ends[1]);
        }
    }
}

TEST(CommandLine, AClosedStandardOutputIsNotTakenByAFile) {
    const TemporaryFolder folder;
    const std::string path = folder.file("made.txt");
    const std::vector<Command> commands = {command_that("act", [&] {
        std::FILE* file = std::fopen(path.c_str(), "w");
        std::fputs("the file\n", file);
        std::fclose(file);
        fmt::print("the result\n");
        return 0;
    })};
    testing::internal::CaptureStderr();
    std::fflush(stdout);  // what the child would print a second time
    const pid_t child = fork();
    if (child == 0) {
        close(STDOUT_FILENO);
        prepare_process();
        std::string name = "drude", word = "act";
        char* argv[] = {name.data(), word.data()};
        _exit(run_command_line(commands, 2, argv));
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("standard output: cannot write"),
              std::string::npos);
    EXPECT_EQ(WEXITSTATUS(status), 3);
    std::ifstream file(path);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "the file\n");
}

TEST(CommandLine, InterruptsBecomeTheExitStatus) {
    const auto interrupted_by = [](int signal) {
        const int null = open("/dev/null", O_WRONLY);
        const int status = status_of_child({command_that("act",
                                                         [signal] {
                                                             std::raise(signal);
                                                             return interrupted() == signal ? 0 : 1;
                                                         })},
                                           null);
        close(null);
        return status;
    };
    EXPECT_EQ(interrupted_by(SIGINT), 130);
    EXPECT_EQ(interrupted_by(SIGTERM), 143);
}

TEST(Help, ListsCommandsAndOptions) {
    const Outcome overview = run({"help"});
    EXPECT_EQ(overview.status, 0);
    for (const char* word : {"measure", "Measure nothing", "completion", "help", "130"}) {
        EXPECT_NE(overview.out.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(run({"--help"}).out, overview.out);
    EXPECT_EQ(run({"-h"}).out, overview.out);
    const Outcome page = run({"help", "measure"});
    for (const char* word : {"IN [PART...]", "-o, --output", "(default: 60)", "auto|bulk|film",
                             "  kept   as it stands", "drude measure a.csv", "--threads"}) {
        EXPECT_NE(page.out.find(word), std::string::npos) << word << " is not in\n" << page.out;
    }
    EXPECT_EQ(run({"measure", "--help"}).out, page.out);
    EXPECT_EQ(run({"measure", "a", "--no-such", "-h"}).out, page.out);
    EXPECT_EQ(run({"help", "mesure"}).status, 2);
}

TEST(Help, NoCommandIsAnErrorThatHelps) {
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("measure"), std::string::npos);
}

TEST(Help, LinesFitATerminal) {
    for (const std::string& page : {run({"help"}).out, run({"help", "help"}).out}) {
        for (size_t begin = 0; begin < page.size();) {
            const size_t end = page.find('\n', begin);
            EXPECT_LE(end - begin, 80U) << page.substr(begin, end - begin);
            begin = end + 1;
        }
    }
}

TEST(Help, JsonHoldsEveryOption) {
    const auto one = nlohmann::json::parse(run({"help", "measure", "--json"}).out);
    EXPECT_EQ(one["name"], "measure");
    const auto all = nlohmann::json::parse(run({"help", "--json"}).out);
    ASSERT_EQ(all["commands"].size(), 4U);
    EXPECT_EQ(all["commands"][0], one);
    const auto version = nlohmann::json::parse(run({"--version", "--json"}).out);
    EXPECT_EQ(version["version"], DRUDE_VERSION);
}

TEST(Help, ManualPageIsRoffThatMeansWhatItSays) {
    const Outcome manual = run({"help", "--man"});
    EXPECT_EQ(manual.status, 0);
    EXPECT_EQ(manual.out.substr(0, 11), ".TH DRUDE 1");
    // A line that starts with a dot, a quote or holds a backslash must not become a request.
    EXPECT_NE(manual.out.find("\n\\&.5 \\(aqquoted\\(aq \\e back\n"), std::string::npos);
    EXPECT_NE(manual.out.find("\\-\\-output VALUE"), std::string::npos);
    for (size_t begin = 0; begin < manual.out.size();) {
        const size_t end = manual.out.find('\n', begin);
        const std::string line = manual.out.substr(begin, end - begin);
        if (line[0] == '.') {
            EXPECT_TRUE((line.size() >= 3 && std::isupper(line[1])) || line == ".nf" ||
                        line == ".fi")
                << line;
        }
        begin = end + 1;
    }
}

// What bash offers after typing these words, the last of them unfinished.
std::string completed(const TemporaryFolder& folder, const std::vector<std::string>& words) {
    const std::string command = fmt::format(
        "bash --norc -c 'source {}/completion; COMP_WORDS=({}); COMP_CWORD={}; _drude; "
        "echo ${{COMPREPLY[*]}}'",
        folder.path().string(), fmt::format("{}", fmt::join(words, " ")), words.size() - 1);
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string result;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) result += static_cast<char>(c);
    pclose(pipe);
    return result.substr(0, result.find('\n'));
}

TEST(Completion, BashOffersWhatIsDeclared) {
    const TemporaryFolder folder;
    const Outcome script = run({"completion", "bash"});
    ASSERT_EQ(script.status, 0);
    std::ofstream(folder.file("completion")) << script.out;
    EXPECT_EQ(completed(folder, {"drude", "me"}), "measure");
    EXPECT_EQ(completed(folder, {"drude", "measure", "--an"}), "--angle");
    EXPECT_EQ(completed(folder, {"drude", "measure", "a.csv", "--th"}), "--threads");
    EXPECT_EQ(completed(folder, {"drude", "measure", "--model", "b"}), "bulk");
    EXPECT_EQ(completed(folder, {"drude", "measure", "--model", "=", "f"}), "film");
    EXPECT_EQ(completed(folder, {"drude", "help", "m"}), "measure");
    EXPECT_EQ(completed(folder, {"drude", "completion", "b"}), "bash");
    EXPECT_EQ(completed(folder, {"drude", "measure", "x"}), "");
    EXPECT_EQ(run({"completion", "fish"}).status, 2);
}

}  // namespace
}  // namespace drude
