// What the readers and the writer of OpenEXR files share: headers and their limits.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <map>
#include <string>
#include <string_view>

#include "image/image.h"

namespace drude {

// Attributes that OpenEXR itself writes or derives.
bool belongs_to_openexr(std::string_view name);

// Throws Error (user) where `path` is missing, a folder, or does not start as an OpenEXR file.
void check_exr_file(const std::string& path);

// The strings and numbers among the attributes, but for OpenEXR's own.
std::map<std::string, Attribute> exr_attributes(const Imf::Header& header);

struct ExrSize {
    int width = 0, height = 0;
};
// Of the data window; throws Error (user) where it is empty or larger than largest_picture.
ExrSize exr_size(const Imf::Header& header, const std::string& path);

}  // namespace drude
