// Errors checked for their cause and for the words a person needs.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "base/error.h"

namespace drude {

// Runs `action`, which must throw an Error of this cause whose message holds every one of `words`.
template <class Action>
void expect_error(Cause cause, std::initializer_list<const char*> words, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(static_cast<int>(error.cause()), static_cast<int>(cause)) << error.message();
        for (const char* word : words) {
            EXPECT_NE(error.message().find(word), std::string::npos)
                << "'" << word << "' is not in: " << error.message();
        }
        return;
    }
    ADD_FAILURE() << "nothing was thrown";
}

// The message of the Error (user) that `action` must throw; empty where it throws none, which
// fails the test.
template <class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user) << error.message();
        return error.message();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace drude
