// Loadable modules: what only some runs need is not linked but loaded where it is needed.
#pragma once

#include <dlfcn.h>

#include <string>
#include <vector>

namespace drude {

// Where the module `file_name` is looked for, in this order: the folders of $DRUDE_MODULE_PATH
// (separated by colons), the program's folder, and lib/drude, lib/*/drude and lib64/drude beside
// the program's folder.
std::vector<std::string> module_candidates(const std::string& file_name);

// The folders of those, "a, b, c", for a message.
std::string module_folders(const std::string& file_name);

struct LoadedModule {
    void* library = nullptr;  // none where there is no such file
    std::string path;

    // Whether the module exports `name`; then `function` is it.
    template <class Function>
    bool resolve(const char* name, Function& function) const {
        // POSIX lets dlsym's pointer be a function's; C++ leaves it to the implementation.
        function = reinterpret_cast<Function>(dlsym(library, name));
        return function != nullptr;
    }

    // Closes it and throws Error (outside): it is of another version.
    [[noreturn]] void refuse() const;
};

// Loads the first of the candidates that exists, its symbols `visible` to what is loaded later.
// Throws Error (outside) where that does not load; `package` is what to install then, "OpenMPI
// (Debian: libopenmpi3)".
LoadedModule load_module(const std::string& file_name, bool visible, const std::string& package);

}  // namespace drude
