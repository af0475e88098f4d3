// Pictures that are not OpenEXR, through the module.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "image/oiio_loader.h"
#include "image/srgb.h"

namespace drude {

namespace {

bool is_openexr(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) user_error("{}: is a folder; expected a picture", path);
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) user_error("{}: cannot open: {}", path, std::strerror(errno));
    unsigned char magic[4] = {};
    const ssize_t count = read(descriptor, magic, sizeof magic);
    close(descriptor);
    if (count <= 0) user_error("{}: is empty; expected a picture", path);
    return count == 4 && magic[0] == 0x76 && magic[1] == 0x2f && magic[2] == 0x31 &&
           magic[3] == 0x01;
}

Image image_of(const DrudeOiioPicture& picture) {
    static const std::array<std::vector<std::string>, 4> names = {
        {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
    Image image;
    image.width = picture.width;
    image.height = picture.height;
    const size_t channels = static_cast<size_t>(picture.channels);
    for (size_t c = 0; c < channels; ++c) {
        Channel& channel = image.add(names[channels - 1][c]);
        const bool encoded = picture.is_integer && channel.name != "A";
        for (size_t i = 0; i < image.pixels(); ++i) {
            const float value = picture.values[i * channels + c];
            channel.data[i] = encoded ? linear_from_srgb(value) : value;
        }
    }
    return image;
}

}  // namespace

Image read_image(const std::string& path) {
    if (is_openexr(path)) return read_exr(path);
    const OiioModule& module = oiio_module();
    DrudeOiioPicture picture{};
    if (module.read(path.c_str(), largest_picture, &picture) != 0) {
        user_error("{}: cannot read this picture: {}", path, picture.message);
    }
    Image image;
    try {
        image = image_of(picture);
    } catch (...) {
        module.release(&picture);
        throw;
    }
    module.release(&picture);
    return image;
}

std::string encode_png(int width, int height, const std::vector<float>& rgb) {
    if (width < 1 || height < 1 ||
        rgb.size() != 3 * static_cast<size_t>(width) * static_cast<size_t>(height)) {
        throw std::logic_error("encode_png: a picture of a wrong size");
    }
    std::vector<unsigned char> bytes(rgb.size());
    for (size_t i = 0; i < rgb.size(); ++i) bytes[i] = srgb_byte(rgb[i]);
    std::string png;
    const DrudeOiioSink append = [](void* context, const void* data, size_t count) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), count);
    };
    std::array<char, 512> message{};
    if (oiio_module().png(width, height, bytes.data(), append, &png, message.data(),
                          message.size()) != 0) {
        outside_error("cannot make a PNG picture of {} x {} pixels: {}", width, height,
                      message.data());
    }
    return png;
}

void write_png(const std::string& path, int width, int height, const std::vector<float>& rgb) {
    write_file(path, encode_png(width, height, rgb));
}

}  // namespace drude
