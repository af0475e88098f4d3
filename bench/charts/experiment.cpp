#include "bench/charts/experiment.h"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace drude {

namespace {

struct Task {
    size_t method, setting;
    uint64_t seed;
};

// Not std::shuffle, whose order is the library's affair.
void shuffle(std::vector<Task>* tasks, uint64_t seed) {
    std::mt19937_64 random(seed);
    for (size_t i = tasks->size(); i > 1; --i) std::swap((*tasks)[i - 1], (*tasks)[random() % i]);
}

ChartPoint summary(const Setting& setting, const std::vector<Measured>& runs) {
    ChartPoint point;
    point.setting = setting.name;
    point.automatic = setting.automatic;
    std::vector<double> costs;
    const auto n = static_cast<double>(runs.size());
    for (const Measured& run : runs) {
        costs.push_back(run.cost);
        point.error += run.error;
    }
    point.error /= n;
    double squares = 0;
    for (const Measured& run : runs)
        squares += (run.error - point.error) * (run.error - point.error);
    if (runs.size() > 1) point.error_sigma = std::sqrt(squares / (n * (n - 1)));
    point.cost = median(std::move(costs));
    return point;
}

}  // namespace

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<ChartCurve> run_shuffled(const std::vector<Method>& methods, int seeds,
                                     uint64_t order_seed, const std::function<void()>& step) {
    std::vector<Task> tasks;
    std::vector<std::vector<std::vector<Measured>>> runs(methods.size());
    for (size_t m = 0; m < methods.size(); ++m) {
        runs[m].resize(methods[m].settings.size());
        for (size_t s = 0; s < methods[m].settings.size(); ++s) {
            for (int seed = 1; seed <= seeds; ++seed) {
                tasks.push_back({m, s, static_cast<uint64_t>(seed)});
            }
        }
    }
    shuffle(&tasks, order_seed);
    for (const Task& task : tasks) {
        const double begun = thread_seconds();
        Measured run = methods[task.method].settings[task.setting].run(task.seed);
        if (run.cost == 0) run.cost = thread_seconds() - begun;
        runs[task.method][task.setting].push_back(run);
        if (step) step();
    }
    std::vector<ChartCurve> curves;
    for (size_t m = 0; m < methods.size(); ++m) {
        ChartCurve curve{methods[m].name, {}};
        for (size_t s = 0; s < methods[m].settings.size(); ++s) {
            curve.points.push_back(summary(methods[m].settings[s], runs[m][s]));
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace drude
