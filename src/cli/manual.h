// The manual page, generated from the options the commands declare.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace drude {

// drude(1) in the man macros of roff, UTF-8.
std::string manual_page(const std::vector<Command>& commands);

}  // namespace drude
