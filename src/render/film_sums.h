// What a film adds up, batch by batch: exact sums of every pixel, and of their squares.
//
// A picture that was rendered in one go, in shards, or in a run that was killed and resumed holds
// the same batches in another order of adding; these sums are equal in all three, bit by bit.
// Memory is 77 bytes a pixel for R, G, B and their squares, 296 with S0 to S3, and 520 more for
// each of the rows with spectral layers, whatever the number of samples.
#pragma once

#include <cstdint>
#include <vector>

#include "render/exact_sum.h"

namespace drude {

struct BatchResult;

struct FilmLayout {
    int width = 0, height = 0;
    int rows = 1;           // 4 with S0 to S3
    bool spectral = false;  // sums of every 10 nm bin too

    size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    // 32-bit words that hold one pixel in a file.
    size_t words() const;
    bool operator==(const FilmLayout&) const = default;
};

class FilmSums {
  public:
    // All zero.
    explicit FilmSums(const FilmLayout& layout);

    const FilmLayout& layout() const { return layout_; }

    // `pixel` counts row by row from the top. A batch that holds a value that is no number or
    // beyond 2^127 (1.7e38) counts as black; false then, so that it can be counted. Different
    // pixels may be added to from different threads. At most most_terms batches a pixel.
    bool add(size_t pixel, const BatchResult& batch);
    // Adds a pixel of sums of the same rows and bins: as if its batches had been added one by one.
    // False, with nothing added, where that would be more than most_terms.
    bool add(size_t pixel, const FilmSums& other, size_t other_pixel);

    uint32_t batches(size_t pixel) const { return batches_[pixel]; }
    uint32_t fewest_batches() const;
    uint32_t most_batches() const;

    // Over the batches: sums of linear sRGB component c of S`row`, and of its squares.
    double sum(size_t pixel, int row, int c) const;
    double sum_of_squares(size_t pixel, int row, int c) const;
    double spectral_sum(size_t pixel, int row, int bin) const;

    // The mean over the batches, and the variance of that mean between them (0 where there are
    // fewer than two batches). A spread between batches below 2e-5 of their values is at the limit
    // of what the sums resolve.
    double mean(size_t pixel, int row, int c) const;
    double variance(size_t pixel, int row, int c) const;
    double spectral_mean(size_t pixel, int row, int bin) const;

    // The pixel as layout().words() words, and back; equal sums have equal words. from_words is
    // false, and the pixel undefined, for words that no sums have.
    void to_words(size_t pixel, uint32_t* words) const;
    bool from_words(size_t pixel, const uint32_t* words);

  private:
    // A level is stored as a byte, 0 while all terms were zero.
    static int level_of(uint8_t stored) { return stored + lowest_level - 1; }

    int32_t* rgb_digits(size_t pixel, int row, int c);
    const int32_t* rgb_digits(size_t pixel, int row, int c) const;
    void raise_rgb(size_t pixel, int row, uint8_t level);
    void raise_spectral(size_t at, uint8_t level);

    FilmLayout layout_;
    std::vector<uint32_t> batches_;  // [pixel]
    // R, G and B of a row share one window: they come from the same float sums, and a component
    // that is small beside another one is no more exact than this itself.
    std::vector<uint8_t> rgb_levels_;       // [pixel][row]
    std::vector<int32_t> rgb_;              // [pixel][row][c][sum, squares][digit]
    std::vector<uint8_t> spectral_levels_;  // [pixel][row][bin]
    std::vector<int32_t> spectral_;         // [pixel][row][bin][digit]
};

}  // namespace drude
