#include "base/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace drude {
namespace {

// The wait status of a process of its own that runs `action` and exits with what it returns.
template <class Action>
int status_of_child(const Action& action) {
    const pid_t child = fork();
    if (child == 0) _exit(action());
    int status = 0;
    waitpid(child, &status, 0);
    return status;
}

TEST(Interrupt, FirstSignalIsRememberedTheSecondEnds) {
    const int remembered = status_of_child([] {
        catch_interrupts();
        if (interrupted() != 0) return 100;
        std::raise(SIGTERM);
        return interrupted();
    });
    ASSERT_TRUE(WIFEXITED(remembered));
    EXPECT_EQ(WEXITSTATUS(remembered), SIGTERM);

    const int ended = status_of_child([] {
        catch_interrupts();
        std::raise(SIGINT);
        std::raise(SIGINT);
        return 0;
    });
    ASSERT_TRUE(WIFSIGNALED(ended));
    EXPECT_EQ(WTERMSIG(ended), SIGINT);
}

TEST(Interrupt, WhatWasIgnoredStaysIgnored) {
    const int status = status_of_child([] {
        std::signal(SIGINT, SIG_IGN);
        catch_interrupts();
        std::raise(SIGINT);
        return interrupted();
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace drude
