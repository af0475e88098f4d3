// A picture read a few pixels at a time, through OpenImageIO's cache: however large the pictures of
// a scene are together, a bounded part of them (1 GB) is in memory.
#pragma once

#include <string>

namespace drude {

class TexelSource {
  public:
    // Throws Error (user) for a file that is missing, of no known format, or larger than
    // `largest_picture`; Error (outside) where the module cannot be loaded. Damage further on in
    // the file shows when it is read.
    explicit TexelSource(const std::string& path);

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }  // 1, or 3: R, G, B
    // The file's samples are integers; they come scaled to [0, 1] and still encoded.
    bool is_integer() const { return is_integer_; }

    // The pixels [x0, x0 + columns) x [y0, y0 + rows), which lie within the picture, row 0 the top,
    // as channels() interleaved values. From any thread. Throws Error (user) where the file is
    // damaged.
    void read(int x0, int y0, int columns, int rows, float* values) const;

  private:
    std::string path_;
    int width_ = 0, height_ = 0, channels_ = 0;
    bool is_integer_ = false;
    void* handle_ = nullptr;
};

}  // namespace drude
