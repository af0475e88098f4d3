#include "cli/completion.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/declared_options.h"

namespace drude {

namespace {

std::vector<std::string> command_names(const std::vector<Command>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const Command& command : commands) names.push_back(command.name);
    return names;
}

}  // namespace

std::string bash_completion(const std::vector<Command>& commands) {
    std::string options_of_command, values_of_option;
    for (const Command& command : commands) {
        DeclaredCommand declared;
        declare_command(command, declared);
        options_of_command += fmt::format("        {}) options='{}' ;;\n", command.name,
                                          fmt::join(declared.options.names(), " "));
        for (const DeclaredOption& option : declared.options.all()) {
            if (option.choices.empty()) continue;
            values_of_option += fmt::format("        '{} {}'", command.name, option.name);
            if (!option.short_name.empty()) {
                values_of_option += fmt::format("|'{} {}'", command.name, option.short_name);
            }
            values_of_option += fmt::format(") values='{}' ;;\n", fmt::join(option.choices, " "));
        }
    }
    const std::string names = fmt::format("{}", fmt::join(command_names(commands), " "));
    std::string script = "# bash completion for drude, printed by 'drude completion bash'.\n";
    script += "_drude() {\n";
    script += "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n";
    script += "    local options='' values=''\n";
    script += "    COMPREPLY=()\n";
    script += "    if ((COMP_CWORD == 1)); then\n";
    script += "        COMPREPLY=($(compgen -W '" + names + " --help --version' -- \"$word\"))\n";
    script += "        return\n";
    script += "    fi\n";
    // With "=" among the word breaks, --name=value arrives as three words.
    script += "    if [[ $word == '=' ]]; then\n";
    script += "        word=''\n";
    script += "    elif [[ $before == '=' ]]; then\n";
    script += "        before=${COMP_WORDS[COMP_CWORD-2]}\n";
    script += "    fi\n";
    script += "    case \"${COMP_WORDS[1]} $before\" in\n";
    script += values_of_option;
    script += "        'help '*) values='" + names + "' ;;\n";
    script += "        'completion '*) values='bash' ;;\n";
    script += "    esac\n";
    script += "    if [[ -n $values && $word != -* ]]; then\n";
    script += "        COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n";
    script += "        return\n";
    script += "    fi\n";
    script += "    [[ $word == -* ]] || return\n";
    script += "    case ${COMP_WORDS[1]} in\n";
    script += options_of_command;
    script += "    esac\n";
    script += "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n";
    script += "}\n";
    // Where the function offers nothing, bash completes file names.
    script += "complete -o default -F _drude drude\n";
    return script;
}

Command completion_command(const std::vector<Command>& commands) {
    Command completion;
    completion.name = "completion";
    completion.summary = "Print a completion script for the shell";
    completion.description =
        "The script completes commands, options and the values of options that take one of a few. "
        "It is generated from the options the commands declare.";
    completion.example = "source <(drude completion bash)";
    completion.declare = [&commands](OptionSet& options, const CommonOptions& common) {
        const auto shell = std::make_shared<std::string>();
        options.positional("SHELL", *shell, "the shell: bash", true);
        return [shell, &commands, &common] {
            if (*shell != "bash") {
                user_error("found the shell '{}', expected bash{}", *shell,
                           did_you_mean(*shell, {"bash"}));
            }
            const std::string script = bash_completion(commands);
            const std::string text =
                common.json ? nlohmann::ordered_json{{"script", script}}.dump(2) + "\n" : script;
            std::fputs(text.c_str(), stdout);
            return 0;
        };
    };
    return completion;
}

}  // namespace drude
