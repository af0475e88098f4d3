#include "fitter/like_the_paper.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fitter/dense_solver.h"
#include "fitter/fit_data.h"
#include "fitter/identifiability.h"
#include "fitter/point_fit.h"
#include "materials/microfacet.h"

namespace drude {

namespace {

// |rho|^2 of the model less that of the data, not weighted.
struct PaperResiduals {
    const WavelengthData* data;
    int block;  // 0: the Fresnel terms alone; else one more than the lobe

    template <class T>
    bool operator()(const T* n, const T* k, const T* beta, T* residuals) const {
        T D(1.0);
        if (block > 0) D = LobeDensity<T>(static_cast<Lobe>(block - 1), *beta)(T(0.0));
        for (const AnglePoint& point : data->points) {
            const Reflection<T> fresnel = reflect(ComplexIndex<T>{*n, *k}, T(point.cos_theta));
            // V-grooves neither shadow nor mask in the mirror direction: 2 cos/cos is above 1.
            constexpr double G = 1;
            const T common = D * T(G / (4 * point.cos_theta * point.cos_theta));
            const T parallel = common * fresnel.Rp, perpendicular = common * fresnel.Rs;
            if (!(fresnel.Rs > T(1e-30))) return false;
            *residuals++ = parallel / perpendicular - T(point.tan2_psi);
        }
        return true;
    }
};

using PaperCost = ceres::AutoDiffCostFunction<PaperResiduals, ceres::DYNAMIC, 1, 1, 1>;

struct Solution {
    double values[3] = {0, 0, 0};  // n, k, beta
    double cost = 0;
    bool converged = false;
};

Solution solve(const WavelengthData& data, int block, double n, double k, double beta) {
    Solution solution;
    double* const values = solution.values;
    values[0] = std::clamp(n, smallest_n, largest_index);
    values[1] = std::clamp(k, 0.0, largest_index);
    values[2] = beta;
    ceres::Problem problem;
    problem.AddResidualBlock(
        new PaperCost(new PaperResiduals{&data, block}, static_cast<int>(data.points.size())),
        nullptr, values, values + 1, values + 2);
    const double lower[] = {smallest_n, 0, 1e-3};
    const double upper[] = {largest_index, largest_index, largest_beta};
    for (int j = 0; j < 3; ++j) {
        problem.SetParameterLowerBound(values + j, 0, lower[j]);
        problem.SetParameterUpperBound(values + j, 0, upper[j]);
    }
    if (block == 0) problem.SetParameterBlockConstant(values + 2);
    ceres::Solver::Options options = dense_solver(200, 1e-13);
    options.function_tolerance = 1e-20;
    options.gradient_tolerance = 1e-15;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    solution.cost = 2 * summary.final_cost;
    solution.converged =
        summary.termination_type == ceres::CONVERGENCE && std::isfinite(summary.final_cost);
    return solution;
}

// One row an angle: d|rho|^2 by n, k and beta.
Eigen::MatrixXd jacobian_at(const WavelengthData& data, int block, const Solution& solution) {
    const auto rows = static_cast<Eigen::Index>(data.points.size());
    PaperCost cost(new PaperResiduals{&data, block}, static_cast<int>(rows));
    Eigen::MatrixXd jacobian(rows, 3);
    Eigen::VectorXd residuals(rows);
    const double* parameters[] = {solution.values, solution.values + 1, solution.values + 2};
    double* columns[] = {jacobian.col(0).data(), jacobian.col(1).data(), jacobian.col(2).data()};
    if (!cost.Evaluate(parameters, residuals.data(), columns)) jacobian.setZero();
    return jacobian;
}

PaperFitBlock fit_block(const WavelengthData& data, int block, double n, double k) {
    PaperFitBlock result;
    result.name = paper_block_names()[static_cast<size_t>(block)];
    result.beta_start = block > 0 ? std::vector<double>{0.2, 0.5} : std::vector<double>{0.2};
    Solution first;
    for (size_t i = 0; i < result.beta_start.size(); ++i) {
        const Solution solution = solve(data, block, n, k, result.beta_start[i]);
        if (i == 0) first = solution;
        result.beta_end.push_back(solution.values[2]);
    }
    result.n = first.values[0];
    result.k = first.values[1];
    result.converged = first.converged;
    result.rms = std::sqrt(first.cost / static_cast<double>(data.points.size()));
    const Eigen::MatrixXd jacobian = jacobian_at(data, block, first);
    result.column_n = jacobian.col(0).norm();
    result.column_k = jacobian.col(1).norm();
    result.column_beta = jacobian.col(2).norm();
    if (block == 0) result.beta_start = result.beta_end = {};
    return result;
}

// Of unweighted least squares under the noise of Psi: (J^T J)^-1 J^T V J (J^T J)^-1.
void set_sigmas(const WavelengthData& data, PaperFit* fit) {
    const PaperFitBlock& block = fit->blocks.front();
    const Eigen::MatrixXd jacobian =
        jacobian_at(data, 0, {{block.n, block.k, 0.2}, 0, true}).leftCols(2);
    std::vector<double> weighted;
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
        const double sigma = data.points[static_cast<size_t>(i)].sigma_tan2_psi;
        weighted.push_back(jacobian(i, 0) / sigma);
        weighted.push_back(jacobian(i, 1) / sigma);
    }
    if (!analyse_jacobian(weighted, static_cast<int>(jacobian.rows()), 2).all()) {
        throw Error(Cause::answer_is_no,
                    "no fit: tan^2 Psi at these angles does not determine n and k: its Jacobian "
                    "has no full rank");
    }
    const Eigen::MatrixXd solver = jacobian.completeOrthogonalDecomposition().pseudoInverse();
    double variance[2] = {0, 0};
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
        const double sigma = data.points[static_cast<size_t>(i)].sigma_tan2_psi;
        for (int j = 0; j < 2; ++j) variance[j] += std::pow(solver(j, i) * sigma, 2);
    }
    fit->sigma_n = std::sqrt(variance[0]);
    fit->sigma_k = std::sqrt(variance[1]);
}

