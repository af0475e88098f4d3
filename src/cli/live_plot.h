// The last scan of a sweep as text, redrawn in place above the progress bar.
#pragma once

#include <string>
#include <vector>

#include "device/sweep/journal.h"

namespace drude {

// The points (x, y) as '*' in a frame of `width` by `height` characters, y from 0 to its largest.
// At least one point; height + 1 lines, the title first, that end in a line break.
std::string text_plot(const std::vector<double>& x, const std::vector<double>& y,
                      const std::string& title, size_t width, size_t height);

// As much of `text` as a terminal of so many columns and lines shows without breaking a line or
// scrolling: lines are cut at their ends, and of the lines after the first `fixed` ones those that
// came first are left out.
std::string fitted(const std::string& text, size_t columns, size_t lines, size_t fixed);

class LivePlot {
  public:
    // Draws where stderr is a terminal (base/progress.h); otherwise nothing.
    explicit LivePlot(bool quiet);
    // The mean of all pixels against the polariser's azimuth, of the last scan. Angles of incidence
    // that are complete are reduced without calibration, and Psi and Delta at the middle of the
    // spectrum shown beneath.
    void draw(const Journal& so_far);
    // Something else was printed below the picture: the next one does not go over it.
    void begin_anew() { lines_ = 0; }

  private:
    bool draws_;
    size_t lines_ = 0;  // drawn last
    std::vector<std::string> finished_;
};

}  // namespace drude
