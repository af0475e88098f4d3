#include "base/module_path.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

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
#ifdef DRUDE_MODULE_FOLDER
    add(DRUDE_MODULE_FOLDER);
#endif
    return candidates;
}

}  // namespace drude
