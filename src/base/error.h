// Errors for people: where, what was found, what was expected, what to do.
//
// Everything that a user can cause, and everything that the outside world can do to us, is thrown
// as drude::Error. The command line prints its message and exits with its cause; nothing else of
// the exception reaches the user. Errors of our own making stay assertions or std::logic_error.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drude {

// Why a command stopped; the values are the exit statuses scripts rely on.
enum class Cause {
    answer_is_no = 1,  // ran, and the answer is no: images differ, a fit was refused
    user = 2,          // the user must change something: an option, a file
    outside = 3,       // a device or a disk failed
};

// A place in a text file. Lines and columns count from 1; 0 means "not known".
struct Place {
    std::string file;
    int line = 0;
    int column = 0;

    // "file:line:column", leaving out what is not known.
    std::string str() const;
};

class Error : public std::exception {
  public:
    Error(Cause cause, std::string message) : cause_(cause), message_(std::move(message)) {}
    Error(Cause cause, const Place& place, const std::string& message)
        : Error(cause, place.str() + ": " + message) {}

    Cause cause() const { return cause_; }
    const std::string& message() const { return message_; }
    const char* what() const noexcept override { return message_.c_str(); }

  private:
    Cause cause_;
    std::string message_;
};

template <class... Args>
[[noreturn]] void user_error(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(Cause::user, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void user_error_at(const Place& place, fmt::format_string<Args...> format,
                                Args&&... args) {
    throw Error(Cause::user, place, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void outside_error(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(Cause::outside, fmt::format(format, std::forward<Args>(args)...));
}

// The candidate nearest to `word` in edit distance (insert, delete, replace, swap neighbours,
// letter case free), or an empty string where nothing is near enough to be a slip of the hand.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

// " (did you mean 'X'?)", or "" where nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace drude
