// Which parameters a set of data determines, and how well: from our own singular value
// decomposition of the Jacobian at the solution.
//
// A library that inverts the normal equations with a pseudo-inverse returns a variance of 0 for a
// parameter that nothing depends on. Here such a parameter is named and has no variance.
#pragma once

#include <vector>

namespace drude {

struct Identifiability {
    // For every parameter: does it lie outside the null space of the data?
    std::vector<bool> identifiable;
    // Standard deviations; NaN for every parameter where any is not identifiable.
    std::vector<double> sigma;
    std::vector<double> correlation;  // row-major, parameters x parameters; NaN likewise
    double condition = 0;  // largest over smallest singular value of the Jacobian; infinite if 0
    // Row-major, parameters x parameters, over the directions that the data determine alone.
    std::vector<double> covariance;
    // Changes of the parameters that change no datum, one after the other; each is a unit vector of
    // parameters in units of `scale`, which is what makes a column of the Jacobian 1 long.
    std::vector<std::vector<double>> null_directions;
    std::vector<double> scale;

    bool all() const;
    // The standard deviation of a quantity that changes by gradient[j] with parameter j; NaN where
    // it changes along a null direction.
    double sigma_of(const std::vector<double>& gradient) const;
    // The covariance of two such quantities.
    double covariance_of(const std::vector<double>& a, const std::vector<double>& b) const;
};

// `jacobian`: d(residual)/d(parameter), row-major rows x columns, residuals in units of standard
// deviations. Columns are scaled to length 1 before ranks are judged, so that the units of the
// parameters do not matter; a singular value below 1e-10 of the largest counts as zero. Fewer rows
// than columns leave a null space too.
Identifiability analyse_jacobian(const std::vector<double>& jacobian, int rows, int columns);

}  // namespace drude
