#include "fitter/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/executor.h"
#include "fitter/fit_data.h"
#include "fitter/model_curve.h"
#include "materials/measurement_noise.h"

namespace drude {

namespace {

// Keeps the deviates apart from those of a simulated measurement of the same seed.
constexpr uint64_t stream = 0x626f6f74;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

// NaN in `values` stands for a draw that did not determine the value.
Scatter scatter_of(std::vector<double> values) {
    values.erase(
        std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
        values.end());
    Scatter scatter;
    scatter.draws = static_cast<int>(values.size());
    scatter.mean = scatter.sigma = not_known;
    scatter.quantiles.fill(not_known);
    if (values.size() < 2) return scatter;
    std::sort(values.begin(), values.end());
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    scatter.mean = sum / static_cast<double>(values.size());
    for (const double value : values) squares += (value - scatter.mean) * (value - scatter.mean);
    scatter.sigma = std::sqrt(squares / static_cast<double>(values.size() - 1));
    for (size_t q = 0; q < scatter.quantiles.size(); ++q) {
        const double at = bootstrap_quantiles[q] * static_cast<double>(values.size() - 1);
        const size_t below = std::min(static_cast<size_t>(at), values.size() - 2);
        const double share = at - static_cast<double>(below);
        scatter.quantiles[q] = values[below] + share * (values[below + 1] - values[below]);
    }
    return scatter;
}

// The values of one draw, in the order: common parameters, then n and k of every wavelength.
class Draws {
  public:
    Draws(const FitResult& fit, int draws) : draws_(static_cast<size_t>(draws)) {
        for (const FittedPoint& point : fit.points) {
            if (point.identifiable) wavelengths_.push_back(point.wavelength_nm);
        }
        common_ = fit.common.size();
        values_.assign((common_ + 2 * wavelengths_.size()) * draws_, not_known);
    }

    const std::vector<double>& wavelengths() const { return wavelengths_; }

    void set(size_t draw, const FitResult& fit) {
        for (size_t i = 0; i < std::min(common_, fit.common.size()); ++i) {
            if (fit.common[i].identifiable) value(i, draw) = fit.common[i].value;
        }
        size_t at = 0;
        for (const FittedPoint& point : fit.points) {
            while (at < wavelengths_.size() && wavelengths_[at] < point.wavelength_nm) ++at;
            if (at == wavelengths_.size()) break;
            if (wavelengths_[at] != point.wavelength_nm || !point.identifiable) continue;
            value(common_ + 2 * at, draw) = point.n;
            value(common_ + 2 * at + 1, draw) = point.k;
        }
    }

    Scatter scatter(size_t parameter) const {
        const auto first = values_.begin() + static_cast<std::ptrdiff_t>(parameter * draws_);
        return scatter_of({first, first + static_cast<std::ptrdiff_t>(draws_)});
    }

  private:
    double& value(size_t parameter, size_t draw) { return values_[parameter * draws_ + draw]; }

    size_t draws_, common_ = 0;
    std::vector<double> wavelengths_, values_;
};

void check(const BootstrapOptions& how, const FitResult& fit) {
    if (how.draws < 20 || how.draws > 1'000'000) {
        user_error("found a bootstrap of {} draws, expected 20 to 1000000", how.draws);
    }
    if (static_cast<double>(how.draws) * static_cast<double>(fit.points.size()) > 2e7) {
        user_error("found a bootstrap of {} draws of {} wavelengths, expected at most 2e7 together",
                   how.draws, fit.points.size());
    }
}

}  // namespace

BootstrapResult bootstrap(const Measurement& measurement, const FitOptions& options,
                          const FitResult& fit, const BootstrapOptions& how) {
    check(how, fit);
    FitOptions again = options_taken(options, fit);
    again.threads = 1;  // the draws are what runs in parallel
    again.weights.clear();
    const Measurement model = model_curve(fit, measurement);
    const double scale = std::sqrt(noise_variance(fit, options));
    std::vector<double> sigma_psi_deg, sigma_delta_deg;
    for (const MeasurementRow& row : model.rows) {
        const AnglePoint point = angle_point(row, options);
        sigma_psi_deg.push_back(point.sigma_psi * 180 / pi * scale);
        sigma_delta_deg.push_back(point.sigma_delta * 180 / pi * scale);
    }

    Draws draws(fit, how.draws);
    std::vector<char> failed(static_cast<size_t>(how.draws), 0);
    parallel_for(static_cast<size_t>(how.draws), options.threads, [&](size_t draw) {
        Measurement drawn = model;
        for (size_t i = 0; i < drawn.rows.size(); ++i) {
            const auto noise = normal_pair(how.seed, draw * drawn.rows.size() + i, stream);
            add_noise(&drawn.rows[i], sigma_psi_deg[i] * noise[0], sigma_delta_deg[i] * noise[1]);
        }
        try {
            draws.set(draw, fit_measurement(drawn, again));
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
            failed[draw] = 1;
        }
    });

    BootstrapResult result;
    result.draws = how.draws;
    result.failures = static_cast<int>(std::count(failed.begin(), failed.end(), 1));
    result.seed = how.seed;
    const size_t common = fit.common.size(), points = draws.wavelengths().size();
    std::vector<Scatter> scatters(common + 2 * points);
    parallel_for(scatters.size(), options.threads,
                 [&](size_t i) { scatters[i] = draws.scatter(i); });
    result.common.assign(scatters.begin(), scatters.begin() + static_cast<std::ptrdiff_t>(common));
    for (size_t i = 0; i < points; ++i) {
        result.points.push_back(
            {draws.wavelengths()[i], scatters[common + 2 * i], scatters[common + 2 * i + 1]});
    }
    return result;
}

}  // namespace drude
