// The program as users run it: how much memory it takes, and that every command explains itself.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/declared_options.h"
#include "cli/help.h"
#include "temporary_folder.h"

namespace drude {
namespace {

struct Answer {
    int status = -1;
    long most_kilobytes = 0;
    std::string out;
};

Answer run_program(std::vector<std::string> words) {
    const TemporaryFolder folder;
    words.insert(words.begin(), DRUDE_BINARY_DIR "/drude");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, folder.file("out").c_str(),
                                     O_WRONLY | O_CREAT, 0600);
    Answer answer;
    pid_t child = 0;
    if (posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ) == 0) {
        int status = 0;
        rusage usage{};
        wait4(child, &status, 0, &usage);
        answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        answer.most_kilobytes = usage.ru_maxrss;
    }
    posix_spawn_file_actions_destroy(&actions);
    std::ifstream file(folder.file("out"));
    answer.out.assign(std::istreambuf_iterator<char>(file), {});
    return answer;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool instrumented = true;
#else
constexpr bool instrumented = false;
#endif

// What OpenImageIO would cost at every start is what its module saves.
TEST(Program, AnswersInLittleMemory) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--version"},
          std::vector<std::string>{"eval", "Cu", "--angle", "60", "--wavelength", "550"}}) {
        const Answer answer = run_program(words);
        ASSERT_EQ(answer.status, 0) << words[0];
        EXPECT_FALSE(answer.out.empty());
        if (instrumented) continue;
        EXPECT_LT(answer.most_kilobytes, 40 * 1024) << words[0];
    }
}

TEST(Program, EveryCommandExplainsItself) {
    ASSERT_GE(commands().size(), 10U);
    for (const Command& command : commands()) {
        SCOPED_TRACE(command.name);
        EXPECT_FALSE(command.summary.empty());
        EXPECT_EQ(command.summary.find('\n'), std::string::npos);
        EXPECT_FALSE(command.description.empty());
        EXPECT_NE(command.example.find("drude " + command.name), std::string::npos);
        DeclaredCommand declared;
        declare_command(command, declared);  // throws where two options have one name
        for (const DeclaredOption& option : declared.options.all()) {
            EXPECT_FALSE(option.help.empty()) << option.name;
        }
        EXPECT_NE(help_page(command).find("Usage: drude " + command.name), std::string::npos);
    }
}

}  // namespace
}  // namespace drude
