// Where the program's loadable modules lie: what only some runs need is not linked.
#pragma once

#include <string>
#include <vector>

namespace drude {

// Where the module `file_name` is looked for, in this order: the folders of $DRUDE_MODULE_PATH
// (separated by colons), the program's folder, lib/drude, lib/*/drude and lib64/drude beside the
// program's folder, and the folder that the build was installed to.
std::vector<std::string> module_candidates(const std::string& file_name);

}  // namespace drude
