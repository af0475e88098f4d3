// The options of one command as data: what the parser reads, and what the help page, the manual
// page and the completion script print. Nothing about an option is written down twice.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command.h"

namespace drude {

struct DeclaredOption {
    enum class Kind { value, flag, word };  // word: one without a dash

    Kind kind = Kind::value;
    std::string name;        // "--seed"; of a word what stands for it, "MATERIAL"
    std::string short_name;  // "-s", or empty
    std::string value_name;  // what stands for the value in the help, "N"; empty for flags
    std::string help;
    std::string default_text;          // empty where there is none worth naming
    std::vector<std::string> choices;  // empty: any value
    size_t at_least = 0;               // of words
    bool repeats = false;
    // Stores what was given; throws Error (user) that names the option and the value.
    std::function<void(const std::vector<std::string>&)> assign;
    bool given = false;
};

class DeclaredOptions : public OptionSet {
  public:
    void option(const std::string& spec, std::string& target, const std::string& help) override;
    void option(const std::string& spec, double& target, const std::string& help) override;
    void option(const std::string& spec, int& target, const std::string& help) override;
    void option(const std::string& spec, uint64_t& target, const std::string& help) override;
    void option(const std::string& spec, std::vector<std::string>& target,
                const std::string& help) override;
    void flag(const std::string& spec, bool& target, const std::string& help) override;
    void choice(const std::string& spec, std::string& target,
                const std::vector<std::string>& allowed, const std::string& help) override;
    void positional(const std::string& name, std::string& target, const std::string& help,
                    bool required) override;
    void positionals(const std::string& name, std::vector<std::string>& target,
                     const std::string& help, int at_least) override;
    // `name` as declared, long or short, with its dashes. A name that was never declared is a
    // fault of the program: std::logic_error.
    bool given(const std::string& name) const override;

    std::vector<DeclaredOption>& all() { return all_; }
    const std::vector<DeclaredOption>& all() const { return all_; }
    // Long and short names of everything that starts with a dash.
    std::vector<std::string> names() const;
    // What has this long or short name, or null.
    const DeclaredOption* find(const std::string& name) const;

  private:
    DeclaredOption& add(DeclaredOption::Kind kind, const std::string& spec,
                        const std::string& help);

    std::vector<DeclaredOption> all_;
};

// A command with all its options, the common ones last.
struct DeclaredCommand {
    DeclaredOptions options;
    CommonOptions common;
    bool help = false;
    std::function<int()> run;
};

// Declares everything of `command` in `declared`, which must outlive the run.
void declare_command(const Command& command, DeclaredCommand& declared);

}  // namespace drude
