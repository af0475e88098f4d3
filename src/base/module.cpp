#include "base/module.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "base/error.h"

namespace drude {

std::vector<std::string> module_candidates(const std::string& file_name) {
    namespace fs = std::filesystem;
    std::vector<std::string> candidates;
    const auto add = [&](const fs::path& folder) {
        const std::string path = (folder / file_name).lexically_normal().string();
        if (std::find(candidates.begin(), candidates.end(), path) == candidates.end()) {
            candidates.push_back(path);
        }
    };
    if (const char* list = std::getenv("DRUDE_MODULE_PATH")) {
        std::istringstream folders(list);
        for (std::string folder; std::getline(folders, folder, ':');) {
            if (!folder.empty()) add(folder);
        }
    }
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (!program.empty()) {
        const fs::path folder = program.parent_path();
        add(folder);
        const fs::path libraries = folder.parent_path() / "lib";
        add(libraries / "drude");
        std::vector<fs::path> architectures;
        for (fs::directory_iterator it(libraries, ignored), end; !ignored && it != end;
             it.increment(ignored)) {
            if (fs::is_directory(it->path() / "drude", ignored))
                architectures.push_back(it->path());
        }
        std::sort(architectures.begin(), architectures.end());
        for (const fs::path& architecture : architectures) add(architecture / "drude");
        add(folder.parent_path() / "lib64" / "drude");
    }
    return candidates;
}

std::string module_folders(const std::string& file_name) {
    std::vector<std::string> folders;
    for (const std::string& path : module_candidates(file_name)) {
        folders.push_back(std::filesystem::path(path).parent_path().string());
    }
    return fmt::format("{}", fmt::join(folders, ", "));
}

void LoadedModule::refuse() const {
    dlclose(library);
    outside_error("{}: belongs to another version of drude; install both together", path);
}

LoadedModule load_module(const std::string& file_name, bool visible, const std::string& package) {
    for (const std::string& path : module_candidates(file_name)) {
        if (!std::filesystem::exists(path)) continue;
        void* library = dlopen(path.c_str(), RTLD_NOW | (visible ? RTLD_GLOBAL : RTLD_LOCAL));
        if (!library) {
            const char* reason = dlerror();
            outside_error(
                "{}: does not load: {}; install {} or build again against the one that is "
                "installed",
                path, reason ? reason : "no reason given", package);
        }
        return {library, path};
    }
    return {};
}

}  // namespace drude
