#include "device/sweep/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "device/signal/small_least_squares.h"

namespace drude {

namespace {

constexpr size_t classes = 48;
constexpr double rounding_variance = 1.0 / 12;

// Of equal width in the square root of the signal, whose photon noise is then the same everywhere.
class SignalClasses {
  public:
    explicit SignalClasses(double max_counts) : max_counts_(max_counts) {}

    void add(double net, double variance, double weight) {
        const double fraction = std::clamp(net / max_counts_, 0.0, 1.0);
        const size_t i =
            std::min(classes - 1, static_cast<size_t>(std::sqrt(fraction) * double{classes}));
        Class& c = all_[i];
        c.weight += weight;
        c.net += weight * net;
        c.square += weight * net * net;
        c.variance += weight * variance;
        ++readings_;
    }

    size_t readings() const { return readings_; }

    // The non-negative coefficients of 1, net and net^2 with the least weighted residual: with
    // three of them every set of those above zero can be tried.
    NoiseModel fit() const {
        std::array<double, 3> best{};
        double best_residual = -1;
        for (unsigned set = 1; set < 8; ++set) {
            const auto coefficients = solve(set);
            if (!coefficients) continue;
            const double residual = residual_of(*coefficients);
            if (best_residual >= 0 && residual >= best_residual) continue;
            best = *coefficients;
            best_residual = residual;
        }
        NoiseModel model;
        model.read = best[0];
        model.photon = best[1] / max_counts_;
        model.relative = best[2] / (max_counts_ * max_counts_);
        model.readings = readings_;
        return model;
    }

  private:
    struct Class {
        double weight = 0, net = 0, square = 0, variance = 0;
    };

    std::array<double, 3> powers(const Class& c) const {
        return {1, c.net / c.weight / max_counts_,
                c.square / c.weight / (max_counts_ * max_counts_)};
    }
    static double target(const Class& c) {
        return std::max(c.variance / c.weight, rounding_variance);
    }
    // The variance of a mean of n squares is about 2 v^2 / n.
    static double weight(const Class& c) { return c.weight / (target(c) * target(c)); }

    double residual_of(const std::array<double, 3>& x) const {
        double sum = 0;
        for (const Class& c : all_) {
            if (!(c.weight > 0)) continue;
            const auto p = powers(c);
            const double miss = target(c) - x[0] * p[0] - x[1] * p[1] - x[2] * p[2];
            sum += weight(c) * miss * miss;
        }
        return sum;
    }

    // Normal equations of the coefficients in `set`; nothing where they are singular or a
    // coefficient is negative.
    std::optional<std::array<double, 3>> solve(unsigned set) const {
        std::array<size_t, 3> column{};
        size_t n = 0;
        for (size_t i = 0; i < 3; ++i) {
            if (set >> i & 1U) column[n++] = i;
        }
        std::array<double, 9> matrix{};
        std::array<double, 3> right{};
        for (const Class& c : all_) {
            if (!(c.weight > 0)) continue;
            const auto p = powers(c);
            for (size_t i = 0; i < n; ++i) {
                for (size_t j = 0; j < n; ++j) {
                    matrix[i * n + j] += weight(c) * p[column[i]] * p[column[j]];
                }
                right[i] += weight(c) * p[column[i]] * target(c);
            }
        }
        if (!solve_normal_equations(static_cast<int>(n), matrix.data(), right.data())) return {};
        std::array<double, 3> x{};
        for (size_t i = 0; i < n; ++i) {
            if (!(right[i] >= 0)) return {};
            x[column[i]] = right[i];
        }
        return x;
    }

