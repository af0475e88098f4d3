#include "fitter/robust_fit.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/error.h"
#include "fitter/robust_choice.h"
#include "fitter/row_residuals.h"

namespace drude {

namespace {

// A row of no weight at all would have no standard deviation.
constexpr double smallest_weight = 1e-8;
constexpr int most_rounds = 200;

std::unique_ptr<ceres::LossFunction> make_loss(const std::string& name) {
    const double constant = robust_constant(name);
    if (name == "huber") return std::make_unique<ceres::HuberLoss>(constant);
    if (name == "cauchy") return std::make_unique<ceres::CauchyLoss>(constant);
    return std::make_unique<ceres::TukeyLoss>(constant);
}

void check(const FitOptions& options) {
    const auto& names = robust_names();
    if (std::find(names.begin(), names.end(), options.robust) == names.end()) {
        user_error("found the robust loss '{}'{}, expected {}", options.robust,
                   did_you_mean(options.robust, names), fmt::join(names, ", "));
    }
    if (options.estimator == "inversion") {
        user_error(
            "the estimator inversion averages closed forms and minimises nothing; expected "
            "psi-delta or rho2 with the robust loss {}",
            options.robust);
    }
    if (options.model == "auto") {
        user_error(
            "the model auto compares chi-squares, which a robust loss does not minimise: name "
            "a model, or leave the loss {} out",
            options.robust);
    }
    if (options.unweighted) {
        user_error(
            "a robust loss measures distances in standard deviations: the fit cannot be "
            "unweighted and have the loss {}",
            options.robust);
    }
}

// Fits again and again with the weights that the last fit's residuals ask for.
class Reweighting {
  public:
    Reweighting(const Measurement& measurement, const FitOptions& options)
        : measurement_(measurement), plain_(options) {
        plain_.robust = "none";
        if (plain_.weights.empty()) plain_.weights.assign(measurement.rows.size(), 1);
        given_ = plain_.weights;
        fit();
    }

    // Until no row's residuals are scaled by more than `tolerance` otherwise; false where `rounds`
    // do not get there.
    bool run(const ceres::LossFunction& loss, double tolerance, int rounds) {
        for (int round = 0; round < rounds; ++round) {
            const double change = reweigh(loss);
            if (change < tolerance) return true;
            fit();
        }
        return false;
    }

    // Where wavelengths are fitted one by one, a bad row at an angle that carries most of what is
    // known pulls any convex loss along. Each angle is left out in turn, and every wavelength goes
    // on from where its losses are smallest.
    void start_without_each_angle(const ceres::LossFunction& loss) {
        if (!fit_.common.empty()) return;
        run(loss, 1e-2, 30);
        std::map<double, double> least = losses(loss);
        std::vector<double> best = plain_.weights;
        const std::vector<double> angles = measurement_.angles();
        if (angles.size() < 3 || angles.size() > 16) return;
        for (const double angle : angles) {
            for (size_t i = 0; i < given_.size(); ++i) {
                const bool left_out = measurement_.rows[i].angle_deg == angle;
                plain_.weights[i] = given_[i] * (left_out ? smallest_weight : 1);
            }
            fit();
            run(loss, 1e-2, 30);
            const std::map<double, double> now = losses(loss);
            for (size_t i = 0; i < given_.size(); ++i) {
                const double nm = measurement_.rows[i].wavelength_nm;
                const auto sum = now.find(nm);
                const auto before = least.find(nm);
                if (sum == now.end()) continue;
                if (before == least.end() || sum->second < before->second - 1e-3) {
                    best[i] = plain_.weights[i];
                }
            }
            for (const auto& [nm, sum] : now) {
                const auto before = least.find(nm);
                if (before == least.end() || sum < before->second - 1e-3) least[nm] = sum;
            }
        }
        plain_.weights = best;
        fit();
    }

    FitResult result(const ceres::LossFunction& loss) {
        set_losses(loss);
        return std::move(fit_);
    }

