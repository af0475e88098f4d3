#include "report/pair_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

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

// CIE 15:2018, section 8.2.1, of X, Y, Z over those of white.
std::array<double, 3> lab(const XYZ& relative) {
    const auto f = [](double t) {
        constexpr double edge = 6.0 / 29.0;
        return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0 / 29.0;
    };
    const double x = f(relative[0]), y = f(relative[1]), z = f(relative[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
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
    const double count = static_cast<double>(s.pixels);
    s.white = percentile(luminance, 0.99);
    const XYZ white = rgb_to_xyz({1, 1, 1});
    double total = 0, moved = 0;
    for (size_t j = 0; j < differing.size(); ++j) {
        const size_t i = differing[j];
        s.mean_absolute += std::pow(10.0, logs[i]) / count;
        XYZ x = rgb_to_xyz({a[0]->data[i], a[1]->data[i], a[2]->data[i]});
        XYZ y = rgb_to_xyz({b[0]->data[i], b[1]->data[i], b[2]->data[i]});
        total += y[1];
        moved += std::abs(x[1] - y[1]);
        if (!(s.white > 0)) continue;
        for (size_t c = 0; c < 3; ++c) {
            x[c] *= white[1] / (white[c] * s.white);
            y[c] *= white[1] / (white[c] * s.white);
        }
        const std::array<double, 3> p = lab(x), q = lab(y);
        const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        s.mean_delta_e += distance / count;
        s.noticeable += distance > 2.3 ? 1 / count : 0;
    }
    s.relative_luminance = total > 0 ? moved / total : 0;
    return s;
}

}  // namespace drude
