#include "cli/help.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/declared_options.h"
#include "cli/manual.h"

namespace drude {

namespace {

constexpr size_t page_width = 80;
constexpr size_t help_column = 26;

// Columns that UTF-8 text takes: its bytes without the continuation bytes.
size_t display_width(std::string_view text) {
    return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

// Appends `text` word by word; lines after the first begin with `indent` blanks. `column` is where
// the page stands.
void append_wrapped(std::string& page, std::string_view text, size_t indent, size_t column) {
    bool first = true;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        begin = end + 1;
        if (word.empty()) continue;
        const size_t width = display_width(word);
        if (!first && column + 1 + width > page_width) {
            page += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (!first) {
            page += ' ';
            ++column;
        }
        page += word;
        column += width;
        first = false;
    }
    page += '\n';
}

// Paragraphs are filled; lines that begin with a blank stand as they are.
void append_paragraphs(std::string& page, std::string_view text) {
    std::string paragraph;
    const auto flush = [&] {
        if (!paragraph.empty()) append_wrapped(page, paragraph, 0, 0);
        paragraph.clear();
    };
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        if (line.empty() || line[0] == ' ') {
            flush();
            page += line;
            page += '\n';
        } else {
            paragraph += line;
            paragraph += '\n';
        }
    }
    flush();
}

void append_entry(std::string& page, const std::string& left, const std::string& right) {
    page += "  " + left;
    size_t column = 2 + display_width(left);
    if (column + 2 > help_column) {
        page += '\n';
        column = 0;
    }
    page += std::string(help_column - column, ' ');
    append_wrapped(page, right, help_column, help_column);
}

nlohmann::ordered_json describe(const Command& command) {
    DeclaredCommand declared;
    declare_command(command, declared);
    auto options = nlohmann::ordered_json::array();
    for (const DeclaredOption& option : declared.options.all()) {
        nlohmann::ordered_json entry = {{"name", option.name}, {"help", option.help}};
        if (!option.short_name.empty()) entry["short"] = option.short_name;
        if (!option.value_name.empty()) entry["value"] = option.value_name;
        if (!option.choices.empty()) entry["choices"] = option.choices;
        if (!option.default_text.empty()) entry["default"] = option.default_text;
        if (option.repeats) entry["repeats"] = true;
        if (option.at_least > 0) entry["at_least"] = option.at_least;
        options.push_back(entry);
    }
    return {{"name", command.name},
            {"summary", command.summary},
            {"description", command.description},
            {"example", command.example},
            {"options", options}};
}

}  // namespace

const Command& find_command(const std::vector<Command>& commands, const std::string& name) {
    std::vector<std::string> names;
    for (const Command& command : commands) {
        if (command.name == name) return command;
        names.push_back(command.name);
    }
    user_error("found '{}', which is no command{}; 'drude help' lists them", name,
               did_you_mean(name, names));
}

std::string option_label(const DeclaredOption& option) {
    if (option.kind == DeclaredOption::Kind::word) return option.name;
    std::string label = option.short_name.empty() ? "" : option.short_name + ", ";
    label += option.name;
    if (!option.value_name.empty()) label += " " + option.value_name;
    return label;
}

std::string option_text(const DeclaredOption& option) {
    std::string text = option.help;
    if (!option.default_text.empty()) text += fmt::format(" (default: {})", option.default_text);
    if (option.repeats && option.kind == DeclaredOption::Kind::value) text += " (may be repeated)";
    return text;
}

std::string usage_words(const DeclaredOptions& options) {
    std::string usage;
    for (const DeclaredOption& option : options.all()) {
        if (option.kind != DeclaredOption::Kind::word) continue;
        const std::string word = option.name + (option.repeats ? "..." : "");
        usage += option.at_least > 0 ? " " + word : " [" + word + "]";
    }
    return usage + " [OPTION...]";
}

const std::vector<std::pair<std::string, std::string>>& exit_statuses() {
    static const std::vector<std::pair<std::string, std::string>> statuses = {
        {"0", "Done; of a comparison: the same."},
        {"1", "Ran, and the answer is no: images differ, a fit was refused, a regression failed."},
        {"2", "You must change something: an option, a file."},
        {"3",
         "The outside failed (a device, a disk, memory), or the program itself is at fault "
         "and says so."},
        {"130, 143", "Interrupted (Ctrl-C, SIGTERM); what was finished is saved."},
        {"141", "Whoever read standard output went away."},
    };
    return statuses;
}

std::string help_page(const Command& command) {
    DeclaredCommand declared;
    declare_command(command, declared);
    std::string page = fmt::format("drude {}: {}\n\n", command.name, command.summary);
    page += fmt::format("Usage: drude {}{}\n\n", command.name, usage_words(declared.options));
    append_paragraphs(page, command.description);
    if (!command.description.empty()) page += '\n';
    page += "Options:\n";
    for (const DeclaredOption& option : declared.options.all()) {
        append_entry(page, option_label(option), option_text(option));
    }
    if (!command.example.empty()) {
        page += "\nExample:\n";
        for (size_t begin = 0; begin < command.example.size();) {
            const size_t end = std::min(command.example.find('\n', begin), command.example.size());
            const std::string line = command.example.substr(begin, end - begin);
            page += line.empty() ? "\n" : "  " + line + "\n";
            begin = end + 1;
        }
    }
    return page;
}

std::string overview_page(const std::vector<Command>& commands) {
    std::string page =
        "drude measures, fits, renders and compares the polarising reflectance of metals.\n\n"
        "Usage: drude COMMAND [WORD...] [OPTION...]\n\n"
        "Commands:\n";
    for (const Command& command : commands) append_entry(page, command.name, command.summary);
    page += "\nExit status:\n";
    for (const auto& [status, meaning] : exit_statuses()) append_entry(page, status, meaning);
    page += "\n'drude help COMMAND' shows the options and a worked example.\n";
    return page;
}

Command help_command(const std::vector<Command>& commands) {
    Command help;
    help.name = "help";
    help.summary = "Explain a command, with a worked example";
    help.description =
        "Without a word, lists the commands. With --man, prints the manual page in the man macros "
        "of roff; with --json, every command with all its options.";
    help.example = "drude help eval\ndrude help --man | man -l -";
    help.declare = [&commands](OptionSet& options, const CommonOptions& common) {
        struct State {
            std::string name;
            bool manual = false;
        };
        const auto state = std::make_shared<State>();
        options.positional("COMMAND", state->name, "the command to explain", false);
        options.flag("--man", state->manual, "print the manual page");
        return [state, &commands, &common] {
            const Command* command =
                state->name.empty() ? nullptr : &find_command(commands, state->name);
            std::string text;
            if (common.json && state->manual) {
                text = nlohmann::ordered_json{{"manual", manual_page(commands)}}.dump(2) + "\n";
            } else if (common.json && command) {
                text = describe(*command).dump(2) + "\n";
            } else if (common.json) {
                auto all = nlohmann::ordered_json::array();
                for (const Command& each : commands) all.push_back(describe(each));
                text = nlohmann::ordered_json{{"commands", all}}.dump(2) + "\n";
            } else if (state->manual) {
                text = manual_page(commands);
            } else {
                text = command ? help_page(*command) : overview_page(commands);
            }
            std::fputs(text.c_str(), stdout);
            return 0;
        };
    };
    return help;
}

Command version_command() {
    Command version;
    version.name = "version";
    version.summary = "Print the version and the instruction set it is built for";
    version.description = "'drude --version' is the same.";
    version.example = "drude --version";
    version.declare = [](OptionSet&, const CommonOptions& common) {
        return [&common] {
            if (common.json) {
                const nlohmann::ordered_json json = {{"version", DRUDE_VERSION},
                                                     {"isa", DRUDE_ISA}};
                fmt::print("{}\n", json.dump(2));
            } else {
                fmt::print("drude {} ({})\n", DRUDE_VERSION, DRUDE_ISA);
            }
            return 0;
        };
    };
    return version;
}

}  // namespace drude
