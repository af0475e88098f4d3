// Scenes of pbrt-v2 and pbrt-v3: recognised by their words, answered with what has to change.
#pragma once

#include <string_view>

#include "scene/lexer.h"

namespace drude {

// Directives and parameter types that older versions had and pbrt-v4 has not.
bool is_old_directive(std::string_view word);
bool is_old_type(std::string_view word);
// Names of things (`Film "image"`) that older versions had and pbrt-v4 has not.
bool is_old_name(std::string_view directive, std::string_view name);

// Throws Error (user) at `place`, where `found` stood: the version this file was written for, and
// the changes the whole file needs, each with the first line that needs it.
[[noreturn]] void old_version_error(const Lexer& lexer, const Place& place, std::string_view found);

}  // namespace drude
