#include "report/pair_statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/delta_e.h"
#include "image/difference.h"
#include "materials/spectrum.h"

namespace drude {

namespace {

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

Log10Difference summary(const std::vector<double>& differences) {
    Log10Difference s;
    if (differences.empty()) return s;
    for (const double d : differences) s.mean += d / static_cast<double>(differences.size());
    s.p50 = percentile(differences, 0.5);
    s.p99 = percentile(differences, 0.99);
    s.max = percentile(differences, 1);
    return s;
}

}  // namespace

PairStatistics pair_statistics(const Image& fitted, const Image& literature) {
    const std::vector<double> logs = log_difference(fitted, literature, {"R", "G", "B"});
    const Channel* a[3];
    const Channel* b[3];
    for (size_t c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        a[c] = &fitted.at(name, "the fitted picture");
        b[c] = &literature.at(name, "the literature's picture");
    }
    std::vector<size_t> differing;
    std::vector<double> finite, luminance;
    for (size_t i = 0; i < logs.size(); ++i) {
        if (!std::isfinite(logs[i])) continue;
        differing.push_back(i);
        finite.push_back(logs[i]);
        luminance.push_back(rgb_to_xyz({b[0]->data[i], b[1]->data[i], b[2]->data[i]})[1]);
    }
    PairStatistics s;
    s.log10 = summary(finite);
    s.pixels = differing.size();
    if (differing.empty()) return s;
    const auto count = static_cast<double>(s.pixels);
    s.white = percentile(luminance, 0.99);
    double total = 0, moved = 0;
    for (const size_t i : differing) {
        s.mean_absolute += std::pow(10.0, logs[i]) / count;
        const RGB x = {a[0]->data[i], a[1]->data[i], a[2]->data[i]};
        const RGB y = {b[0]->data[i], b[1]->data[i], b[2]->data[i]};
        const double x_luminance = rgb_to_xyz(x)[1], y_luminance = rgb_to_xyz(y)[1];
        total += y_luminance;
        moved += std::abs(x_luminance - y_luminance);
        if (!(s.white > 0)) continue;
        const double distance = delta_e_1976(cielab_of_rgb(x, s.white), cielab_of_rgb(y, s.white));
        s.mean_delta_e += distance / count;
        s.noticeable += distance > 2.3 ? 1 / count : 0;
    }
    s.relative_luminance = total > 0 ? moved / total : 0;
    return s;
}

}  // namespace drude
