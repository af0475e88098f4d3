#include "report/plot_scale.h"

#include <algorithm>
#include <optional>

namespace drude {

Scale make_scale(const Axis& axis, Extent extent, double padding) {
    const auto usable = [&](const std::optional<double>& end) {
        return end && std::isfinite(*end) && (!axis.logarithmic || *end > 0);
    };
    const bool fixed_low = usable(axis.low), fixed_high = usable(axis.high);
    if (extent.empty()) extent = {axis.logarithmic ? 1.0 : 0.0, axis.logarithmic ? 10.0 : 1.0};
    constexpr double widest = 1e300;
    double low = std::clamp(fixed_low ? *axis.low : extent.low, -widest, widest);
    double high = std::clamp(fixed_high ? *axis.high : extent.high, -widest, widest);
    if (axis.logarithmic) low = std::log10(low), high = std::log10(high);
    if (!(low < high)) {  // one value, or ends the wrong way round
        const double middle = 0.5 * (low + high);
        const double room = axis.logarithmic ? 0.5 : std::max(0.05 * std::abs(middle), 1e-3);
        low = middle - room;
        high = middle + room;
    } else {
        const double room = padding * (high - low);
        if (!fixed_low) low -= room;
        if (!fixed_high) high += room;
    }
    return {axis.logarithmic, low, high, 0, 1};
}

std::vector<Tick> ticks_of(const Scale& scale, int most) {
    if (!scale.logarithmic) return linear_ticks(scale.low, scale.high, most);
    return log_ticks(std::pow(10, scale.low), std::pow(10, scale.high), most);
}

}  // namespace drude
