// What a command of the `drude` program is: its words, its options, what it runs.
//
// A command lives in its own file and is registered in commands.cpp. It declares its options
// against the small interface below, behind which CLI11 stays in one source file (parser.cpp).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace drude {

// Options every command has.
struct CommonOptions {
    bool json = false;   // one JSON document on stdout and nothing else there
    bool quiet = false;  // no progress
    int threads = 0;     // 0: all available
    std::vector<std::string> command_line;
};

// Declares options. A `spec` is "--name" or "-n,--name"; the target keeps its value where the
// option is not given. Numbers are read strictly.
class OptionSet {
  public:
    virtual ~OptionSet() = default;
    virtual void option(const std::string& spec, std::string& target, const std::string& help) = 0;
    virtual void option(const std::string& spec, double& target, const std::string& help) = 0;
    virtual void option(const std::string& spec, int& target, const std::string& help) = 0;
    virtual void option(const std::string& spec, uint64_t& target, const std::string& help) = 0;
    // May be given many times.
    virtual void option(const std::string& spec, std::vector<std::string>& target,
                        const std::string& help) = 0;
    virtual void flag(const std::string& spec, bool& target, const std::string& help) = 0;
    // One of `allowed`.
    virtual void choice(const std::string& spec, std::string& target,
                        const std::vector<std::string>& allowed, const std::string& help) = 0;
    // Words without a dash, in order of declaration.
    virtual void positional(const std::string& name, std::string& target, const std::string& help,
                            bool required) = 0;
    virtual void positionals(const std::string& name, std::vector<std::string>& target,
                             const std::string& help, int at_least) = 0;
    // True where the option was given on the command line; valid once the command runs.
    virtual bool given(const std::string& name) const = 0;
};

// Throws Error (user) "found OPTION, which WHY" for the first of `options` that was given.
void refuse_options(const OptionSet& given, const std::vector<const char*>& options,
                    const std::string& why);

struct Command {
    std::string name;
    std::string summary;      // one line
    std::string description;  // paragraphs for `drude help NAME` and the man page
    std::string example;      // a worked example: commands and what they print
    // Declares the options and returns what runs once they are read. The result is the exit
    // status; Errors are printed by the caller. `options` and `common` outlive the run.
    std::function<std::function<int()>(OptionSet& options, const CommonOptions& common)> declare;
};

// Every command, in the order of the help page.
const std::vector<Command>& commands();

// Reads the command line and runs the command; the exit status of the program.
int run_command_line(int argc, char** argv);

}  // namespace drude
