#include "image/texel_source.h"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "image/image.h"
#include "image/oiio_loader.h"

namespace drude {

TexelSource::TexelSource(const std::string& path) : path_(path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) user_error("{}: is not a regular file", path);
    DrudeOiioTexture texture{};
    if (oiio_module().texture(path.c_str(), largest_picture, &texture) != 0) {
        user_error("{}: cannot read this picture: {}", path, texture.message);
    }
    width_ = texture.width;
    height_ = texture.height;
    channels_ = texture.channels;
    is_integer_ = texture.is_integer != 0;
    handle_ = texture.handle;
}

void TexelSource::read(int x0, int y0, int columns, int rows, float* values) const {
    // One look-up a process: this is called for every sample of a textured surface.
    static const OiioModule& module = oiio_module();
    std::array<char, 512> message;
    if (module.texels(handle_, x0, x0 + columns, y0, y0 + rows, values, message.data(),
                      message.size()) != 0) {
        user_error("{}: cannot read this picture: {}", path_, message.data());
    }
}

}  // namespace drude
