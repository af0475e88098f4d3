#include "device/signal/lamp_drift.h"

#include <algorithm>

#include "device/signal/small_least_squares.h"

namespace drude {

namespace {

constexpr int fewest_for_a_parabola = 30;

}  // namespace

LampDrift::LampDrift(const std::vector<double>& wavelength_nm, std::vector<BeamRatio> readings) {
    if (wavelength_nm.empty()) return;
    const auto [least, most] = std::minmax_element(wavelength_nm.begin(), wavelength_nm.end());
    const double middle = (*least + *most) / 2, half = std::max((*most - *least) / 2, 1e-12);
    for (const double nm : wavelength_nm) x_.push_back((nm - middle) / half);
    if (readings.size() < 2) return;
    std::sort(readings.begin(), readings.end(),
              [](const BeamRatio& a, const BeamRatio& b) { return a.time_s < b.time_s; });
    for (const BeamRatio& reading : readings) {
        const auto used = std::count_if(reading.weight.begin(), reading.weight.end(),
                                        [](double weight) { return weight > 0; });
        if (used == 0) continue;
        const int n = used < fewest_for_a_parabola ? 1 : 3;
        double moments[9] = {}, solution[3] = {};
        for (size_t j = 0; j < x_.size(); ++j) {
            if (!(reading.weight[j] > 0)) continue;
            const double power[3] = {1, x_[j], x_[j] * x_[j]};
            for (int a = 0; a < n; ++a) {
                for (int b = 0; b < n; ++b) {
                    moments[a * n + b] += reading.weight[j] * power[a] * power[b];
                }
                solution[a] += reading.weight[j] * power[a] * reading.ratio[j];
            }
        }
        if (!solve_normal_equations(n, moments, solution)) continue;
        nodes_.push_back({reading.time_s, {solution[0], solution[1], solution[2]}});
    }
}

std::vector<double> LampDrift::at(double time_s) const {
    std::vector<double> factor(x_.size(), 1);
    if (nodes_.empty()) return factor;
    const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), time_s,
                                        [](double t, const Node& node) { return t < node.time_s; });
    const Node& high = after == nodes_.end() ? nodes_.back() : *after;
    const Node& low = after == nodes_.begin() ? nodes_.front() : *(after - 1);
    const double span = high.time_s - low.time_s;
    const double share = span > 0 ? (time_s - low.time_s) / span : 0;
    std::array<double, 3> c{};
    for (size_t i = 0; i < 3; ++i) {
        c[i] = low.coefficient[i] + share * (high.coefficient[i] - low.coefficient[i]);
    }
    for (size_t j = 0; j < x_.size(); ++j) factor[j] = c[0] + x_[j] * (c[1] + x_[j] * c[2]);
    return factor;
}

double LampDrift::largest_change() const {
    if (nodes_.empty()) return 0;
    const auto [least, most] = std::minmax_element(
        nodes_.begin(), nodes_.end(),
        [](const Node& a, const Node& b) { return a.coefficient[0] < b.coefficient[0]; });
    return most->coefficient[0] / least->coefficient[0] - 1;
}

}  // namespace drude
