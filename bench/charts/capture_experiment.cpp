#include "bench/charts/capture_experiment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "device/signal/wavelength_bins.h"
#include "device/sweep/journal_reduction.h"
#include "device/sweep/sweep.h"
#include "device/virtual/virtual_bench.h"
#include "materials/surface.h"

namespace drude {

namespace {

class FolderOnTheWay {
  public:
    FolderOnTheWay() {
        std::string name = (std::filesystem::temp_directory_path() / "drude-bench-XXXXXX").string();
        if (!mkdtemp(name.data())) outside_error("{}: no folder can be made there", name);
        path_ = name;
    }
    ~FolderOnTheWay() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    FolderOnTheWay(const FolderOnTheWay&) = delete;
    FolderOnTheWay& operator=(const FolderOnTheWay&) = delete;
    std::string file(const char* name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

// The virtual bench moves all its parts by itself.
class Nobody : public Operator {
  public:
    void ask(const std::string& request) override { user_error("asked to {}", request); }
};

struct Angles {
    double psi_deg = 0, delta_deg = 0;
};

// As the bin of a row reads them: its parabola through the pixels' Psi and Delta, which bare metals
// have within 0 to 180 degrees. Tables with kinks do not have the value of their centre there.
Angles true_angles(const Material& metal, const std::vector<double>& pixels_nm,
                   const MeasurementRow& row, double bin_nm) {
    const std::vector<double> all(pixels_nm.size(), 1.0);
    const BinShares bin = bin_shares(pixels_nm, all, row.wavelength_nm, bin_nm);
    Angles sum;
    for (size_t j = 0; j < bin.pixel.size(); ++j) {
        const Reflection<double> r =
            reflect(metal, pixels_nm[bin.pixel[j]], std::cos(row.angle_deg * degree));
        sum.psi_deg += bin.share[j] * psi(r) / degree;
        sum.delta_deg += bin.share[j] * delta(r) / degree;
    }
    return sum;
}

}  // namespace

CaptureOutcome capture_outcome(const std::string& set, const VirtualBenchSettings& settings,
                               const Recipe& recipe) {
    const Material metal = material_from_set(published_set(set));
    const FolderOnTheWay folder;
    Bench bench = make_virtual_bench(metal, settings);
    Nobody nobody;
    SweepOptions options;
    options.journal = folder.file("sweep.journal");
    const SweepOutcome sweep = run_sweep(bench, recipe, nobody, options);
    JournalReductionOptions reduction_options;
    reduction_options.calibration = true_calibration(settings);
    const Reduction reduction = reduce_journal(sweep.journal, reduction_options).reduction;

    CaptureOutcome outcome;
    outcome.seconds = sweep.journal.times.total;
    outcome.moving_s = sweep.journal.times.motion;
    outcome.integrating_s = sweep.journal.times.integration;
    outcome.rows = reduction.rows.size();
    const std::vector<double> pixels_nm = VirtualOptics(metal, settings).wavelengths_nm();
    const double share = 1 / static_cast<double>(outcome.rows);
    const auto with_common = [&](double sigma, const std::vector<double>& common, double angle) {
        const auto at = std::find(reduction.angles_deg.begin(), reduction.angles_deg.end(), angle);
        return std::hypot(sigma, common[static_cast<size_t>(at - reduction.angles_deg.begin())]);
    };
    for (const MeasurementRow& row : reduction.rows) {
        const double sigma_psi =
            with_common(row.sigma_psi_deg, reduction.common_sigma_psi_deg, row.angle_deg);
        const double sigma_delta =
            with_common(row.sigma_delta_deg, reduction.common_sigma_delta_deg, row.angle_deg);
        const Angles truth = true_angles(metal, pixels_nm, row, recipe.step_nm);
        const double psi_error = row.psi_deg - truth.psi_deg;
        const double delta_error = std::remainder(row.delta_deg - truth.delta_deg, 360.0);
        outcome.psi_error_deg += share * psi_error * psi_error;
        outcome.delta_error_deg += share * delta_error * delta_error;
        outcome.psi_pull += share * std::pow(psi_error / sigma_psi, 2);
        outcome.delta_pull += share * std::pow(delta_error / sigma_delta, 2);
    }
    for (double* sum : {&outcome.psi_error_deg, &outcome.delta_error_deg, &outcome.psi_pull,
                        &outcome.delta_pull}) {
        *sum = std::sqrt(*sum);
    }
    return outcome;
}

}  // namespace drude
