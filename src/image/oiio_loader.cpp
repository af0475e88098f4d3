#include "image/oiio_loader.h"

#include <mutex>
#include <optional>

#include "base/error.h"
#include "base/module.h"

namespace drude {

namespace {

OiioModule load() {
    const LoadedModule loaded =
        load_module(oiio_module_file, false, "OpenImageIO (Debian: libopenimageio2.4)");
    if (!loaded.library) {
        outside_error(
            "{} is missing, which reads and writes PNG, HDR and JPEG pictures through OpenImageIO: "
            "looked in {}; install drude completely (with Debian's libopenimageio2.4) or set "
            "DRUDE_MODULE_PATH to its folder",
            oiio_module_file, module_folders(oiio_module_file));
    }
    OiioModule module;
    decltype(&drude_oiio_version) version = nullptr;
    if (!loaded.resolve("drude_oiio_version", version) || version() != drude_oiio_interface ||
        !loaded.resolve("drude_oiio_read", module.read) ||
        !loaded.resolve("drude_oiio_release", module.release) ||
        !loaded.resolve("drude_oiio_png", module.png) ||
        !loaded.resolve("drude_oiio_texture", module.texture) ||
        !loaded.resolve("drude_oiio_texels", module.texels)) {
        loaded.refuse();
    }
    return module;
}

}  // namespace

const OiioModule& oiio_module() {
    static std::mutex mutex;
    static std::optional<OiioModule> module;
    const std::lock_guard<std::mutex> lock(mutex);
    if (!module) module = load();
    return *module;
}

}  // namespace drude
