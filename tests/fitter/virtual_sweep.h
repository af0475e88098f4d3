// A sweep over a virtual bench from the recipe to the reduction, with its journal on the disk.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "device/sweep/journal_reduction.h"
#include "device/sweep/sweep.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

class NobodyIsAsked : public Operator {
  public:
    void ask(const std::string& request) override { ADD_FAILURE() << request; }
};

inline JournalReduction sweep_and_reduce(const Material& metal,
                                         const VirtualBenchSettings& settings,
                                         const Recipe& recipe) {
    const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    const std::filesystem::path journal =
        std::filesystem::path(testing::TempDir()) / (name + ".journal");
    std::filesystem::remove(journal);
    Bench bench = make_virtual_bench(metal, settings);
    NobodyIsAsked nobody;
    SweepOptions options;
    options.journal = journal.string();
    const SweepOutcome outcome = run_sweep(bench, recipe, nobody, options);
    EXPECT_EQ(outcome.retries, 0u);
    JournalReductionOptions reduction;
    reduction.calibration = true_calibration(settings);
    JournalReduction result = reduce_journal(outcome.journal, reduction);
    std::filesystem::remove(journal);
    return result;
}

}  // namespace drude
