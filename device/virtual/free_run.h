// When a free-running, double-buffered spectrometer exposes, and which exposure it hands out.
//
// The detector exposes without a pause. When an exposure ends and the buffer is free, it goes there
// and stays until it is read; exposures that end while the buffer is full are lost. So what is read
// first after a while was exposed right after the last reading, however long ago, and the next one
// may have begun before the first was asked for.
#pragma once

namespace drude {

class FreeRun {
  public:
    struct Exposure {
        double start_s = 0, integration_s = 0;
        double end_s() const { return start_s + integration_s; }
    };

    // Begins to expose at `now_s`.
    FreeRun(double now_s, double integration_s)
        : next_{now_s, integration_s}, later_{now_s, integration_s} {}

    // What the next hand_out() gives: it is read from its end on, or at once where that has passed.
    const Exposure& next() const { return next_; }
    // Takes effect for the exposures that begin after `now_s`.
    void set_integration(double now_s, double integration_s);
    double integration() const { return later_.integration_s; }
    // Takes next() from the buffer at `now_s` >= its end, so that the exposure which is running
    // then will be next.
    Exposure hand_out(double now_s);

    // Clearing the detector between two exposures.
    static constexpr double clearing_s = 20e-6;

  private:
    Exposure running_at(double now_s) const;

    Exposure next_;    // in the buffer, or on its way there
    Exposure later_;   // the first with the integration time that was set last
    Exposure before_;  // the one that ran until then, if there is one; otherwise of no length
};

}  // namespace drude
