// Files of exact sums: shards and checkpoints.
//
// An OpenEXR file of uint channels, uncompressed: "sums.000" is the number of batches that a pixel
// holds, "sums.001" to the last but one what FilmSums::to_words says of it, and "sums.check" a
// CRC-32 of these words that goes on from one of the attributes, so that neither a damaged file
// nor one of another job is taken for good. The attributes are those of a picture, and
// `drudeSums` (the format), `resolution`, `maxDepth`, `spectral`, `batchRange` ("first:last" of
// the part), `pictureBatches` (0: open), `rays`, `projections`, `notFinite`, `outOfRange` and
// `renderSeconds`.
#pragma once

#include <string>
#include <vector>

#include "image/exr_rows.h"
#include "render/film_job.h"

namespace drude {

// The words of rows of sums with their check, shared by files and messages between processes.
class FilmWords {
  public:
    explicit FilmWords(const FilmPart& part);

    size_t channels() const { return words_ + 1; }
    // Words of a row: words[c * width + x], the check last.
    void write_row(const FilmSums& sums, size_t first_pixel, uint32_t* words) const;
    // False where they are not what write_row wrote for this part.
    bool read_row(const uint32_t* words, FilmSums* sums, size_t first_pixel) const;

  private:
    size_t width_, words_;
    uint32_t batches_, fewest_;
    uint32_t salt_;
};

// Written atomically and synced. `part.fewest` must be that of the sums.
void write_partial(const std::string& path, const FilmPart& part, const FilmSums& sums,
                   const std::string& command_line);

class PartialReader {
  public:
    // Throws Error (user) where `path` is missing, a picture instead of sums, of another format,
    // or damaged.
    explicit PartialReader(const std::string& path);

    const FilmPart& part() const { return part_; }
    const std::string& path() const { return path_; }
    // Row y of the picture into the `width` pixels of `sums` from `first_pixel` on, replacing what
    // they held. Throws Error (user) where the file is damaged.
    void read_row(int y, FilmSums* sums, size_t first_pixel);

  private:
    std::string path_;
    ExrRowReader reader_;
    FilmPart part_;
    std::vector<uint32_t> words_;
};

}  // namespace drude
