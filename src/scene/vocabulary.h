// The words of pbrt-v4: which things a directive can name, and the parameters each takes. What is
// in here and not modelled gets a message; what is not in here is an error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drude {

// The names that may follow `kind` ("Camera", "Film", "Shape", "Material", ...).
std::vector<std::string> known_names(std::string_view kind);
bool is_known_name(std::string_view kind, std::string_view name);
// The parameters of one of them; with an empty name, those of all of that kind.
std::vector<std::string> known_parameters(std::string_view kind, std::string_view name);

}  // namespace drude
