// Whether frames that were taken for a dark are one.
#pragma once

#include <cstddef>
#include <vector>

#include "device/sweep/journal.h"

namespace drude {

// Judges the frames of one dark, attempt after attempt.
class DarkCheck {
  public:
    // `others`: darks that were taken before; those at the same integration time are compared.
    DarkCheck(const SpectrometerInfo& spectrometer, const std::vector<JournalDark>& others,
              double integration_s);

    // Throws DeviceError (bad_frame), upon which the dark is to be taken again, where
    // - a pixel reads max_counts in a frame. At most 1 % of the pixels that did so in the attempt
    //   before, the same ones, are hot: such a dark is taken, and a reduction leaves them out;
    // - more than 1 % of the pixels read more than 5 % of max_counts above what they read in
    //   another frame of this dark, or in the others.
    // Frames have as many counts as the spectrometer has pixels; there is one or more.
    void check(const std::vector<Frame>& frames);
    // Hot pixels of the frames that passed.
    size_t hot() const { return saturated_.size(); }

  private:
    void compare(const Frame& frame, const Frame& other) const;

    const SpectrometerInfo& spectrometer_;
    const std::vector<JournalDark>& others_;
    double integration_s_;
    std::vector<size_t> saturated_;  // of the last attempt
};

}  // namespace drude