// The rows of the wavelength nearest to `wanted_nm`.
Measurement nearest_rows(const Measurement& measurement, double wanted_nm) {
    double nearest = measurement.rows.front().wavelength_nm;
    for (const MeasurementRow& row : measurement.rows) {
        if (std::abs(row.wavelength_nm - wanted_nm) < std::abs(nearest - wanted_nm)) {
            nearest = row.wavelength_nm;
        }
    }
    Measurement rows = measurement;
    rows.rows.clear();
    for (const MeasurementRow& row : measurement.rows) {
        if (row.wavelength_nm == nearest) rows.rows.push_back(row);
    }
    return rows;
}

const OpticalConstants& nearest_set(double wavelength_nm, const FittedPoint& point) {
    const std::vector<OpticalConstants>& sets = published_sets();
    const auto distance = [&](const OpticalConstants& set) {
        const Index at = set.at(wavelength_nm);
        return point.identifiable ? std::hypot(at.n - point.n, at.k - point.k) : 0;
    };
    return *std::min_element(sets.begin(), sets.end(),
                             [&](const OpticalConstants& a, const OpticalConstants& b) {
                                 return distance(a) < distance(b);
                             });
}

}  // namespace

PaperFit fit_like_the_paper(const Measurement& measurement, const LikeThePaperOptions& options) {
    measurement.check();
    if (!(options.wavelength_nm >= 0 && std::isfinite(options.wavelength_nm))) {
        user_error("found a wavelength of {} nm, expected one above 0", options.wavelength_nm);
    }
    PaperFit fit;
    fit.printed = paper_metal_of(measurement.header_value("sample"));
    const double usual = fit.printed ? fit.printed->wavelength_nm : 516;
    const double wanted = options.wavelength_nm > 0 ? options.wavelength_nm : usual;
    const Measurement rows = nearest_rows(measurement, wanted);
    fit.wavelength_nm = rows.rows.front().wavelength_nm;
    if (std::abs(fit.wavelength_nm - wanted) > 10) {
        fit.warnings.push_back(
            fmt::format("the row nearest to {} nm is at {} nm, where other n "
                        "and k are to be expected",
                        wanted, fit.wavelength_nm));
    }
    fit.angles_deg = rows.angles();
    if (fit.angles_deg.size() < 2) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: at {} nm there is one angle of incidence, and one value "
                                "of tan^2 Psi does not determine the two unknowns n and k: measure "
                                "at two angles or more",
                                fit.wavelength_nm));
    }
    const WavelengthData data = group_by_wavelength(rows, {}).front();
    fit.psi_delta = fit_point(data, Estimator::psi_delta);

    const OpticalConstants* literature = &options.literature;
    if (literature->wavelength_nm.empty()) {
        fit.nearest_literature = fit.printed == nullptr;
        literature = fit.printed ? &published_set(fit.printed->literature)
                                 : &nearest_set(fit.wavelength_nm, fit.psi_delta);
    }
    const Index start = literature->at(fit.wavelength_nm);
    fit.literature = literature->name;
    const std::string outside = literature->range_warning(fit.wavelength_nm, fit.wavelength_nm);
    if (!outside.empty()) fit.warnings.push_back(outside);
    fit.start_n = start.n;
    fit.start_k = start.k;
    for (int block = 0; block < static_cast<int>(paper_block_names().size()); ++block) {
        fit.blocks.push_back(fit_block(data, block, start.n, start.k));
    }
    if (!fit.blocks.front().converged) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: least squares of tan^2 Psi from {} + {}i ({}) did not "
                                "converge",
                                start.n, start.k, fit.literature));
    }
    set_sigmas(data, &fit);
    return fit;
}

std::vector<PaperCheck> check_paper_table() {
    std::vector<PaperCheck> checks;
    for (const PaperMetal& metal : paper_table()) {
        PaperCheck check;
        check.metal = &metal;
        const PaperValues& truth = metal.blocks[0];
        const Measurement reference = paper_measurement(metal, truth);
        check.fit = fit_like_the_paper(reference, {});
        for (const PaperFitBlock& block : check.fit.blocks) {
            check.largest_error = std::max(
                {check.largest_error, std::abs(block.n - truth.n), std::abs(block.k - truth.k)});
        }
        for (size_t i = 0; i < metal.blocks.size(); ++i) {
            const Measurement other = paper_measurement(metal, metal.blocks[i]);
            double squares = 0;
            for (size_t j = 0; j < other.rows.size(); ++j) {
                squares += std::pow(other.rows[j].psi_deg - reference.rows[j].psi_deg, 2);
            }
            const double mean = squares / static_cast<double>(other.rows.size());
            if (std::sqrt(mean) <= check.largest_psi_difference_deg) continue;
            check.largest_psi_difference_deg = std::sqrt(mean);
            check.largest_chi2 = mean / (0.05 * 0.05);
            check.largest_at = paper_block_names()[i];
        }
        check.beta_repeated = metal.blocks[1].beta == metal.blocks[3].beta;
        checks.push_back(std::move(check));
    }
    return checks;
}

}  // namespace drude
