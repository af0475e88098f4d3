// OpenEXR files a few rows at a time, for pictures that should not stand in memory as floats too.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"

namespace drude {

enum class ExrSamples { float32, uint32 };

struct ExrChannel {
    std::string name;
    ExrSamples samples = ExrSamples::float32;
};

struct ExrPicture {
    int width = 0, height = 0;
    std::vector<ExrChannel> channels;
    std::map<std::string, Attribute> attributes;
};

// Fills row y: words[c * width + x] holds the bits of channel c at x. Called once for every row,
// from the top down.
using ExrRowSource = std::function<void(int y, uint32_t* words)>;

// Scanlines, written atomically; what `rows` throws passes through and leaves nothing behind.
// Throws Error (outside) where the disk says no, std::logic_error for a picture without pixels or
// channels, a name used twice, or an attribute named like one of OpenEXR's own.
void write_exr_rows(const std::string& path, const ExrPicture& picture, Compression compression,
                    const ExrRowSource& rows);

// Scanline files of float and uint channels, read row by row.
class ExrRowReader {
  public:
    // Throws Error (user) as read_exr does, and for tiles and half channels.
    explicit ExrRowReader(const std::string& path);
    ~ExrRowReader();
    ExrRowReader(const ExrRowReader&) = delete;
    ExrRowReader& operator=(const ExrRowReader&) = delete;

    // The channels in alphabetical order, as every OpenEXR file has them.
    const ExrPicture& picture() const { return picture_; }
    // words[c * width + x], as above; y in [0, height). Throws Error (user) for a damaged file.
    void read(int y, uint32_t* words);

  private:
    struct File;

    std::string path_;
    ExrPicture picture_;
    std::unique_ptr<File> file_;
};

}  // namespace drude
