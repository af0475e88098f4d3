// In which steps a picture gets its batches, and when it has enough of them.
//
// A step ends with as many batches in every pixel. Where a picture ends at a count, or at an error
// that the batches themselves tell, the steps are the same in every run, so that its bits are too.
#pragma once

#include <cstdint>
#include <optional>

#include "render/film_sums.h"

namespace drude {

// The first of these that is reached; at least one batch a pixel.
struct StopRule {
    uint32_t most = 1;              // batches a pixel
    std::optional<double> seconds;  // of rendering, in all runs together
    std::optional<double> error;    // as relative_error()
};

class FilmSchedule {
  public:
    explicit FilmSchedule(const StopRule& rule) : rule_(rule) {}

    // The batches a pixel to go on to when every pixel holds `done` after `seconds`; `done` itself
    // where there is no time for more, or no more is wanted.
    uint32_t next(uint32_t done, double seconds) const;

    // Whether the error is looked at when every pixel holds `done`: at 4, 5, 6, 7, 8, 9, ... and
    // then every eighth more, so that a picture has at most an eighth too much.
    static bool is_look(uint32_t done);
    static uint32_t next_look(uint32_t done);

  private:
    StopRule rule_;
};

// The relative error of a picture as its own variances tell it: the root of the mean over the
// pixels of
//     (variance of R + of G + of B) / (R^2 + G^2 + B^2 + (m/10)^2),
// m the mean over the pixels of the root of R^2 + G^2 + B^2, which keeps black pixels from deciding
// alone; 0 for a black picture. Every pixel must hold two batches at least.
double relative_error(const FilmSums& sums);

}  // namespace drude