  private:
    void fit() {
        fit_ = fit_measurement(measurement_, plain_);
        // The next round goes on from here: a search of its own may number the terms otherwise.
        plain_.dispersion = fit_.dispersion;
        plain_.dispersion_start = fit_.dispersion_parameters;
        residuals_ = row_residuals(fit_, measurement_, plain_);
    }

    double reweigh(const ceres::LossFunction& loss) {
        double change = 0;
        for (size_t i = 0; i < residuals_.size(); ++i) {
            const double squared = given_[i] * residuals_[i].squared();
            if (!std::isfinite(squared)) continue;
            double rho[3];
            loss.Evaluate(squared, rho);
            const double weight = given_[i] * std::max(rho[1], smallest_weight);
            change = std::max(change, std::abs(std::sqrt(weight) - std::sqrt(plain_.weights[i])));
            plain_.weights[i] = weight;
        }
        return change;
    }

    // Sums over each fitted wavelength.
    std::map<double, double> losses(const ceres::LossFunction& loss) const {
        std::map<double, double> sums;
        for (size_t i = 0; i < residuals_.size(); ++i) {
            const double squared = given_[i] * residuals_[i].squared();
            if (!std::isfinite(squared)) continue;
            double rho[3];
            loss.Evaluate(squared, rho);
            sums[measurement_.rows[i].wavelength_nm] += rho[0];
        }
        return sums;
    }

    void set_losses(const ceres::LossFunction& loss) {
        const std::map<double, double> sums = losses(loss);
        fit_.chi2 = 0;
        for (FittedPoint& point : fit_.points) {
            if (!point.identifiable) continue;
            const auto sum = sums.find(point.wavelength_nm);
            point.chi2 = sum == sums.end() ? 0 : sum->second;
            fit_.chi2 += point.chi2;
        }
        int rows = 0;
        for (size_t i = 0; i < residuals_.size(); ++i) {
            const double squared = given_[i] * residuals_[i].squared();
            if (!std::isfinite(squared)) continue;
            double rho[3];
            loss.Evaluate(squared, rho);
            ++rows;
            if (rho[1] < 0.5) ++fit_.rows_down_weighted;
        }
        if (5 * fit_.rows_down_weighted > rows) {
            fit_.warnings.push_back(fmt::format(
                "{} of {} rows count for less than half: that is no handful of bad rows, the model "
                "does not describe them",
                fit_.rows_down_weighted, rows));
        }
    }

    const Measurement& measurement_;
    FitOptions plain_;
    std::vector<double> given_;
    FitResult fit_;
    std::vector<RowResidual> residuals_;
};

FitResult fit_robust_if_needed(const Measurement& measurement, FitOptions options) {
    options.robust = "none";
    FitResult plain = fit_measurement(measurement, options);
    const RobustChoice choice = robust_choice(plain, measurement, options);
    if (choice.loss == "none") return plain;
    options.robust = choice.loss;
    FitResult robust = fit_robust(measurement, options);
    robust.warnings.push_back(
        fmt::format("the robust loss {} was taken: {}", choice.loss, choice.reason));
    return robust;
}

}  // namespace

const std::vector<std::string>& robust_names() {
    static const std::vector<std::string> names = {"none", "huber", "cauchy", "tukey", "auto"};
    return names;
}

double robust_constant(const std::string& name) {
    if (name == "huber") return 1.345;
    if (name == "cauchy") return 2.385;
    return name == "tukey" ? 4.685 : 0;
}

FitResult fit_robust(const Measurement& measurement, const FitOptions& options) {
    check(options);
    if (options.robust == "auto") return fit_robust_if_needed(measurement, options);
    const auto loss = make_loss(options.robust);
    Reweighting reweighting(measurement, options);
    if (options.robust != "huber") {
        reweighting.run(*make_loss("huber"), 1e-2, most_rounds);
        reweighting.start_without_each_angle(*loss);
    }
    const bool converged = reweighting.run(*loss, 1e-6, most_rounds);
    FitResult fit = reweighting.result(*loss);
    fit.robust = options.robust;
    if (!converged) {
        fit.warnings.push_back(
            fmt::format("the weights of the robust loss still change after {} rounds: the values "
                        "are not settled",
                        most_rounds));
    }
    return fit;
}

}  // namespace drude
