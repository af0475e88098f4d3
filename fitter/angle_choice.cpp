#include "fitter/angle_choice.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "fitter/fit_data.h"
#include "fitter/model_curve.h"
#include "fitter/point_residuals.h"

namespace drude {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr size_t most_enumerated = 12;

// Of n and k: symmetric, by sums of products of derivatives.
struct Information {
    double nn = 0, nk = 0, kk = 0;
    void add(const Information& other) {
        nn += other.nn;
        nk += other.nk;
        kk += other.kk;
    }
    Information divided_by(double variance) const {
        return {nn / variance, nk / variance, kk / variance};
    }
    // sqrt(sigma_n^2 + sigma_k^2): the root of the trace of the inverse.
    double sigma() const {
        const double determinant = nn * kk - nk * nk;
        // Rounding leaves of a singular matrix what is far below the product of its diagonal.
        return determinant > 1e-12 * nn * kk ? std::sqrt((nn + kk) / determinant) : infinite;
    }
};

Information information_of(const WavelengthData& data, Estimator estimator, double n, double k) {
    using Jet = ceres::Jet<double, 2>;
    const PointResiduals residuals{&data, estimator};
    const Jet index[2] = {Jet(n, 0), Jet(k, 1)};
    std::vector<Jet> values(static_cast<size_t>(residuals.count()));
    Information information;
    if (!residuals(index, values.data())) return information;
    for (const Jet& value : values) {
        information.add(
            {value.v[0] * value.v[0], value.v[0] * value.v[1], value.v[1] * value.v[1]});
    }
    return information;
}

double median_of(std::vector<double> values) {
    if (values.empty()) return infinite;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// By wavelength, then by angle in the order of `angles`.
using Table = std::vector<std::vector<Information>>;

Table information_table(const Measurement& measurement, const FitOptions& options,
                        const FitResult& fit, const std::vector<double>& angles) {
    const Estimator estimator = fit.estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta;
    // Without stated standard deviations rows have one of a degree each, until the residuals tell.
    const double noise = noise_variance(fit, options);
    Table table;
    for (const WavelengthData& group : group_by_wavelength(measurement, options)) {
        const auto point = std::find_if(
            fit.points.begin(), fit.points.end(),
            [&](const FittedPoint& p) { return p.wavelength_nm == group.wavelength_nm; });
        if (point == fit.points.end() || !point->identifiable) continue;
        table.emplace_back(angles.size());
        for (const AnglePoint& row : group.points) {
            WavelengthData one = group;
            one.points = {row};
            const auto nearest =
                std::min_element(angles.begin(), angles.end(), [&](double a, double b) {
                    return std::abs(std::cos(a * degree) - row.cos_theta) <
                           std::abs(std::cos(b * degree) - row.cos_theta);
                });
            table.back()[static_cast<size_t>(nearest - angles.begin())] =
                information_of(one, estimator, point->n, point->k).divided_by(noise);
        }
    }
    return table;
}

AngleSet set_of(const Table& table, const std::vector<double>& angles,
                const std::vector<bool>& taken) {
    AngleSet set;
    for (size_t a = 0; a < angles.size(); ++a) {
        if (taken[a]) set.angles_deg.push_back(angles[a]);
    }
    std::vector<double> sigmas;
    for (const std::vector<Information>& row : table) {
        Information sum;
        for (size_t a = 0; a < angles.size(); ++a) {
            if (taken[a]) sum.add(row[a]);
        }
        sigmas.push_back(sum.sigma());
    }
    set.sigma = median_of(std::move(sigmas));
    return set;
}

// The best of every number of angles.
std::vector<AngleSet> best_sets(const Table& table, const std::vector<double>& angles) {
    const size_t count = angles.size();
    std::vector<AngleSet> best(count);
    for (AngleSet& set : best) set.sigma = infinite;
    const auto look = [&](const std::vector<bool>& taken) {
        AngleSet set = set_of(table, angles, taken);
        AngleSet& now = best[set.angles_deg.size() - 1];
        if (now.angles_deg.empty() || set.sigma < now.sigma) now = std::move(set);
    };
    if (count <= most_enumerated) {
        for (unsigned bits = 1; bits < 1u << count; ++bits) {
            std::vector<bool> taken(count);
            for (size_t a = 0; a < count; ++a) taken[a] = (bits >> a & 1u) != 0;
            look(taken);
        }
        return best;
    }
    std::vector<bool> taken(count, false);
    for (size_t size = 1; size <= count; ++size) {
        for (size_t a = 0; a < count; ++a) {
            if (taken[a]) continue;
            std::vector<bool> more = taken;
            more[a] = true;
            look(more);
        }
        for (size_t a = 0; a < count; ++a) {
            const std::vector<double>& chosen = best[size - 1].angles_deg;
            taken[a] = std::find(chosen.begin(), chosen.end(), angles[a]) != chosen.end();
        }
    }
    return best;
}

AngleSet film_without(const Measurement& measurement, FitOptions options, const FitResult& fit,
                      const std::vector<double>& angles) {
    AngleSet set{angles, std::nan("")};
    const FittedParameter* porosity = fit.find("porosity");
    options.film.start = FilmGuess{
        fit.layers.back().thickness_nm,
        porosity && porosity->identifiable ? porosity->value : options.film.porosity.value_or(0)};
    // Weights are those of all rows; they belong to robust fits.
    options.weights.clear();
    try {
        const FitResult fewer = fit_measurement(at_angles(measurement, angles), options);
        set.sigma = fewer.common.front().sigma;
    } catch (const Error& error) {
        if (error.cause() != Cause::answer_is_no) throw;
    }
    return set;
}

// Which of `angles` are left out in turn: the one first without which the thickness is known best.
std::vector<double> cheapest_first(const std::vector<double>& angles,
                                   const std::vector<AngleSet>& without) {
    std::vector<size_t> order(angles.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto sigma = [&](size_t a) {
        return std::isnan(without[a].sigma) ? infinite : without[a].sigma;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return sigma(a) < sigma(b); });
    std::vector<double> turn;
    for (const size_t a : order) turn.push_back(angles[a]);
    return turn;
}

AngleChoice film_angle_choice(const Measurement& measurement, const FitOptions& taken,
                              const FitResult& fit) {
    AngleChoice choice;
    const std::vector<double> angles = measurement.angles();
    choice.all = {angles, sigma_of_fit(fit)};
    choice.needed = choice.all;
    if (angles.size() < 2) return choice;
    for (const double left_out : angles) {
        std::vector<double> others = angles;
        others.erase(std::find(others.begin(), others.end(), left_out));
        choice.without.push_back(film_without(measurement, taken, fit, others));
    }
    std::vector<double> left = angles;
    for (const double next : cheapest_first(angles, choice.without)) {
        left.erase(std::find(left.begin(), left.end(), next));
        if (left.empty()) break;
        const auto known = std::find_if(choice.without.begin(), choice.without.end(),
                                        [&](const AngleSet& s) { return s.angles_deg == left; });
        AngleSet set =
            known != choice.without.end() ? *known : film_without(measurement, taken, fit, left);
        if (!(set.sigma <= enough_sigma * choice.all.sigma)) break;
        choice.needed = std::move(set);
    }
    return choice;
}

}  // namespace

double sigma_of_fit(const FitResult& fit) {
    if (fit.model == "film") return fit.common.empty() ? std::nan("") : fit.common.front().sigma;
    std::vector<double> sigmas;
    for (const FittedPoint& point : fit.points) {
        if (point.identifiable) sigmas.push_back(std::hypot(point.sigma_n, point.sigma_k));
    }
    return median_of(std::move(sigmas));
}

double sigma_of_all_angles(const Measurement& measurement, const FitOptions& options,
                           const FitResult& fit) {
    if (fit.model == "film") return sigma_of_fit(fit);
    const std::vector<double> angles = measurement.angles();
    const Table table = information_table(measurement, options_taken(options, fit), fit, angles);
    return set_of(table, angles, std::vector<bool>(angles.size(), true)).sigma;
}

AngleChoice angle_choice(const Measurement& measurement, const FitOptions& options,
                         const FitResult& fit) {
    const FitOptions taken = options_taken(options, fit);
    if (fit.model == "film") return film_angle_choice(measurement, taken, fit);
    AngleChoice choice;
    const std::vector<double> angles = measurement.angles();
    const Table table = information_table(measurement, taken, fit, angles);
    choice.all = set_of(table, angles, std::vector<bool>(angles.size(), true));
    for (size_t a = 0; a < angles.size() && angles.size() > 1; ++a) {
        std::vector<bool> others(angles.size(), true);
        others[a] = false;
        choice.without.push_back(set_of(table, angles, others));
    }
    choice.best = best_sets(table, angles);
    choice.needed = choice.all;
    for (const AngleSet& set : choice.best) {
        if (set.sigma <= enough_sigma * choice.all.sigma) {
            choice.needed = set;
            break;
        }
    }
    return choice;
}

Measurement at_angles(const Measurement& measurement, const std::vector<double>& angles_deg) {
    if (angles_deg.empty()) user_error("no angle of incidence; expected one of the measurement's");
    const std::vector<double> there = measurement.angles();
    for (const double angle : angles_deg) {
        if (std::find(there.begin(), there.end(), angle) == there.end()) {
            user_error("found the angle {}, expected some of the measurement's: {}", angle,
                       fmt::join(there, ", "));
        }
    }
    Measurement fewer = measurement;
    fewer.rows.erase(std::remove_if(fewer.rows.begin(), fewer.rows.end(),
                                    [&](const MeasurementRow& row) {
                                        return std::find(angles_deg.begin(), angles_deg.end(),
                                                         row.angle_deg) == angles_deg.end();
                                    }),
                     fewer.rows.end());
    return fewer;
}

}  // namespace drude