    double max_counts_;
    size_t readings_ = 0;
    std::array<Class, classes> all_{};
};

// Over frames, of every pixel; frame by frame, since that is how they lie in memory.
struct Scatter {
    std::vector<double> mean, variance;
    std::vector<uint32_t> largest;
};

Scatter scatter(const std::vector<Frame>& frames) {
    const size_t pixels = frames.front().counts.size();
    const auto n = static_cast<double>(frames.size());
    Scatter s{std::vector<double>(pixels), std::vector<double>(pixels),
              std::vector<uint32_t>(pixels)};
    for (const Frame& frame : frames) {
        for (size_t i = 0; i < pixels; ++i) {
            s.mean[i] += frame.counts[i] / n;
            s.largest[i] = std::max(s.largest[i], frame.counts[i]);
        }
    }
    for (const Frame& frame : frames) {
        for (size_t i = 0; i < pixels; ++i) {
            const double miss = frame.counts[i] - s.mean[i];
            s.variance[i] += miss * miss / std::max(1.0, n - 1);
        }
    }
    return s;
}

void add_frames(const std::vector<Frame>& frames, const std::vector<double>& dark,
                uint32_t max_counts, SignalClasses* all) {
    if (frames.size() < 2) return;
    const Scatter s = scatter(frames);
    for (size_t i = 0; i < dark.size(); ++i) {
        if (s.largest[i] >= max_counts) continue;
        all->add(s.mean[i] - dark[i], s.variance[i], static_cast<double>(frames.size() - 1));
    }
}

void add_half_turn(const JournalPoint& a, const JournalPoint& b, const std::vector<double>& dark,
                   uint32_t max_counts, SignalClasses* all) {
    const auto& x = a.frames.front().counts;
    const auto& y = b.frames.front().counts;
    for (size_t i = 0; i + 1 < dark.size(); ++i) {
        if (std::max({x[i], y[i], x[i + 1], y[i + 1]}) >= max_counts) continue;
        const double here = 1.0 * x[i] - y[i], there = 1.0 * x[i + 1] - y[i + 1];
        const double net = (1.0 * x[i] + y[i]) / 2 - dark[i];
        // Two differences of two readings: four times the variance of one.
        all->add(net, (here - there) * (here - there) / 4, 1);
    }
}

// Of the blocks whose points `wanted` takes: all points of a block are of one group.
template <class Wanted>
NoiseModel fit(const Journal& journal, Wanted wanted) {
    const uint32_t max_counts = journal.header->spectrometer.max_counts;
    SignalClasses all(max_counts);
    std::set<uint32_t> blocks;
    for (const PlanPoint& point : journal.plan) {
        if (wanted(point)) blocks.insert(point.block);
    }
    std::map<uint32_t, std::vector<double>> darks;
    for (const JournalDark& dark : journal.darks) {
        if (blocks.count(dark.block) == 0) continue;
        Scatter s = scatter(dark.frames);
        for (size_t i = 0; i < s.mean.size() && dark.frames.size() > 1; ++i) {
            if (s.largest[i] >= max_counts) continue;
            all.add(0, s.variance[i], static_cast<double>(dark.frames.size() - 1));
        }
        darks.emplace(dark.block, std::move(s.mean));
    }
    const size_t dark_readings = all.readings();
    std::map<std::pair<uint32_t, double>, const JournalPoint*> single;
    for (const JournalPoint& point : journal.points) {
        const PlanPoint& plan = journal.plan[point.index];
        const auto dark = darks.find(plan.block);
        if (dark == darks.end()) continue;
        add_frames(point.frames, dark->second, max_counts, &all);
        if (point.frames.size() > 1) continue;
        const double half_turn =
            plan.polariser_deg >= 180 ? plan.polariser_deg - 180 : plan.polariser_deg + 180;
        const auto other = single.find({plan.scan, half_turn});
        if (other != single.end()) {
            add_half_turn(point, *other->second, dark->second, max_counts, &all);
        }
        single[{plan.scan, plan.polariser_deg}] = &point;
    }
    NoiseModel model = all.fit();
    model.light_readings = all.readings() - dark_readings;
    return model;
}

}  // namespace

double NoiseModel::variance(double net_counts) const {
    const double net = std::max(0.0, net_counts);
    return std::max(rounding_variance, read + photon * net + relative * net * net);
}

NoiseModel fit_noise_model(const Journal& journal) {
    return fit(journal, [](const PlanPoint&) { return true; });
}

NoiseModel fit_noise_model(const Journal& journal, uint32_t group) {
    return fit(journal, [&](const PlanPoint& point) { return point.group == group; });
}

}  // namespace drude
