// What a measurement was made on.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drude {

// The commit that the program was built from, with "+changes" where the sources were not it;
// "unknown" outside a repository.
const char* source_commit();

// Terms and values: date, processor, processors in use, memory, kernel, compiler, instruction set,
// drude and its commit, Embree, Ceres.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace drude
