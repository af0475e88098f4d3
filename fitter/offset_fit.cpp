#include "fitter/offset_fit.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/point_residuals.h"

namespace drude {

namespace {

// What one wavelength says of the offset.
struct Share {
    double information = 0;         // squared length of the derivative outside the span of n and k
    double whole = 0;               // and of all of it
    double slope = 0;               // its product with the residuals
    double per_offset[2] = {0, 0};  // how n and k follow the offset, per radian
};

Share share_of(const WavelengthData& data, Estimator estimator, const FittedPoint& point) {
    using Jet = ceres::Jet<double, 3>;
    const PointResiduals model{&data, estimator};
    const Jet index[] = {Jet(point.n, 0), Jet(point.k, 1)}, offset(0.0, 2);
    std::vector<Jet> values(static_cast<size_t>(model.count()));
    Share share;
    if (!model(index, &offset, values.data())) return share;
    const Eigen::Index rows = model.count();
    Eigen::MatrixXd by_index(rows, 2);
    Eigen::VectorXd by_offset(rows), residuals(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const Jet& value = values[static_cast<size_t>(i)];
        by_index.row(i) << value.v[0], value.v[1];
        by_offset(i) = value.v[2];
        residuals(i) = value.a;
    }
    const Eigen::Vector2d made_up = by_index.colPivHouseholderQr().solve(by_offset);
    const Eigen::VectorXd outside = by_offset - by_index * made_up;
    share.information = outside.squaredNorm();
    share.whole = by_offset.squaredNorm();
    share.slope = outside.dot(residuals);
    share.per_offset[0] = -made_up(0);
    share.per_offset[1] = -made_up(1);
    return share;
}

struct State {
    double offset = 0, chi2 = 0;
    size_t solved = 0;
    std::vector<FittedPoint> points;
    std::vector<Share> shares;
};

State solve_at(const std::vector<WavelengthData>& groups, Estimator estimator, double offset,
               int threads) {
    State state;
    state.offset = offset;
    const std::vector<WavelengthData> moved = with_angle_offset(groups, offset);
    state.points.resize(groups.size());
    state.shares.resize(groups.size());
    parallel_for(groups.size(), threads, [&](size_t i) {
        state.points[i] = fit_point(moved[i], estimator);
        if (state.points[i].identifiable) {
            state.shares[i] = share_of(moved[i], estimator, state.points[i]);
        }
    });
    for (const FittedPoint& point : state.points) {
        if (!point.identifiable) continue;
        state.chi2 += point.chi2;
        ++state.solved;
    }
    return state;
}

// The uncertainty of the offset moves n and k along the line on which they follow it.
void widen(const Share& share, double sigma, FittedPoint* point) {
    const double dn = share.per_offset[0] * sigma, dk = share.per_offset[1] * sigma;
    const double covariance = point->correlation * point->sigma_n * point->sigma_k + dn * dk;
    point->sigma_n = std::hypot(point->sigma_n, dn);
    point->sigma_k = std::hypot(point->sigma_k, dk);
    point->correlation = covariance / (point->sigma_n * point->sigma_k);
}

}  // namespace

std::vector<WavelengthData> with_angle_offset(std::vector<WavelengthData> groups, double offset) {
    for (WavelengthData& group : groups) {
        for (AnglePoint& point : group.points) {
            const double theta = std::atan2(point.sin_theta, point.cos_theta) + offset;
            point.cos_theta = std::cos(theta);
            point.sin_theta = std::sin(theta);
        }
    }
    return groups;
}

OffsetFit fit_with_offset(const std::vector<WavelengthData>& groups, Estimator estimator,
                          int threads) {
    State best = solve_at(groups, estimator, 0, threads);
    double information = 0;
    bool converged = false;
    for (int iteration = 0; iteration < 60 && !converged; ++iteration) {
        double slope = 0, whole = 0;
        information = 0;
        for (const Share& share : best.shares) {
            information += share.information;
            whole += share.whole;
            slope += share.slope;
        }
        if (!(information > 1e-16 * whole)) {
            throw Error(Cause::answer_is_no,
                        "no fit: the data do not determine a common offset of the angles of "
                        "incidence beside n and k");
        }
        double step = -slope / information;
        // Far below the standard deviation.
        converged = std::abs(step) < 1e-6 / std::sqrt(information);
        for (int halving = 0; !converged; ++halving) {
            if (halving == 20) {
                converged = true;  // no step leads downwards
                break;
            }
            if (std::abs(best.offset + step) < largest_angle_offset) {
                State next = solve_at(groups, estimator, best.offset + step, threads);
                // A wavelength that is lost on the way takes its chi-square along.
                if (next.solved >= best.solved && next.chi2 < best.chi2) {
                    best = std::move(next);
                    break;
                }
            }
            step /= 2;
        }
    }
    const double sigma = 1 / std::sqrt(information);
    if (!converged || sigma > largest_angle_offset ||
        std::abs(best.offset) > 0.99 * largest_angle_offset) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("no fit: the common offset of the angles of incidence ends at {:.2f} "
                        "+- {:.2g} degrees, expected within {} of 0: the sample is no bare "
                        "surface, or the layers on it are others",
                        best.offset / degree, sigma / degree, largest_angle_offset / degree));
    }
    OffsetFit fit;
    fit.points = std::move(best.points);
    for (size_t i = 0; i < fit.points.size(); ++i) {
        if (fit.points[i].identifiable) widen(best.shares[i], sigma, &fit.points[i]);
    }
    fit.offset.name = "angle offset";
    fit.offset.unit = "deg";
    fit.offset.value = best.offset / degree;
    fit.offset.sigma = sigma / degree;
    fit.offset.identifiable = true;
    return fit;
}

}  // namespace drude
