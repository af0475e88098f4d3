// Runs what a chart compares: every method at every setting with several seeds, in shuffled order,
// so that a machine that slows down for a while slows down all of them alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/charts/chart.h"

namespace drude {

struct Measured {
    double cost = 0;  // where 0, the processor time of the call is taken (s, this thread)
    double error = 0;
};

struct Setting {
    std::string name;
    std::function<Measured(uint64_t seed)> run;
    bool automatic = false;
};

struct Method {
    std::string name;
    std::vector<Setting> settings;
};

// Processor time of the calling thread in seconds, since some moment.
double thread_seconds();

// Median; NaN of nothing.
double median(std::vector<double> values);

// One curve a method: medians of the costs, means and their standard deviations of the errors over
// seeds 1 ... `seeds`. The order is drawn from `order_seed`; `step` is called after each run.
std::vector<ChartCurve> run_shuffled(const std::vector<Method>& methods, int seeds,
                                     uint64_t order_seed = 1,
                                     const std::function<void()>& step = {});

}  // namespace drude
