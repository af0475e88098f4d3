// The page of a bench, and its files.
#pragma once

#include <string>
#include <vector>

#include "bench/charts/bench_item.h"

namespace drude {

struct BenchSection {
    std::string name, title, summary;
    BenchResult result;
    double seconds = 0;  // that it took
};

// A self-contained HTML document: machine, charts, maps with their verdicts, tables.
std::string bench_page(const std::vector<BenchSection>& sections);

// Writes ID.csv and ID.svg of every chart and map, ID.csv of every table, into `folder`, which is
// made; the names of the files. Errors as write_file.
std::vector<std::string> write_bench_files(const std::string& folder, const BenchResult& result);

}  // namespace drude
