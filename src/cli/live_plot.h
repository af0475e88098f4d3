// The last scan of a sweep as text, redrawn in place above the progress bar.
#pragma once

#include <string>
#include <vector>

#include "device/sweep/journal.h"

namespace drude {

// Columns of `width` characters under each other: the points (x, y) as '*' in a frame, y from 0 to
// its largest. At least one point; lines end in a line break.
std::string text_plot(const std::vector<double>& x, const std::vector<double>& y,
                      const std::string& title, size_t width, size_t height);

class LivePlot {
  public:
    // Draws where stderr is a terminal; otherwise nothing.
    explicit LivePlot(bool quiet);
    // The mean of the brightest half of the spectrum against the polariser's azimuth, of the last
    // scan. Angles of incidence that are complete are reduced without calibration, and Psi and
    // Delta at the middle of the spectrum shown beneath.
    void draw(const Journal& so_far);

  private:
    bool draws_;
    size_t lines_ = 0;  // drawn last
    std::vector<std::string> finished_;
    uint32_t shown_blocks_ = 0;
};

}  // namespace drude
