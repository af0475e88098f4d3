#include "image/oiio_loader.h"

#include <dlfcn.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <system_error>

#include "base/error.h"

namespace drude {

namespace {

constexpr const char* file_name = "drude-oiio.so";

template <class Function>
void resolve(void* library, const char* name, Function& function) {
    // POSIX lets dlsym's pointer be a function's; C++ leaves it to the implementation.
    function = reinterpret_cast<Function>(dlsym(library, name));
}

OiioModule load() {
    const std::vector<std::string> candidates = oiio_module_candidates();
    for (const std::string& path : candidates) {
        if (!std::filesystem::exists(path)) continue;
        void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library) {
            const char* reason = dlerror();
            outside_error(
                "{}: does not load: {}; install OpenImageIO (Debian: libopenimageio2.4) or build "
                "again against the one that is installed",
                path, reason ? reason : "no reason given");
        }
        OiioModule module;
        decltype(&drude_oiio_version) version = nullptr;
        resolve(library, "drude_oiio_version", version);
        resolve(library, "drude_oiio_read", module.read);
        resolve(library, "drude_oiio_release", module.release);
        resolve(library, "drude_oiio_png", module.png);
        resolve(library, "drude_oiio_texture", module.texture);
        resolve(library, "drude_oiio_texels", module.texels);
        if (!version || version() != drude_oiio_interface || !module.read || !module.release ||
            !module.png || !module.texture || !module.texels) {
            dlclose(library);
            outside_error("{}: belongs to another version of drude; install both together", path);
        }
        return module;
    }
    std::vector<std::string> folders;
    for (const std::string& path : candidates) {
        folders.push_back(std::filesystem::path(path).parent_path().string());
    }
    outside_error(
        "{} is missing, which reads and writes PNG, HDR and JPEG pictures through OpenImageIO: "
        "looked in {}; install drude completely (with Debian's libopenimageio2.4) or set "
        "DRUDE_MODULE_PATH to its folder",
        file_name, fmt::join(folders, ", "));
}

}  // namespace

std::vector<std::string> oiio_module_candidates() {
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

const OiioModule& oiio_module() {
    static std::mutex mutex;
    static std::optional<OiioModule> module;
    const std::lock_guard<std::mutex> lock(mutex);
    if (!module) module = load();
    return *module;
}

}  // namespace drude
