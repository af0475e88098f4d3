// What `drude bench` can run, each item in a file of its own, listed in bench_items.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/charts/chart.h"
#include "bench/charts/stability.h"

namespace drude {

struct BenchOptions {
    bool quick = false;  // seconds instead of minutes: fewer settings, seeds and samples
    int seeds = 0;       // 0: the item's own number
    bool quiet = false;  // no progress
};

struct BenchTable {
    std::string id, caption;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

struct BenchResult {
    std::vector<Chart> charts;
    std::vector<StabilityMap> maps;
    std::vector<BenchTable> tables;
};

struct BenchItem {
    std::string name;     // "transport"
    std::string title;    // of its section in the page
    std::string summary;  // one line for --list
    std::function<BenchResult(const BenchOptions&)> run;
};

// In the order of the page.
const std::vector<BenchItem>& bench_items();

}  // namespace drude
