// What a dispersion formula is fitted to, as Ceres takes it.
#pragma once

#include <ceres/cost_function.h>

#include <complex>
#include <vector>

#include "fitter/dispersion_model.h"
#include "fitter/fit_result.h"
#include "fitter/point_fit.h"

namespace drude {

// The data themselves. Two parameter blocks: those of the formula, and an offset of the angles of
// incidence in radians. No value where the formula has none (DispersionModel::index).
class DispersionCost : public ceres::CostFunction {
  public:
    DispersionCost(const DispersionModel& model, const std::vector<WavelengthData>& groups,
                   Estimator estimator);
    bool Evaluate(double const* const* parameters, double* residuals,
                  double** jacobians) const override;

  private:
    const DispersionModel& model_;
    const std::vector<WavelengthData>& groups_;
    Estimator estimator_;
};

// A permittivity to come close to, and the map of a complex difference to two numbers of unit
// variance.
struct PermittivityTarget {
    size_t wavelength = 0;
    std::complex<double> epsilon;
    double weights[2][2] = {{0, 0}, {0, 0}};  // of re and im
};

// Of n and k with their standard deviations and correlation: to first order d eps = 2 N dN.
// Points that are not identifiable give none.
std::vector<PermittivityTarget> permittivity_targets(const std::vector<FittedPoint>& points);

// The targets, at which the formula is linear in most parameters and always has a value: what a
// search for starts looks at.
class PermittivityCost : public ceres::CostFunction {
  public:
    PermittivityCost(const DispersionModel& model, const std::vector<PermittivityTarget>& targets);
    bool Evaluate(double const* const* parameters, double* residuals,
                  double** jacobians) const override;

  private:
    const DispersionModel& model_;
    const std::vector<PermittivityTarget>& targets_;
};

}  // namespace drude
