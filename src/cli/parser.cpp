#include "cli/parser.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "base/error.h"
#include "base/interrupt.h"
#include "cli/completion.h"
#include "cli/declared_options.h"
#include "cli/help.h"

namespace drude {

namespace {

using Words = std::vector<std::string>;

// CLI11 takes the words apart; what they mean, and what is said about wrong ones, is decided here.
class Tokenizer {
  public:
    explicit Tokenizer(const DeclaredOptions& options) {
        app_.allow_extras();
        app_.set_help_flag();
        for (const DeclaredOption& option : options.all()) {
            if (option.kind == DeclaredOption::Kind::word) {
                handles_.push_back(nullptr);
                continue;
            }
            const std::string names = option.short_name.empty()
                                          ? option.name
                                          : fmt::format("{},{}", option.short_name, option.name);
            CLI::Option* handle = nullptr;
            if (option.kind == DeclaredOption::Kind::flag) {
                handle = app_.add_flag(names);
            } else {
                handle = app_.add_option(names, CLI::callback_t{});
                handle->type_size(1)->expected(1)->allow_extra_args(false);
            }
            // Repetitions are judged later, with the option's own name in the message.
            handle->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
            handles_.push_back(handle);
        }
    }

    // False where the words end in the middle of an option.
    bool read(const Words& words) {
        Words reversed(words.rbegin(), words.rend());
        try {
            app_.parse(reversed);
        } catch (const CLI::ArgumentMismatch&) {
            return false;
        }
        return true;
    }

    // What was given to the option of this index.
    Words values(size_t index) const {
        return handles_[index] ? handles_[index]->results() : Words{};
    }

    // Words that belong to no option, in order; a "--" among them ends the options.
    Words rest() const { return app_.remaining(); }

