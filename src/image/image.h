// Float images with named channels and attributes, read from and written to files.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace drude {

using Attribute = std::variant<std::string, int, float>;

// `width` x `height` pixels; channel c of pixel (x, y) is channels[c].data[y * width + x], y = 0
// the top row.
struct Channel {
    std::string name;
    std::vector<float> data;
};

struct Image {
    int width = 0, height = 0;
    std::vector<Channel> channels;
    std::map<std::string, Attribute> attributes;

    size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    // nullptr where there is none of that name.
    const Channel* find(const std::string& name) const;
    Channel* find(const std::string& name);
    // Throws Error (user) that names the file `where` and the channels there are.
    const Channel& at(const std::string& name, const std::string& where) const;
    // Appends a channel of zeros.
    Channel& add(const std::string& name);
    std::string text(const std::string& attribute) const;  // "" where absent or no string
    double number(const std::string& attribute, double otherwise) const;
};

// R, G, B as one width*height*3 vector, for pictures. Where the image has no R, G, B it is Y three
// times, or S0.R, S0.G, S0.B; throws Error (user) that names the file `where` otherwise.
std::vector<float> rgb_values(const Image& image, const std::string& where);

// The largest picture that is read, in pixels: 16384 x 16384.
inline constexpr uint64_t largest_picture = uint64_t{1} << 28;

// OpenEXR directly: any channel names (JCGT commas included), half, float and uint read as float;
// scan lines or tiles, of the first part where there are several. Channels come in the file's own
// order, which OpenEXR keeps alphabetical. Attributes of type string, int, float and double (as
// float) are kept, those that describe the file itself (windows, compression) are not.
// Throws Error (user) for a missing, damaged, empty, deep or subsampled file, or one beyond
// largest_picture.
Image read_exr(const std::string& path);

enum class Compression { none, piz, zip };
// Float32 scanlines, written atomically. Throws Error (outside) where the disk says no, without
// leaving anything behind; std::logic_error for an image without pixels or channels, a channel of
// the wrong size, a name used twice, or an attribute named like one of OpenEXR's own.
void write_exr(const std::string& path, const Image& image, Compression compression);

// Refuses an output of `command` whose ending is another than .exr or none: Error (user).
void expect_exr_name(const std::string& command, const std::string& path);

// EXR directly, anything else that OpenImageIO reads (png, hdr, jpg, tiff, ...) through the module.
// 8- and 16-bit formats are decoded from sRGB to linear (not A, which stays unassociated). Channels
// are R, G, B(, A) or Y(, A). What the file is, is told by its content, not by its name.
// Throws Error (user) for a file that is missing, damaged or of no known format, and Error
// (outside) where the module cannot be loaded.
Image read_image(const std::string& path);

// 8-bit sRGB PNG of linear R, G, B in [0, 1] (clipped, NaN is black). `rgb` holds width*height*3
// linear values. Throws Error (outside) where the disk says no or the module cannot be loaded.
void write_png(const std::string& path, int width, int height, const std::vector<float>& rgb);

// The same as bytes, for pages that carry their pictures.
std::string encode_png(int width, int height, const std::vector<float>& rgb);

}  // namespace drude
