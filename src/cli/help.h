// The commands that describe the others, from the data the others declare.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/declared_options.h"

namespace drude {

// `drude help [COMMAND]`, `drude help --man`. `commands` must outlive what this returns, and may
// contain it: it is read when the command runs.
Command help_command(const std::vector<Command>& commands);

// `drude version`, also known as `drude --version`.
Command version_command();

// The page of one command, and the page that lists all of them; text, 80 columns.
std::string help_page(const Command& command);
std::string overview_page(const std::vector<Command>& commands);

// The command of this name; throws Error (user) that names the nearest.
const Command& find_command(const std::vector<Command>& commands, const std::string& name);

// Pieces that the help page and the manual page share: "-o, --output VALUE"; the help with the
// default value; " IN OUT [MORE...] [OPTION...]"; what each exit status means.
std::string option_label(const DeclaredOption& option);
std::string option_text(const DeclaredOption& option);
std::string usage_words(const DeclaredOptions& options);
const std::vector<std::pair<std::string, std::string>>& exit_statuses();

}  // namespace drude