  private:
    CLI::App app_;
    std::vector<CLI::Option*> handles_;
};

// Splits what belongs to no option into words; anything that looks like an option is an error.
Words plain_words(const Words& rest, const DeclaredOptions& options, const std::string& command) {
    Words words;
    bool only_words = false;
    for (const std::string& word : rest) {
        if (!only_words && word == "--") {
            only_words = true;
        } else if (!only_words && word.size() > 1 && word[0] == '-') {
            const std::string name = word.substr(0, word.find('='));
            user_error("found '{}', which is no option of 'drude {}'{}; 'drude help {}' lists them",
                       name, command, did_you_mean(name, options.names()), command);
        } else {
            words.push_back(word);
        }
    }
    return words;
}

// A value such as "--json" means that the real one was forgotten.
void check_value(const std::string& value, const DeclaredOption& option,
                 const DeclaredOptions& options) {
    const bool looks_like_option = value.size() > 2 && value.substr(0, 2) == "--";
    if (looks_like_option || (!value.empty() && value[0] == '-' && options.find(value))) {
        user_error("{}: found the option '{}', expected a value ({})", option.name, value,
                   option.value_name);
    }
    if (value.empty()) user_error("{}: found nothing, expected a value", option.name);
}

// The first words go to the first declared names, each taking as many as leaves enough for those
// after it.
void assign_words(const Words& words, DeclaredOptions& options, const std::string& command) {
    size_t next = 0, wanted_later = 0;
    for (const DeclaredOption& option : options.all()) {
        wanted_later += option.at_least;
        if (option.at_least == 1 && wanted_later > words.size()) {
            user_error("{}: found no {}; 'drude help {}' shows an example", command, option.name,
                       command);
        }
    }
    for (DeclaredOption& option : options.all()) {
        if (option.kind != DeclaredOption::Kind::word) continue;
        wanted_later -= option.at_least;
        const size_t left = words.size() - next;
        const size_t free = left > wanted_later ? left - wanted_later : 0;
        const size_t taken = option.repeats ? free : std::min<size_t>(1, free);
        if (taken < option.at_least) {
            user_error("{}: found {} of {}, expected at least {}; 'drude help {}' shows an example",
                       command, taken, option.name, option.at_least, command);
        }
        if (taken == 0) continue;
        const auto begin = words.begin() + static_cast<std::ptrdiff_t>(next);
        option.given = true;
        option.assign(Words(begin, begin + static_cast<std::ptrdiff_t>(taken)));
        next += taken;
    }
    if (next < words.size()) {
        user_error(
            "found '{}', which 'drude {}' has no place for; 'drude help {}' shows an example",
            words[next], command, command);
    }
}

// Reads `words` into what `declared` declares. True where the help page was asked for.
bool read_options(const Words& words, const std::string& command, DeclaredCommand& declared) {
    DeclaredOptions& options = declared.options;
    Tokenizer tokens(options);
    if (!tokens.read(words)) {
        user_error("{}: found nothing after it, expected a value; 'drude help {}' shows an example",
                   words.back(), command);
    }
    for (size_t i = 0; i < options.all().size(); ++i) {
        if (options.all()[i].name == "--help" && !tokens.values(i).empty()) return true;
    }
    const Words plain = plain_words(tokens.rest(), options, command);
    for (size_t i = 0; i < options.all().size(); ++i) {
        DeclaredOption& option = options.all()[i];
        const Words values = tokens.values(i);
        if (values.empty()) continue;
        if (option.kind == DeclaredOption::Kind::flag) {
            if (values.back() != "true") {
                user_error("{}: found the value '{}', but it takes none", option.name,
                           values.back());
            }
        } else {
            if (values.size() > 1 && !option.repeats) {
                user_error("{}: found {} times, expected once", option.name, values.size());
            }
            for (const std::string& value : values) check_value(value, option, options);
        }
        option.given = true;
        option.assign(values);
    }
    assign_words(plain, options, command);
    if (declared.common.threads < 0) {
        user_error("--threads: found {}, expected 1 or more, or 0 for all there are",
                   declared.common.threads);
    }
    return false;
}

int say(const std::string& message, int status) {
    // The C library's own stream: it reports nothing and throws nothing where stderr is closed.
    std::fputs(("drude: " + message + "\n").c_str(), stderr);
    return status;
}

bool reader_is_gone() {
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

int output_failed(int error_number) {
    if (error_number == EPIPE || reader_is_gone()) return 128 + SIGPIPE;
    return say(fmt::format("standard output: cannot write: {}",
                           error_number != 0 ? std::strerror(error_number) : "the write failed"),
               static_cast<int>(Cause::outside));
}

// What was printed must have arrived before the status may say that it did.
int finish_output(int status) {
    // std::cout hands its flush on to stdout, so either call may be the one that learns the reason.
    errno = 0;
    bool failed = !std::cout.flush();
    failed = std::fflush(stdout) != 0 || failed;
    const int error_number = failed ? errno : 0;
    failed = failed || std::ferror(stdout) != 0;
    return failed && status <= 1 ? output_failed(error_number) : status;
}

int internal_error(const std::string& command, const char* what) {
    // What an exception says of itself helps whoever mends the program, and nobody else.
    const bool debug = std::getenv("DRUDE_DEBUG") != nullptr;
    return say(
        fmt::format("internal error in 'drude {}': this is a fault of the program, please "
                    "report it with the command line{}",
                    command, debug ? fmt::format(": {}", what) : " (DRUDE_DEBUG=1 tells more)"),
        static_cast<int>(Cause::outside));
}

int run_guarded(const std::string& command, const std::function<int()>& run) {
    try {
        return run();
    } catch (const Error& error) {
        return say(error.message(), static_cast<int>(error.cause()));
    } catch (const std::bad_alloc&) {
        return say("out of memory; a smaller picture, shorter tables or fewer threads need less",
                   static_cast<int>(Cause::outside));
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) != 0) return output_failed(error.code().value());
        return say(fmt::format("the system refused an operation: {}", error.code().message()),
                   static_cast<int>(Cause::outside));
    } catch (const std::exception& error) {
        return internal_error(command, error.what());
    } catch (...) {
        return internal_error(command, "not a standard exception");
    }
}

int run_command(const Command& command, const Words& words) {
    DeclaredCommand declared;
    declare_command(command, declared);
    declared.common.command_line = {"drude", command.name};
    declared.common.command_line.insert(declared.common.command_line.end(), words.begin(),
                                        words.end());
    if (read_options(words, command.name, declared)) {
        std::fputs(help_page(command).c_str(), stdout);
        return 0;
    }
    return declared.run();
}

// A word in the place of the command that starts with a dash is an option that came too early.
void check_command_word(const std::string& word) {
    if (word.empty() || word[0] != '-') return;
    user_error("found '{}', expected a command first: 'drude COMMAND {}'; 'drude help' lists them",
               word, word);
}

}  // namespace

int run_command_line(const std::vector<Command>& commands, int argc, char** argv) {
    // The describing commands look at the whole list, themselves included.
    std::vector<Command> all;
    all.reserve(commands.size() + 3);
    all = commands;
    all.push_back(help_command(all));
    all.push_back(completion_command(all));
    all.push_back(version_command());

    Words words(argv + std::min(argc, 1), argv + argc);
    if (words.empty()) {
        std::fputs(overview_page(all).c_str(), stderr);
        return static_cast<int>(Cause::user);
    }
    std::string name = words.front();
    words.erase(words.begin());
    if (name == "--help" || name == "-h") name = "help";
    if (name == "--version") name = "version";
    const int status = finish_output(run_guarded(name, [&] {
        check_command_word(name);
        return run_command(find_command(all, name), words);
    }));
    return interrupted() != 0 ? 128 + interrupted() : status;
}

int run_command_line(int argc, char** argv) {
    return run_command_line(commands(), argc, argv);
}

void prepare_process() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        if (fcntl(descriptor, F_GETFD) != -1) continue;
        // The lowest free number is this one. Read-only, so that writing to it still fails.
        if (open("/dev/null", O_RDONLY) != descriptor) std::_Exit(static_cast<int>(Cause::outside));
    }
    std::signal(SIGPIPE, SIG_IGN);
    // A file grown past its limit (ulimit -f) is a failed write like one on a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    catch_interrupts();
}

}  // namespace drude
