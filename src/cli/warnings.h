// Warnings on stderr.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

namespace drude {

inline void print_warning(const std::string& warning) {
    fmt::print(stderr, "drude: warning: {}\n", warning);
}

inline void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) print_warning(warning);
}

}  // namespace drude
