#include "fitter/profile.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/film_profile.h"
#include "fitter/fit_data.h"
#include "fitter/model_curve.h"
#include "fitter/offset_fit.h"
#include "fitter/point_profile.h"

namespace drude {

namespace {

void check(const FitOptions& options, const FitResult& fit) {
    if (options.estimator == "inversion") {
        user_error(
            "the estimator inversion minimises no chi-square that could rise; expected psi-delta "
            "or rho2 with a profile likelihood");
    }
    if (options.robust != "none") {
        user_error(
            "a profile likelihood is that of normal errors; found the robust loss {}, expected "
            "none (the bootstrap takes it)",
            options.robust);
    }
    if (!fit.dispersion.empty()) {
        user_error(
            "a profile likelihood is made of n and k at single wavelengths or of a film's "
            "parameters; found the dispersion {}, expected none (the bootstrap takes it)",
            fit.dispersion);
    }
    if (fit.model != "bulk" && fit.model != "overlayer" && fit.model != "film") {
        user_error(
            "found the model '{}', expected bulk, overlayer or film with a profile likelihood (the "
            "bootstrap takes every model)",
            fit.model);
    }
    for (const FittedParameter& p : fit.common) {
        const bool film = p.name == "thickness" || p.name == "porosity";
        if (p.name == "angle offset" || (film && fit.model == "film")) continue;
        user_error(
            "the parameter '{}' of the fit has no profile likelihood (the "
            "bootstrap takes every model)",
            p.name);
    }
    if (options.unweighted && fit.dof() <= 0) {
        user_error("an unweighted fit with as many parameters as data has no scale for a profile");
    }
}

// Indices into fit.points.
std::vector<size_t> chosen_points(const FitResult& fit, const std::vector<double>& only_nm) {
    std::vector<size_t> identifiable, chosen;
    for (size_t i = 0; i < fit.points.size(); ++i) {
        if (fit.points[i].identifiable) identifiable.push_back(i);
    }
    if (only_nm.empty() || identifiable.empty()) return identifiable;
    const double first = fit.points[identifiable.front()].wavelength_nm;
    const double last = fit.points[identifiable.back()].wavelength_nm;
    for (const double nm : only_nm) {
        if (!(nm >= first && nm <= last)) {
            user_error("found a profile at {} nm, expected one from {} to {} nm, which were fitted",
                       nm, first, last);
        }
        const auto further = [&](size_t a, size_t b) {
            return std::abs(fit.points[a].wavelength_nm - nm) <
                   std::abs(fit.points[b].wavelength_nm - nm);
        };
        const size_t nearest = *std::min_element(identifiable.begin(), identifiable.end(), further);
        if (std::find(chosen.begin(), chosen.end(), nearest) == chosen.end()) {
            chosen.push_back(nearest);
        }
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

// One parameter still to be profiled, with all that its function needs.
struct Task {
    ProfiledParameter parameter;
    HeldChi2 held;  // of the parameter in `parameter`'s unit, chi-square in that of the rises
    double smallest = 0, lower = 0, upper = 0;
};

class Tasks {
  public:
    Tasks(const Measurement& measurement, const FitOptions& options, const FitResult& fit)
        : options_(options_taken(options, fit)), fit_(fit) {
        scale_ = options.unweighted ? fit.chi2_reduced() : 1;
        if (fit.model == "film") {
            film_ = make_film_problem(measurement, options_);
        } else {
            groups_ = group_by_wavelength(measurement, options_);
        }
        estimator_ = fit.estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta;
    }

    // With an angle offset its profile comes first: it says where n and k need to be followed to.
    std::vector<Task> common() {
        std::vector<Task> tasks;
        for (const FittedParameter& p : fit_.common) {
            if (!p.identifiable) continue;
            Task task;
            task.parameter = {p.name, p.unit, 0, p.value, p.sigma, {}};
            task.smallest = fit_.chi2 / scale_;
            if (fit_.model == "film") {
                const FilmBound bound = film_bound(p.name, film_range(film_, options_));
                task.lower = bound.lower;
                task.upper = bound.upper;
                task.held = scaled(held_film_chi2(film_, fit_, p.name, options_));
            } else {
                task.lower = -largest_angle_offset / degree;
                task.upper = largest_angle_offset / degree;
                task.held = scaled([this](double offset_deg) {
                    double sum = 0;
                    for (size_t i = 0; i < groups_.size(); ++i) {
                        if (fit_.points[i].identifiable) sum += chi2_at_offset(i, offset_deg);
                    }
                    return sum;
                });
            }
            tasks.push_back(std::move(task));
        }
        return tasks;
    }

    std::vector<Task> points(const std::vector<size_t>& chosen,
                             const std::vector<ProfiledParameter>& common) {
        if (fit_.model == "film") return {};
        // Without the offset's own profile nobody knows how far it follows.
        if (common.empty() && !fit_.common.empty()) return {};
        if (!common.empty()) tabulate_offset(common.front());
        std::vector<Task> tasks;
        for (const size_t i : chosen) {
            const FittedPoint& point = fit_.points[i];
            for (const bool is_k : {false, true}) {
                Task task;
                task.parameter = {is_k ? "k" : "n",
                                  "",
                                  point.wavelength_nm,
                                  is_k ? point.k : point.n,
                                  is_k ? point.sigma_k : point.sigma_n,
                                  {}};
                task.lower = is_k ? 0 : smallest_n;
                task.upper = largest_index;
                if (common.empty()) {
                    task.smallest = point.chi2 / scale_;
                    task.held = scaled(held_index_chi2(groups_[i], estimator_, point, is_k));
                } else {
                    task.smallest = fit_.chi2 / scale_;
                    task.held = scaled(held_index_chi2(groups_[i], estimator_, point, is_k,
                                                       others_[i], offset_low_, offset_high_));
                }
                tasks.push_back(std::move(task));
            }
        }
        return tasks;
    }

  private:
    HeldChi2 scaled(HeldChi2 held) const {
        return
            [held = std::move(held), scale = scale_](double value) { return held(value) / scale; };
    }

    double chi2_at_offset(size_t i, double offset_deg) const {
        const auto moved = with_angle_offset({groups_[i]}, offset_deg * degree);
        return fit_point(moved[0], estimator_).chi2;
    }

    // What all other wavelengths together pay for an offset, for each wavelength: a polynomial
    // through Chebyshev's points of the interval at the larger rise, beyond which an interval of n
    // or k cannot lead.
    void tabulate_offset(const ProfiledParameter& offset) {
        const ProfileInterval& widest = offset.intervals.back();
        offset_low_ = std::isnan(widest.lower) ? -largest_angle_offset : widest.lower * degree;
        offset_high_ = std::isnan(widest.upper) ? largest_angle_offset : widest.upper * degree;
        constexpr size_t nodes = 13;
        std::vector<std::vector<double>> chi2(nodes, std::vector<double>(groups_.size(), 0));
        parallel_for(nodes * groups_.size(), options_.threads, [&](size_t task) {
            const size_t node = task / groups_.size(), i = task % groups_.size();
            if (!fit_.points[i].identifiable) return;
            const double at = chebyshev_point(node, nodes, offset_low_, offset_high_);
            chi2[node][i] = chi2_at_offset(i, at / degree);
        });
        std::vector<double> total(nodes, 0);
        for (size_t node = 0; node < nodes; ++node) {
            for (const double one : chi2[node]) total[node] += one;
        }
        others_.assign(groups_.size(), std::vector<double>(nodes));
        for (size_t i = 0; i < groups_.size(); ++i) {
            for (size_t node = 0; node < nodes; ++node) {
                others_[i][node] = total[node] - chi2[node][i];
            }
        }
    }

    FitOptions options_;
    const FitResult& fit_;
    Estimator estimator_ = Estimator::psi_delta;
    double scale_ = 1;
    FilmProblem film_;
    std::vector<WavelengthData> groups_;
    double offset_low_ = 0, offset_high_ = 0;  // radians
    std::vector<std::vector<double>> others_;
};

std::vector<ProfiledParameter> run(std::vector<Task> tasks, int threads,
                                   std::vector<std::string>* warnings) {
    std::vector<double> deepest(tasks.size(), 0);
    parallel_for(tasks.size(), threads, [&](size_t i) {
        Task& task = tasks[i];
        // Not the function that was minimised, and no interval of its.
        const double there = task.held(task.parameter.value);
        if (!(there < task.smallest * 1.001 + 0.01)) {
            throw Error(Cause::answer_is_no,
                        fmt::format("no profile likelihood of {}: chi-square is {:.6g} where the "
                                    "fit has {:.6g}",
                                    task.parameter.name, there, task.smallest));
        }
        const Profile profile = profile_of(task.held, task.parameter.value, task.smallest,
                                           task.parameter.sigma, task.lower, task.upper);
        task.parameter.intervals = profile.intervals;
        deepest[i] = profile.deepest;
    });
    std::vector<ProfiledParameter> parameters;
    for (size_t i = 0; i < tasks.size(); ++i) {
        const ProfiledParameter& p = tasks[i].parameter;
        if (deepest[i] > 0.01) {
            warnings->push_back(fmt::format(
                "no profile of {}{}: along it chi-square falls {:.3g} below that of the fit, which "
                "is then not at its lowest",
                p.name, p.wavelength_nm > 0 ? fmt::format(" at {} nm", p.wavelength_nm) : "",
                deepest[i]));
            continue;
        }
        parameters.push_back(p);
    }
    return parameters;
}

}  // namespace

ProfileResult profile_likelihood(const Measurement& measurement, const FitOptions& options,
                                 const FitResult& fit, const std::vector<double>& only_nm) {
    check(options, fit);
    const std::vector<size_t> chosen = chosen_points(fit, only_nm);
    ProfileResult result;
    Tasks tasks(measurement, options, fit);
    result.parameters = run(tasks.common(), options.threads, &result.warnings);
    const auto points =
        run(tasks.points(chosen, result.parameters), options.threads, &result.warnings);
    result.parameters.insert(result.parameters.end(), points.begin(), points.end());
    return result;
}

}  // namespace drude
