#include "image/exr_header.h"

#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace drude {

bool belongs_to_openexr(std::string_view name) {
    static constexpr std::array<std::string_view, 18> names = {"channels",
                                                               "compression",
                                                               "dataWindow",
                                                               "displayWindow",
                                                               "lineOrder",
                                                               "pixelAspectRatio",
                                                               "screenWindowCenter",
                                                               "screenWindowWidth",
                                                               "tiles",
                                                               "type",
                                                               "name",
                                                               "version",
                                                               "chunkCount",
                                                               "view",
                                                               "preview",
                                                               "multiView",
                                                               "maxSamplesPerPixel",
                                                               "dwaCompressionLevel"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check_exr_file(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) user_error("{}: is a folder; expected an OpenEXR file", path);
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) user_error("{}: cannot open: {}", path, std::strerror(errno));
    unsigned char magic[4] = {};
    const ssize_t count = read(descriptor, magic, sizeof magic);
    close(descriptor);
    static constexpr unsigned char expected[4] = {0x76, 0x2f, 0x31, 0x01};
    if (count != 4 || std::memcmp(magic, expected, 4) != 0) {
        user_error("{}: is no OpenEXR file (it does not start with its four-byte signature)", path);
    }
}

std::map<std::string, Attribute> exr_attributes(const Imf::Header& header) {
    std::map<std::string, Attribute> attributes;
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (belongs_to_openexr(it.name())) continue;
        const Imf::Attribute& attribute = it.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
            attributes[it.name()] = text->value();
        } else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
            attributes[it.name()] = whole->value();
        } else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
            attributes[it.name()] = real->value();
        } else if (const auto* wide = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
            attributes[it.name()] = static_cast<float>(wide->value());
        }
    }
    return attributes;
}

ExrSize exr_size(const Imf::Header& header, const std::string& path) {
    const auto& window = header.dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1) {
        user_error("{}: the data window is {} x {} pixels; expected at least 1 x 1", path, width,
                   height);
    }
    // Divided, not multiplied: a damaged header can hold sides whose product overflows.
    if (static_cast<uint64_t>(width) > largest_picture / static_cast<uint64_t>(height)) {
        user_error("{}: the data window is {} x {} pixels; the most that is read is {} pixels",
                   path, width, height, largest_picture);
    }
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace drude
