// The channels of a finished picture, row by row from sums: where float32 rounding happens, once.
#pragma once

#include <vector>

#include "image/exr_rows.h"
#include "render/film_sums.h"

namespace drude {

// R, G, B; with `variance` the variances of these means; with four rows S0.R ... S3.B and theirs;
// "S0.384,500000nm" ... where the layout is spectral.
class FilmLayers {
  public:
    FilmLayers(const FilmLayout& layout, bool variance);

    const std::vector<ExrChannel>& channels() const { return channels_; }
    // The `width` pixels of `sums` from `first_pixel` on, as ExrRowSource wants them. A pixel
    // without a batch is black.
    void row(const FilmSums& sums, size_t first_pixel, uint32_t* words) const;

  private:
    enum class Kind { mean, variance, spectral };
    struct Layer {
        Kind kind;
        int row, index;  // component or bin
    };
    void add(std::string name, const Layer& layer);
    void add_colour(const std::string& prefix, int row, bool variance);

    FilmLayout layout_;
    std::vector<Layer> layers_;
    std::vector<ExrChannel> channels_;
};

}  // namespace drude
