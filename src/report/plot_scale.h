// From values to positions along an axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/svg_plot.h"
#include "report/ticks.h"

namespace drude {

// Maps a value to a position; NaN where the axis cannot show it.
struct Scale {
    bool logarithmic = false;
    double low = 0, high = 1;    // of the axis, log10 where logarithmic
    double start = 0, stop = 1;  // positions of low and high

    double operator()(double value) const {
        if (logarithmic) value = value > 0 ? std::log10(value) : std::nan("");
        if (!std::isfinite(value)) return std::nan("");
        // Far outside the frame a position is as good as any other, and drawing programs overflow.
        const double t = std::clamp((value - low) / (high - low), -10.0, 11.0);
        return start + t * (stop - start);
    }
};

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void include(double value, bool logarithmic) {
        if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return !(low <= high); }
};

// The axis's own ends where they are given and usable, those of the data, widened by the share
// `padding` of their distance, otherwise; never empty. Positions are 0 and 1.
Scale make_scale(const Axis& axis, Extent extent, double padding);

// At most about `most` labelled ticks.
std::vector<Tick> ticks_of(const Scale& scale, int most);

}  // namespace drude
