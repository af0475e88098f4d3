#include "image/oiio_loader.h"

#include <dlfcn.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "base/module_path.h"

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
    return module_candidates(file_name);
}

const OiioModule& oiio_module() {
    static std::mutex mutex;
    static std::optional<OiioModule> module;
    const std::lock_guard<std::mutex> lock(mutex);
    if (!module) module = load();
    return *module;
}

}  // namespace drude
