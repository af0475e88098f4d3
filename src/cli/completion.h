// Shell completion, generated from the options the commands declare.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace drude {

// `drude completion bash`. `commands` must outlive what this returns, and may contain it.
Command completion_command(const std::vector<Command>& commands);

// A script for bash 4 or later: commands after the program's name, then each command's options,
// the values of choices, and files.
std::string bash_completion(const std::vector<Command>& commands);

}  // namespace drude
