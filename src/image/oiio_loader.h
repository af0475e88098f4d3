// Finds and loads drude-oiio.so. OpenImageIO pulls in hundreds of libraries (0.4 s, 134 MB), so
// only a command that meets a PNG, HDR, JPEG, ... pays for it.
#pragma once

#include "image/oiio/oiio_module.h"

namespace drude {

inline constexpr const char* oiio_module_file = "drude-oiio.so";

struct OiioModule {
    decltype(&drude_oiio_read) read = nullptr;
    decltype(&drude_oiio_release) release = nullptr;
    decltype(&drude_oiio_png) png = nullptr;
    decltype(&drude_oiio_texture) texture = nullptr;
    decltype(&drude_oiio_texels) texels = nullptr;
};

// The loaded module; from any thread. Throws Error (outside) that names the places searched and
// the Debian package of OpenImageIO where it is not there or does not load; a later call tries
// again.
const OiioModule& oiio_module();

}  // namespace drude
